//! Lateral noise: a pixel of the depth picture looks a little aside of its place.
//!
//! By how many whole pixels is a deviate's quantile, of which there are only a
//! few: counting how many of them twelve random bits reach is done for many
//! pixels at once, while looking each up in a table is not.

use multiversion::multiversion;

use super::noise::Gaussians;
use super::raster::Canvas;

/// No pixel looks so far aside.
const MOST: u16 = 16;

/// Lateral noise of one strength, and its lists for a row.
pub(super) struct Lateral {
    /// Least pixels aside, counted from [`MOST`] less.
    least: u16,
    /// The bits from which on it is one more, and one more again.
    steps: Vec<u16>,
    /// Twelve bits for each pixel, across and down.
    random: [Vec<u16>; 2],
    /// Pixels aside, counted from [`MOST`] less.
    aside: [Vec<u16>; 2],
}

impl Lateral {
    /// Noise of so many pixels standard deviation for rows of so many.
    pub fn new(deviation: f32, length: usize) -> Self {
        let pixels = |deviate: f32| (deviation * deviate + f32::from(MOST) + 0.5) as u16;
        let table = Gaussians::shared().tabled(pixels).values;
        let (least, most) = (table[0], table[table.len() - 1]);
        let steps = (least + 1..=most).map(|aside| table.partition_point(|other| *other < aside) as u16).collect();
        let lists = || [vec![0; length], vec![0; length]];
        Self { least, steps, random: lists(), aside: lists() }
    }

    /// Where the pixels of a row look with their random bits, as numbers of pixels.
    pub fn aim(&mut self, places: &mut [u32], bits: &[u32], row: usize, canvas: &Canvas) {
        aim(self, places, bits, row, [canvas.width, canvas.height]);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512dq+avx512vl", "x86_64+avx2", "x86_64+sse4.1"))]
fn aim(noise: &mut Lateral, places: &mut [u32], bits: &[u32], row: usize, size: [usize; 2]) {
    let [across, down] = &mut noise.random;
    for ((across, down), bits) in across.iter_mut().zip(down).zip(bits) {
        *across = (bits.wrapping_mul(0x9E37_79B1) >> 20) as u16;
        *down = (bits.wrapping_mul(0x85EB_CA77) >> 20) as u16;
    }
    for (aside, random) in noise.aside.iter_mut().zip(&noise.random) {
        aside.fill(noise.least);
        for step in &noise.steps {
            aside.iter_mut().zip(random).for_each(|(aside, random)| *aside += u16::from(random >= step));
        }
    }
    let [across, down] = &noise.aside;
    let [width, height] = size.map(|size| size as i32);
    let aimed =
        |here: usize, aside: u16, size: i32| (here as i32 + i32::from(aside) - i32::from(MOST)).clamp(0, size - 1);
    for (column, (place, (across, down))) in places.iter_mut().zip(across.iter().zip(down)).enumerate() {
        *place = (aimed(row, *down, height) * width + aimed(column, *across, width)) as u32;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Camera;

    #[test]
    fn pixels_look_as_far_aside_as_a_table_of_deviates_tells() {
        let camera = Camera { width: 50, height: 40, ..Camera::kinect() };
        let bits: Vec<u32> = (0..50_u32).map(|i| i.wrapping_mul(0x9E37_79B9)).collect();
        for deviation in [0.3, 0.8, 9.6] {
            let table = Gaussians::shared().tabled(|deviate| (deviation * deviate + 16.5) as u32);
            let aimed = |here: usize, bits: u32, size: usize| {
                (here + table.pick(bits >> 20) as usize).clamp(16, size + 15) - 16
            };
            for row in 0..40 {
                let mut places = vec![0; 50];
                Canvas::lend(&camera, |canvas| Lateral::new(deviation, 50).aim(&mut places, &bits, row, canvas));
                for (column, (place, bits)) in places.iter().zip(&bits).enumerate() {
                    let x = aimed(column, bits.wrapping_mul(0x9E37_79B1), 50);
                    let y = aimed(row, bits.wrapping_mul(0x85EB_CA77), 40);
                    assert_eq!(*place as usize, y * 50 + x, "pixel {column} of row {row}");
                }
            }
        }
    }
}

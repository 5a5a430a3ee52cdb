//! The colour picture: finish, light and pattern of the face each pixel shows.
//!
//! Of each row, the runs of one face lay out finish, pattern and noise in lists;
//! one pass over the lists makes the pixels. Runs go from left to right and
//! write whole groups of pixels: the next run overwrites what was too much.

use std::ops::Range;
use std::sync::OnceLock;

use multiversion::multiversion;

use super::faces::{Face, Point, Texture};
use super::noise::{Gaussians, Table, whole};
use super::raster::{Canvas, LANES, View};
use super::scatter::Scatter;

/// Light of a room.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// 1 for a well-lit room; the sensor's noise stays when it falls.
    pub level: f64,
    /// Share that comes from everywhere.
    pub ambient: f64,
    /// Where the rest comes from, a unit vector.
    pub from: [f64; 3],
    /// Its colour: red, green, blue about 1.
    pub tint: [f64; 3],
}

impl Default for Light {
    fn default() -> Self {
        Self { level: 1.0, ambient: 0.62, from: [0.36, 0.48, 0.8], tint: [1.0; 3] }
    }
}

/// Standard deviation of the colour camera's noise, levels of 255.
const NOISE: f32 = 2.5;
/// What shows where there is nothing.
const BACKDROP: [u8; 3] = [236, 238, 240];
/// Pixels along a side of a pattern.
const SIDE: usize = 64;

/// What the pixels of one face have in common.
struct Paint {
    color: [f32; 3],
    /// Pattern coordinates: at the eye, and per metre of depth as coefficients of column, row and one.
    eye: [f32; 2],
    over: [Point; 2],
    /// None of one tone.
    pattern: Option<&'static [f32; SIDE * SIDE]>,
}

impl Paint {
    fn new(view: &View, face: &Face, light: &Light) -> Self {
        let facing = face.normal.dot(&(face.corners[0] - view.eye)) < 0.0;
        let normal = if facing { face.normal } else { -face.normal };
        let meets: f64 = (0..3).map(|i| normal[i] * light.from[i]).sum::<f64>().max(-0.3);
        let strength = light.level * (light.ambient + (1.05 - light.ambient) * meets);
        let color = [0, 1, 2].map(|c| (f64::from(face.finish.color[c]) * strength * light.tint[c]) as f32);
        let (across, along) = scale(face.finish.texture);
        let (u, v) = pattern_axes(&normal, face);
        let (u, v) = (u * across, v * along);
        let over = [&u, &v].map(|axis| view.over_pixels(&view.turned(axis)));
        let eye = [view.eye.dot(&u) as f32, view.eye.dot(&v) as f32];
        Self { color, eye, over, pattern: pattern_of(face.finish.texture) }
    }
}

/// Axes within the face: level and up, or for a level face its longer side first.
fn pattern_axes(normal: &Point, face: &Face) -> (Point, Point) {
    if normal.z.abs() < 0.7 {
        let level = Point::new(-normal.y, normal.x, 0.0).normalize();
        return (level, normal.cross(&level));
    }
    let edge = |i: usize| face.corners[(i + 1) % face.corners.len()] - face.corners[i];
    let along = if edge(0).norm() > edge(1).norm() { edge(0) } else { edge(1) };
    let along = along.normalize();
    (normal.cross(&along), along)
}

/// Pattern pixels a metre, across and along.
fn scale(texture: Texture) -> (f64, f64) {
    match texture {
        Texture::Plain => (1.0, 1.0),
        Texture::Cloth => (130.0, 130.0),
        Texture::Wood => (140.0, 9.0),
        Texture::Boards => (66.0, 40.0),
        Texture::Tiles => (100.0, 100.0),
    }
}

/// Brightness pattern of a texture, [`SIDE`] × [`SIDE`].
fn pattern_of(texture: Texture) -> Option<&'static [f32; SIDE * SIDE]> {
    static PATTERNS: OnceLock<Box<[[f32; SIDE * SIDE]; 4]>> = OnceLock::new();
    let patterns = PATTERNS.get_or_init(|| {
        let grid = |value: fn(usize, usize) -> f32| std::array::from_fn(|i| value(i % SIDE, i / SIDE));
        Box::new([
            grid(|u, v| 0.93 + 0.14 * hash(u, v)),
            grid(|u, v| 0.86 + 0.2 * hash(u, 7) + 0.08 * hash(u, v)),
            grid(|u, v| if u % 8 == 0 { 0.8 } else { 0.92 + 0.12 * hash(u / 8, 3) + 0.05 * hash(u, v) }),
            grid(|u, v| if u % 32 == 0 || v % 32 == 0 { 0.78 } else { 0.95 + 0.08 * hash(u / 32, v / 32) }),
        ])
    });
    match texture {
        Texture::Plain => None,
        Texture::Cloth => Some(&patterns[0]),
        Texture::Wood => Some(&patterns[1]),
        Texture::Boards => Some(&patterns[2]),
        Texture::Tiles => Some(&patterns[3]),
    }
}

/// A fixed scattering of 0 to 1.
fn hash(u: usize, v: usize) -> f32 {
    let mut x = (u as u32).wrapping_mul(0x9E37_79B1) ^ (v as u32).wrapping_mul(0x85EB_CA77);
    x = (x ^ (x >> 15)).wrapping_mul(0x2C1B_3C6D);
    x = (x ^ (x >> 12)).wrapping_mul(0x297A_2D39);
    (x >> 8) as f32 / 16_777_216.0
}

/// The colour picture of a canvas.
pub(super) fn paint(view: &View, faces: &[Face], canvas: &Canvas, light: &Light, seed: u64) -> Vec<[u8; 3]> {
    let mut paints: Vec<Option<Paint>> = Vec::new();
    paints.resize_with(faces.len(), || None);
    let mut brush = Brush::new(canvas.width, seed);
    let mut picture = Vec::with_capacity(canvas.pixels());
    for row in 0..canvas.height {
        brush.dip(canvas, row);
        for (run, number) in canvas.runs(row) {
            if number == 0 {
                brush.leave(run);
                continue;
            }
            let face = number as usize - 1;
            let paint = paints[face].get_or_insert_with(|| Paint::new(view, &faces[face], light));
            brush.stroke(paint, &canvas.inverse[row * canvas.width..], run, row);
        }
        mix(&mut brush);
        picture.extend_from_slice(&brush.pixels[..canvas.width]);
    }
    picture
}

/// Lays out the colours of a row; each list is [`LANES`] longer than it.
struct Brush {
    table: Table<f32>,
    scatter: Scatter,
    bits: Vec<u32>,
    noise: Vec<f32>,
    /// Brightness of the pattern.
    tone: Vec<f32>,
    /// Red, green, blue in the light.
    color: [Vec<f32>; 3],
    pixels: Vec<[u8; 3]>,
}

impl Brush {
    fn new(width: usize, seed: u64) -> Self {
        let length = width + LANES;
        Self {
            table: Gaussians::shared().tabled(|deviate| NOISE * deviate),
            scatter: Scatter::new(seed),
            bits: vec![0; length],
            noise: vec![0.0; length],
            tone: vec![0.0; length],
            color: [0, 1, 2].map(|_| vec![0.0; length]),
            pixels: vec![[0; 3]; length],
        }
    }

    /// Draws the row's noise: only pixels that show something use up random numbers.
    fn dip(&mut self, canvas: &Canvas, row: usize) {
        let line = &canvas.face[row * canvas.width..(row + 1) * canvas.width];
        if line.iter().fold(true, |all, &face| all & (face > 0)) {
            self.scatter.fill(&mut self.bits[..line.len()]);
        } else {
            let shown = canvas.runs(row).filter(|(_, number)| *number > 0);
            shown.for_each(|(run, _)| self.scatter.fill(&mut self.bits[run]));
        }
        for (noise, bits) in self.noise.iter_mut().zip(&self.bits) {
            *noise = self.table.pick(*bits);
        }
    }

    /// Leaves a run to the backdrop.
    fn leave(&mut self, run: Range<usize>) {
        for (list, value) in self.color.iter_mut().zip(BACKDROP) {
            list[run.clone()].fill(f32::from(value));
        }
        self.tone[run.clone()].fill(1.0);
        self.noise[run].fill(0.0);
    }

    /// Lays out a run of a row that shows one face.
    fn stroke(&mut self, paint: &Paint, inverse: &[f32], run: Range<usize>, row: usize) {
        let filled = run.start..run.start + run.len().next_multiple_of(LANES);
        for (list, value) in self.color.iter_mut().zip(paint.color) {
            fill(&mut list[filled.clone()], value);
        }
        let tone = &mut self.tone[filled.clone()];
        match paint.pattern {
            None => fill(tone, 1.0),
            Some(pattern) => {
                let start = |axis: &Point| (axis.x * run.start as f64 + axis.y * row as f64 + axis.z) as f32;
                let [u, v] = &paint.over;
                let line = Line { eye: paint.eye, start: [start(u), start(v)], step: [u.x as f32, v.x as f32] };
                tones(&line, tone, &inverse[filled], pattern);
            }
        }
    }
}

/// Fills a list whose length is a multiple of [`LANES`].
fn fill(list: &mut [f32], value: f32) {
    list.as_chunks_mut::<LANES>().0.iter_mut().for_each(|group| *group = [value; LANES]);
}

/// Pattern coordinates along a run: at the eye, and per metre of depth at its start and by pixel.
struct Line {
    eye: [f32; 2],
    start: [f32; 2],
    step: [f32; 2],
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2", "x86_64+sse4.1"))]
fn tones(line: &Line, tone: &mut [f32], inverse: &[f32], pattern: &[f32; SIDE * SIDE]) {
    let groups = tone.as_chunks_mut::<LANES>().0.iter_mut().zip(inverse.as_chunks::<LANES>().0);
    for (group, (tone, inverse)) in groups.enumerate() {
        let spots = line.spots(group * LANES, inverse);
        for (tone, spot) in tone.iter_mut().zip(spots) {
            *tone = pattern[spot as usize % (SIDE * SIDE)];
        }
    }
}

impl Line {
    /// Where in the pattern each pixel of a group lies.
    #[inline(always)]
    fn spots(&self, first: usize, inverse: &[f32; LANES]) -> [u32; LANES] {
        let mut spots = [0; LANES];
        for lane in 0..LANES {
            let depth = 1.0 / inverse[lane];
            let i = (first + lane) as i32 as f32;
            let u = wrapped(self.eye[0] + (self.start[0] + i * self.step[0]) * depth);
            let v = wrapped(self.eye[1] + (self.start[1] + i * self.step[1]) * depth);
            // A lane without a surface has no spot: what wraps there is not looked at.
            spots[lane] = v.wrapping_mul(SIDE as u32).wrapping_add(u);
        }
        spots
    }
}

/// A coordinate cut off to an integer, modulo [`SIDE`].
#[inline(always)]
fn wrapped(coordinate: f32) -> u32 {
    let cut = coordinate.trunc();
    whole(cut - (cut / SIDE as f32).floor() * SIDE as f32)
}

/// Makes the pixels of the row that is laid out.
fn mix(brush: &mut Brush) {
    let [red, green, blue] = &brush.color;
    mix_lists(&mut brush.pixels, [red, green, blue], &brush.tone, &brush.noise);
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2", "x86_64+sse4.1"))]
fn mix_lists(pixels: &mut [[u8; 3]], color: [&[f32]; 3], tone: &[f32], noise: &[f32]) {
    let [red, green, blue] = color.map(|list| list.as_chunks::<LANES>().0);
    let groups = red.iter().zip(green).zip(blue);
    let shade = tone.as_chunks::<LANES>().0.iter().zip(noise.as_chunks::<LANES>().0);
    for ((pixels, ((red, green), blue)), (tone, noise)) in
        pixels.as_chunks_mut::<LANES>().0.iter_mut().zip(groups).zip(shade)
    {
        for lane in 0..LANES {
            let level = |color: f32| whole((color * tone[lane] + noise[lane]).clamp(0.0, 255.0)) as u8;
            pixels[lane] = [level(red[lane]), level(green[lane]), level(blue[lane])];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_wrap_as_integers_do() {
        for i in -3000..3000 {
            for coordinate in [i as f32 * 0.37, i as f32 * 64.0, i as f32 * 12_345.6] {
                assert_eq!(wrapped(coordinate), (coordinate as i32 & (SIDE as i32 - 1)) as u32, "{coordinate}");
            }
        }
    }
}

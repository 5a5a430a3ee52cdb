//! From the Kinect's own numbers to metres, seen from its colour camera.

use crate::frame::{Intrinsics, RgbdFrame};

/// Pixels across and down, of both pictures.
pub(super) const WIDTH: usize = 640;
pub(super) const HEIGHT: usize = 480;
/// What the sensor says where nothing came back, and the largest of its eleven bits.
const NOTHING: u16 = 2047;
/// The published calibration of one Kinect (Nicolas Burrus, Kinect calibration, 2011); others differ by a few pixels.
const DEPTH_CAMERA: Intrinsics = Intrinsics { fx: 594.21, fy: 591.04, cx: 339.31, cy: 242.74 };
const COLOR_CAMERA: Intrinsics = Intrinsics { fx: 529.22, fy: 525.56, cx: 328.94, cy: 267.48 };
/// Where the depth camera's points lie for the colour camera, metres; the two look the same way within half a degree.
const DEPTH_TO_COLOR: [f64; 3] = [0.01999, -0.00074, -0.01092];

/// Metres along the optical axis of the depth camera (Stéphane Magnenat's fit, OpenKinect); none where nothing came back.
pub(super) fn metres(raw: u16) -> Option<f64> {
    let metres = 0.1236 * (f64::from(raw) / 2842.5 + 1.1863).tan();
    (raw < NOTHING && (0.3..10.0).contains(&metres)).then_some(metres)
}

/// A frame of the colour camera: `depth` is little-endian eleven-bit numbers, `color` red, green and blue.
pub(super) fn registered(depth: &[u8], color: &[u8], world_from_camera: [[f64; 4]; 4]) -> RgbdFrame {
    let mut millimetres = vec![0_u16; WIDTH * HEIGHT];
    for (pixel, bytes) in depth.chunks_exact(2).enumerate() {
        let Some(z) = metres(u16::from_le_bytes([bytes[0], bytes[1]])) else { continue };
        let Some((at, z)) = in_color_camera((pixel % WIDTH) as f64, (pixel / WIDTH) as f64, z) else { continue };
        // What is nearer hides what is farther off.
        let (new, old) = ((z * 1000.0).round() as u16, millimetres[at]);
        if old == 0 || new < old {
            millimetres[at] = new;
        }
    }
    RgbdFrame {
        width: WIDTH,
        height: HEIGHT,
        color: color.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect(),
        depth: millimetres,
        depth_unit_m: 0.001,
        intrinsics: COLOR_CAMERA,
        world_from_camera,
    }
}

/// The pixel of the colour camera, and its depth there, of a pixel of the depth camera.
fn in_color_camera(column: f64, row: f64, z: f64) -> Option<(usize, f64)> {
    let (d, c) = (DEPTH_CAMERA, COLOR_CAMERA);
    let x = (column - d.cx) / d.fx * z + DEPTH_TO_COLOR[0];
    let y = (row - d.cy) / d.fy * z + DEPTH_TO_COLOR[1];
    let z = z + DEPTH_TO_COLOR[2];
    let (column, row) = ((x / z * c.fx + c.cx).round(), (y / z * c.fy + c.cy).round());
    let inside = (0.0..WIDTH as f64).contains(&column) && (0.0..HEIGHT as f64).contains(&row);
    inside.then_some((row as usize * WIDTH + column as usize, z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sensors_numbers_become_metres_that_grow_with_them_and_end_with_its_range() {
        let seen: Vec<f64> = (0..=NOTHING).filter_map(metres).collect();
        assert!(seen.windows(2).all(|pair| pair[0] < pair[1]) && seen.len() > 1000);
        // A step of one is 2 mm near by and some 5 cm at four metres, as the sensor's resolution is described.
        let step = |at: f64| seen.windows(2).find(|pair| pair[1] > at).map(|pair| pair[1] - pair[0]).expect("in range");
        assert!(step(0.8) < 0.003 && (0.03..0.06).contains(&step(4.0)), "{} {}", step(0.8), step(4.0));
        assert_eq!(metres(NOTHING), None);
    }

    #[test]
    fn the_middle_of_a_flat_wall_stays_a_flat_wall_with_its_colours() {
        let depth: Vec<u8> = [800_u16.to_le_bytes(); WIDTH * HEIGHT].concat();
        let color = [10, 20, 30].repeat(WIDTH * HEIGHT);
        let frame = registered(&depth, &color, [[0.0; 4]; 4]);
        let expected = ((metres(800).expect("something") + DEPTH_TO_COLOR[2]) * 1000.0).round() as u16;
        let middle = (100..380).flat_map(|row| (100..540).map(move |column| row * WIDTH + column));
        let (seen, all) =
            middle.fold((0, 0), |(seen, all), at| (seen + usize::from(frame.depth[at] == expected), all + 1));
        // The colour camera sees a wider field: no pixel stays empty.
        assert_eq!(seen, all);
        assert_eq!(frame.color[5], [10, 20, 30]);
    }
}

//! Where pixels look, and where points show.

use std::ops::RangeInclusive;

use super::RgbdFrame;

impl RgbdFrame {
    /// The camera's place in the world, metres.
    pub fn eye(&self) -> [f64; 3] {
        [0, 1, 2].map(|k| self.world_from_camera[k][3])
    }

    /// The ray of a pixel: world direction per metre of depth.
    pub fn ray(&self, column: usize, row: usize) -> [f64; 3] {
        let i = &self.intrinsics;
        let (x, y) = ((column as f64 - i.cx) / i.fx, (row as f64 - i.cy) / i.fy);
        let m = &self.world_from_camera;
        [0, 1, 2].map(|k| m[k][0] * x + m[k][1] * y + m[k][2])
    }

    /// Column and row of a point of the world, which may lie outside the picture, and its depth, metres; nothing behind
    /// the camera or nearer than 0.2 m.
    pub fn pixel(&self, point: [f64; 3]) -> Option<(f64, f64, f64)> {
        let (m, eye) = (&self.world_from_camera, self.eye());
        let d = [0, 1, 2].map(|k| point[k] - eye[k]);
        let [x, y, z] = [0, 1, 2].map(|axis| (0..3).map(|k| m[k][axis] * d[k]).sum::<f64>());
        let i = &self.intrinsics;
        (z > 0.2).then(|| (i.cx + i.fx * x / z, i.cy + i.fy * y / z, z))
    }

    /// The point of the world that shows at a pixel at a depth, metres.
    pub fn point(&self, column: usize, row: usize, depth: f64) -> [f64; 3] {
        let (eye, ray) = (self.eye(), self.ray(column, row));
        [0, 1, 2].map(|k| eye[k] + ray[k] * depth)
    }

    /// The units of depth from the least to the greatest of some depths, metres, with a margin to both sides; never 0,
    /// which is none.
    pub fn units_between(&self, depths: impl Iterator<Item = f64>, margin_m: f64) -> RangeInclusive<u16> {
        let (near, far) = depths.fold((f64::INFINITY, 0.0_f64), |(near, far), z| (near.min(z), far.max(z)));
        // Conversions to u16 saturate.
        let units = |depth: f64| (depth / self.depth_unit_m) as u16;
        units(near - margin_m).max(1)..=units(far + margin_m)
    }

    /// Depth at a pixel, metres; nothing outside the picture or where nothing came back.
    pub fn depth_at(&self, column: f64, row: f64) -> Option<f64> {
        let inside = column > -0.5 && row > -0.5 && column < self.width as f64 - 0.5 && row < self.height as f64 - 0.5;
        let depth = inside.then(|| self.depth[row.round() as usize * self.width + column.round() as usize])?;
        (depth > 0).then(|| f64::from(depth) * self.depth_unit_m)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Intrinsics;

    #[test]
    fn a_point_on_the_ray_of_a_pixel_shows_at_that_pixel() {
        let frame = RgbdFrame {
            width: 4,
            height: 3,
            color: Vec::new(),
            depth: (1..=12).collect(),
            depth_unit_m: 0.001,
            intrinsics: Intrinsics { fx: 5.0, fy: 5.0, cx: 1.5, cy: 1.0 },
            world_from_camera: [
                [0.0, 0.0, 1.0, 2.0],
                [-1.0, 0.0, 0.0, 3.0],
                [0.0, -1.0, 0.0, 1.2],
                [0.0, 0.0, 0.0, 1.0],
            ],
        };
        let (column, row, depth) = frame.pixel(frame.point(3, 2, 2.5)).expect("ahead");
        assert!((column - 3.0).abs() < 1e-9 && (row - 2.0).abs() < 1e-9 && (depth - 2.5).abs() < 1e-9);
        assert_eq!(frame.depth_at(column, row), Some(0.012));
        assert_eq!((frame.depth_at(4.0, 2.0), frame.depth_at(-1.0, 2.0)), (None, None));
        assert_eq!(frame.pixel([1.0, 3.0, 1.2]), None);
    }
}

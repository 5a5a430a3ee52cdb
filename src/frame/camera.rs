//! A camera on a robot's tower: which place of the picture shows which point in space.

use super::CameraMount;
use crate::geometry::{Pose, Vec2};

/// A pinhole camera on the robot's tower, looking ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Pixels.
    pub width: usize,
    /// Pixels.
    pub height: usize,
    /// Focal length, pixels.
    pub focal: f64,
    /// Metres above the floor.
    pub tower_m: f64,
    /// Looking down by this much, radians.
    pub tilt: f64,
    /// Nearer than this the sensor is blind, metres.
    pub near_m: f64,
}

impl Camera {
    /// A Kinect at 640 × 480 with 62.7° × 49.1°, 1.2 m up, 15° down.
    pub fn kinect() -> Self {
        let mount = CameraMount::default();
        Self { width: 640, height: 480, focal: 525.0, tower_m: 0.0, tilt: 0.0, near_m: 0.1 }.mounted(mount)
    }

    /// The same camera elsewhere on the robot.
    pub fn mounted(self, mount: CameraMount) -> Self {
        Self { tower_m: mount.height_m, tilt: mount.tilt_deg.to_radians(), ..self }
    }

    /// The same view with fewer pixels.
    pub fn coarser(self, factor: usize) -> Self {
        let f = factor as f64;
        Self { width: self.width / factor, height: self.height / factor, focal: self.focal / f, ..self }
    }

    /// Column, row and depth of a point in space; nothing behind the camera.
    pub fn project(&self, pose: Pose, point: Vec2, height: f64) -> Option<(f64, f64, f64)> {
        let local = pose.to_local(point);
        let (sin, cos) = self.tilt.sin_cos();
        let up = height - self.tower_m;
        let depth = local.x * cos - up * sin;
        if depth < self.near_m {
            return None;
        }
        let down = -local.x * sin - up * cos;
        let column = (self.width as f64 - 1.0) / 2.0 - self.focal * local.y / depth;
        let row = (self.height as f64 - 1.0) / 2.0 + self.focal * down / depth;
        Some((column, row, depth))
    }

    /// The camera's right, down and ahead in world axes, of a robot at `pose`.
    pub fn axes(&self, pose: Pose) -> [[f64; 3]; 3] {
        let (sin, cos) = self.tilt.sin_cos();
        let (across, along) = pose.heading.sin_cos();
        [[across, -along, 0.0], [-along * sin, -across * sin, -cos], [along * cos, across * cos, -sin]]
    }

    /// Camera optical frame (x right, y down, z ahead) to world, 4 × 4 by rows, of a robot at `pose`.
    pub fn world_from_camera(&self, pose: Pose) -> [[f64; 4]; 4] {
        let ([x, y, z], eye) = (self.axes(pose), [pose.x, pose.y, self.tower_m]);
        let row = |i: usize| [x[i], y[i], z[i], eye[i]];
        [row(0), row(1), row(2), [0.0, 0.0, 0.0, 1.0]]
    }

    /// Whether a pixel lies in the picture.
    pub fn shows(&self, column: f64, row: f64) -> bool {
        (-0.5..self.width as f64 - 0.5).contains(&column) && (-0.5..self.height as f64 - 0.5).contains(&row)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::vec2;

    #[test]
    fn what_lies_to_the_left_is_left_in_the_picture() {
        let (column, _, _) = Camera::kinect().project(Pose::default(), vec2(2.0, 0.5), 0.5).expect("ahead");
        assert!(column < 319.5);
    }
}

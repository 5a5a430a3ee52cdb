//! What a camera on the robot's tower sees of a scene: who hides whom, and the frames of a Kinect.
//!
//! [`SolidScene::visibility`] counts rays: what ideal eyes see. [`Kinect::capture`]
//! renders colour and depth with the real sensor's faults, 640 × 480:
//!
//! ```
//! use rand_chacha::{ChaCha8Rng, rand_core::SeedableRng};
//! use spatial_fetch::world::camera::{Kinect, SolidScene};
//! use spatial_fetch::world::{RoomMap, Scene};
//!
//! let (map, scene) = (RoomMap::apartment(), Scene::apartment());
//! let solids = SolidScene::new(&map, &scene);
//! let mut rng = ChaCha8Rng::seed_from_u64(1);
//! let entry = map.entry_pose("living_room").expect("a door");
//! let (frame, ids) = Kinect::default().capture(&solids, entry, &mut rng);
//! assert_eq!((frame.depth.len(), ids.len()), (640 * 480, 640 * 480));
//! ```

mod colors;
mod depths;
mod faces;
mod kinect;
mod lateral;
mod noise;
mod raster;
mod scatter;
mod shadow;
mod solids;
mod visibility;

pub use colors::Light;
pub use depths::KinectFaults;
pub use faces::{Faces, Finish, Frustum, Point, Texture};
pub use kinect::Kinect;
pub use solids::SolidScene;
pub use visibility::{Seen, Visibility};

use crate::geometry::{Pose, Vec2, vec2};
use crate::world::CameraMount;
use crate::world::solid::Ray;

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

    /// The ray through a pixel (column to the right, row downward) of a robot at `pose`.
    ///
    /// One unit of its direction is one metre along the optical axis, so a hit's distance is its depth.
    pub fn ray(self, pose: Pose, column: f64, row: f64) -> Ray {
        self.rays(pose)(column, row)
    }

    /// [`Self::ray`] for many pixels: the angles' sines and cosines are taken once.
    pub fn rays(self, pose: Pose) -> impl Fn(f64, f64) -> Ray {
        let (sin, cos) = self.tilt.sin_cos();
        let (forward, across) = (pose.forward(), vec2(pose.heading.sin(), -pose.heading.cos()));
        move |column, row| {
            let right = (column - (self.width as f64 - 1.0) / 2.0) / self.focal;
            let down = (row - (self.height as f64 - 1.0) / 2.0) / self.focal;
            let direction = forward * (cos - down * sin) + across * right;
            Ray { origin: pose.position(), height: self.tower_m, direction, climb: -sin - down * cos }
        }
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

    /// Camera optical frame (x right, y down, z ahead) to world, 4 × 4 by rows, of a robot at `pose`.
    pub fn world_from_camera(&self, pose: Pose) -> [[f64; 4]; 4] {
        raster::View::new(*self, pose).world_from_camera()
    }

    /// Whether a pixel lies in the picture.
    pub fn shows(&self, column: f64, row: f64) -> bool {
        (-0.5..self.width as f64 - 0.5).contains(&column) && (-0.5..self.height as f64 - 0.5).contains(&row)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn projecting_a_point_on_a_pixels_ray_gives_that_pixel() {
        let camera = Camera::kinect();
        let pose = Pose::new(1.0, 2.0, 0.6);
        let ray = camera.ray(pose, 100.0, 400.0);
        let (column, row, depth) =
            camera.project(pose, ray.origin + ray.direction * 2.5, ray.height + ray.climb * 2.5).expect("ahead");
        assert!((column - 100.0).abs() < 1e-9 && (row - 400.0).abs() < 1e-9 && (depth - 2.5).abs() < 1e-9);
    }

    #[test]
    fn what_lies_to_the_left_is_left_in_the_picture() {
        let (column, _, _) = Camera::kinect().project(Pose::default(), vec2(2.0, 0.5), 0.5).expect("ahead");
        assert!(column < 319.5);
    }
}

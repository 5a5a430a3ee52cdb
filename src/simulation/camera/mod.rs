//! What a camera on the robot's tower sees of a scene: who hides whom, and the frames of a Kinect.
//!
//! [`SolidScene::visibility`] counts rays: what ideal eyes see. [`Kinect::capture`]
//! renders colour and depth with the real sensor's faults, 640 × 480:
//!
//! ```
//! use rand_chacha::{ChaCha8Rng, rand_core::SeedableRng};
//! use spatial_fetch::simulation::camera::{Kinect, SolidScene};
//! use spatial_fetch::map::RoomMap;
//! use spatial_fetch::simulation::Scene;
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

use super::solid::Ray;
use crate::frame::Camera;
use crate::geometry::{Pose, vec2};

impl Camera {
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
}

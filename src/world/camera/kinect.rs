//! A simulated Kinect: colour and depth of a scene, and whose pixels they are.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;

use super::colors::{Light, paint};
use super::depths::{KinectFaults, measure};
use super::faces::Faces;
use super::raster::{Canvas, View};
use super::{Camera, SolidScene};
use crate::frame::{Intrinsics, RgbdFrame};
use crate::geometry::Pose;

/// A Kinect on the robot's tower, with its faults, in some light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kinect {
    /// Intrinsics, height and tilt.
    pub camera: Camera,
    /// What is wrong with its depth.
    pub faults: KinectFaults,
    /// What its colour camera works in.
    pub light: Light,
}

impl Default for Kinect {
    fn default() -> Self {
        Self { camera: Camera::kinect(), faults: KinectFaults::default(), light: Light::default() }
    }
}

impl Kinect {
    /// The frame taken by a robot at `pose`, and of each pixel the item's id + 1.
    ///
    /// Items are numbered as in the scene, furniture first, then objects; 0 is floor, wall or nothing.
    pub fn capture(&self, scene: &SolidScene, pose: Pose, rng: &mut ChaCha8Rng) -> (RgbdFrame, Vec<u16>) {
        self.capture_faces(scene.faces(), pose, rng)
    }

    /// The same of bare faces, numbered by their own ids.
    pub fn capture_faces(&self, scene: &Faces, pose: Pose, rng: &mut ChaCha8Rng) -> (RgbdFrame, Vec<u16>) {
        let view = View::new(self.camera, pose);
        let mut canvas = Canvas::new(&self.camera);
        for (number, face) in (1..).zip(&scene.faces) {
            canvas.draw(&view, number, face);
        }
        let color = paint(&view, &scene.faces, &canvas, &self.light, rng.next_u64());
        let depth = measure(&view, &scene.faces, &canvas, &self.faults, rng.next_u64());
        let ids = canvas.face.iter().map(|&f| if f == 0 { 0 } else { scene.faces[f as usize - 1].id }).collect();
        let (cx, cy) = view.centre();
        let frame = RgbdFrame {
            width: self.camera.width,
            height: self.camera.height,
            color,
            depth,
            depth_unit_m: 0.001,
            intrinsics: Intrinsics { fx: self.camera.focal, fy: self.camera.focal, cx, cy },
            world_from_camera: view.world_from_camera(),
        };
        (frame, ids)
    }

    /// Pixels of the item of an id (from 1) if nothing stood before it.
    pub fn pixels_alone(&self, scene: &Faces, id: u16, pose: Pose) -> usize {
        let view = View::new(self.camera, pose);
        let mut canvas = Canvas::new(&self.camera);
        for (number, face) in (1..).zip(scene.faces.iter().filter(|face| face.id == id)) {
            canvas.draw(&view, number, face);
        }
        canvas.face.iter().filter(|&&face| face > 0).count()
    }
}

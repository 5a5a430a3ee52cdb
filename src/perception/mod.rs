//! What a robot's eyes report: furniture with pose, and the object.
//!
//! The executive sees only [`Eyes`]. [`truth`] is the ideal pair of eyes; it is
//! the one place here that may look at the scene.

mod classify;
mod detector;
mod floor_grid;
mod frame_files;
mod picture_files;
mod rectangle;
mod stage;
pub mod truth;

pub use detector::Detector;
pub use frame_files::{FrameError, FrameFiles, check};
pub use stage::Perceiver;

use crate::frame::RgbdFrame;
use crate::geometry::Pose;
use crate::record::Detection;

/// A camera with whatever makes detections of its pictures.
pub trait Eyes {
    /// What is seen now; `believed` is where the robot believes it stands, and the frame of the answer.
    fn look(&mut self, believed: Pose) -> View;

    /// Whether there is a camera at all.
    fn can_see(&self) -> bool {
        true
    }

    /// The camera's frame behind the last look; none for eyes without a camera.
    fn frame(&self) -> Option<&RgbdFrame> {
        None
    }
}

/// One look.
#[derive(Clone, Debug, Default)]
pub struct View {
    /// Furniture in the picture.
    pub furniture: Vec<Detection>,
    /// Small objects in the picture.
    pub objects: Vec<ObjectSighting>,
}

/// A small object in the picture.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjectSighting {
    /// What it is taken for.
    pub name: String,
    /// Metres, in the believed world frame.
    pub x: f64,
    /// Metres, in the believed world frame.
    pub y: f64,
    /// Whether a person could tell what it is from this picture: the paper's criterion of success.
    pub recognisable: bool,
}

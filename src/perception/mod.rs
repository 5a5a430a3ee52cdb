//! What a robot's eyes report: furniture with pose, and the object.
//!
//! [`Detector`] makes detections of a frame: points (`points`) are levelled
//! (`floor`) and projected onto a grid (`floor_grid`), walls are taken away
//! (`walls`), cells of equal height make patches (`patches`), a forest joins
//! patches into pieces (`joining`), another names them by what is measured of
//! them (`measures`), a third tells their fronts (`front`); footprints are
//! completed by what such pieces measure (`footprint`). All three are learned
//! from rooms of our own ([`training`]). [`FurnitureMap`] fuses views.
//!
//! The executive sees only [`Eyes`]. [`truth`], [`boxes`] and [`simulated`] are
//! the eyes of the simulated robot, from ideal to nothing true; they are the
//! only places here that may look at the scene.

mod beyond;
pub mod boxes;
mod describe;
mod detector;
mod external;
mod floor;
mod floor_grid;
mod footprint;
mod forest;
mod frame_files;
mod front;
mod fusion;
mod items;
mod joining;
mod measures;
mod model;
pub mod objects;
mod overlay;
mod patches;
mod picture_files;
mod points;
mod reconsider;
mod rectangle;
mod scenes;
mod segment;
pub mod simulated;
mod stage;
mod tabletop;
pub mod training;
pub mod truth;
mod upright;
mod walls;

pub use detector::Detector;
pub use external::{ExternalDetector, ExternalError};
pub use frame_files::{FrameError, FrameFiles, check};
pub use fusion::FurnitureMap;
pub use model::Model;
pub use overlay::overlay;
pub use scenes::{GridMap, SceneRecord, SceneView, Scenes, scene_of};
pub use stage::{Perceiver, text_line};

use crate::frame::RgbdFrame;
use crate::geometry::Pose;
use crate::record::Detection;

/// A camera with whatever makes detections of its pictures.
pub trait Eyes {
    /// What is seen now; `believed` is where the robot believes it stands, and the frame of the answer.
    fn look(&mut self, believed: Pose) -> View;

    /// What has been seen on the way, without waiting for it; none when nothing new is at hand.
    fn glimpse(&mut self, believed: Pose) -> Option<View> {
        Some(self.look(believed))
    }

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

impl ObjectSighting {
    /// Metres between two, on the floor.
    pub fn distance_to(&self, other: &Self) -> f64 {
        f64::hypot(self.x - other.x, self.y - other.y)
    }
}

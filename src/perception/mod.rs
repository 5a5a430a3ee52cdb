//! What a robot's eyes report: furniture with pose, and the object.
//!
//! [`Detector`] makes detections of a frame: points (`points`) are levelled
//! (`floor`) and projected onto a grid (`floor_grid`), walls are taken away
//! (`walls`), cells of equal height make patches (`patches`), a forest joins
//! patches into pieces (`joining`), another names them by what is measured of
//! them (`measures`), a third tells their fronts (`front`); footprints are
//! completed by what such pieces measure (`footprint`). All three are learned
//! from rooms of our own (`simulation::training`). [`FurnitureMap`] fuses views.
//!
//! The executive sees only [`Eyes`]. What it sees comes from pictures only: nothing here can name the scene, and the
//! eyes of the simulated robot are in `simulation::eyes`.

mod answer;
mod beyond;
mod describe;
pub(crate) mod detector;
mod external;
pub(crate) mod floor;
pub(crate) mod floor_grid;
pub(crate) mod footprint;
pub(crate) mod forest;
mod frame_error;
mod frame_files;
pub(crate) mod front;
mod fusion;
pub(crate) mod items;
pub(crate) mod joining;
pub(crate) mod measures;
pub(crate) mod model;
mod network;
pub mod objects;
mod overlay;
pub(crate) mod parts;
pub(crate) mod patches;
mod picture_files;
pub(crate) mod points;
mod reconsider;
mod rectangle;
pub(crate) mod scenes;
pub(crate) mod segment;
mod stage;
pub(crate) mod tabletop;
pub(crate) mod upright;
pub(crate) mod walls;

pub use answer::{Answer, Mask, PictureBox};
pub use detector::{Detector, furniture_chance};
pub use external::{ExternalDetector, ExternalError};
pub use frame_error::FrameError;
pub use frame_files::{FrameFiles, check};
pub use fusion::{FurnitureMap, Fused, SAME_PLACE_M, associated, outline};
pub use model::Model;
pub use overlay::overlay;
pub use scenes::{GridMap, SceneRecord, SceneView, Scenes, scene_of};
pub use stage::{Perceiver, text_line};
pub use upright::{CAMERA_HEIGHTS_M, CAMERA_TILTS_DEG, Depths, NoPose, Told, camera_over_floor};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::frame::RgbdFrame;
use crate::geometry::Pose;
use crate::record::{Detection, Part};

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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
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

impl Part for Vec<ObjectSighting> {
    const KEY: &'static str = "objects";
}

impl ObjectSighting {
    /// Metres between two, on the floor.
    pub fn distance_to(&self, other: &Self) -> f64 {
        f64::hypot(self.x - other.x, self.y - other.y)
    }
}

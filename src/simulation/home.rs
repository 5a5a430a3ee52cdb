//! A home to drive in: its room map and its scene.

use std::path::Path;
use std::rc::Rc;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::camera::{Kinect, SolidScene};
use super::scene::Item;
use super::ways::ShortestWays;
use super::{SHIPPED_HOMES, Scene, load_world};
use crate::frame::Camera;
use crate::frame::RgbdFrame;
use crate::geometry::Pose;
use crate::map::{RoomMap, WorldError, load_map};
use crate::recording::TruePiece;

/// A room map with the scene on it. For other rooms or furniture make another: its shortest ways are kept.
#[derive(Clone, Debug)]
pub struct Home {
    /// What the robot knows.
    pub map: RoomMap,
    /// What is true.
    pub scene: Scene,
    pub(super) ways: ShortestWays,
}

impl Home {
    /// A scene on the map it was made for.
    pub fn new(map: RoomMap, scene: Scene) -> Self {
        Self { map, scene, ways: ShortestWays::default() }
    }

    /// A shipped home by its name, or a scene file with the map it leads to; the apartment where none is named.
    ///
    /// `map` stands in for the room map of a scene file that leads to none.
    ///
    /// # Errors
    /// When there is no such home, or a file cannot be read or describes a world that cannot be.
    pub fn load(map: Option<&Path>, world: Option<&Path>) -> Result<Self, WorldError> {
        let (map, scene) = match (map, world) {
            (Some(map), Some(scene)) => {
                let map = load_map(map)?;
                let scene = Scene::load(scene, &map)?;
                (map, scene)
            }
            (None, Some(world)) => load_world(world)?,
            (_, None) => SHIPPED_HOMES[0].load(),
        };
        Ok(Self::new(map, scene))
    }

    /// The simulated robot's camera.
    pub fn camera(&self) -> Camera {
        Camera::kinect().mounted(self.scene.camera.unwrap_or_default())
    }

    /// What truly stands here, as plots and logs show it.
    pub fn pieces(&self) -> Vec<TruePiece> {
        let piece = |item: &Item| TruePiece {
            id: item.id.clone(),
            noun: item.kind().noun.to_string(),
            corners: item.footprint().corners().to_vec(),
            height: item.size().height,
            front: item.has_front().then_some(item.pose().heading),
            holds: self.scene.objects_on(item).map(|o| (o.name.clone(), o.pose_on(item).position())).collect(),
        };
        self.scene.furniture.iter().map(piece).collect()
    }

    /// What the camera of a robot at `pose` shows, without noise that differs from time to time.
    pub fn take_picture(&self, pose: Pose) -> RgbdFrame {
        let solids = SolidScene::new(&self.map, &self.scene);
        let kinect = Kinect { camera: self.camera(), ..Kinect::default() };
        kinect.capture(&solids, pose, &mut ChaCha8Rng::seed_from_u64(0)).0
    }

    /// The scene, to be shared within one trial.
    pub(super) fn shared_scene(&self) -> Rc<Scene> {
        Rc::new(self.scene.clone())
    }
}

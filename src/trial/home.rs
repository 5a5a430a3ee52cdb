//! A home to drive in: its room map and its scene.

use std::path::Path;
use std::rc::Rc;

use super::judge::ShortestWays;
use crate::world::camera::Camera;
use crate::world::{RoomMap, SHIPPED_HOMES, Scene, WorldError, load_map, load_world};

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
    pub fn load(map: Option<&Path>, world: Option<&Path>) -> Result<Self, WorldError> {
        let (map, scene) = match (map, world) {
            (Some(map), Some(scene)) => {
                let map = load_map(map)?;
                let scene = Scene::load(scene, &map)?;
                (map, scene)
            }
            (None, Some(world)) => load_world(world)?,
            (_, None) => SHIPPED_HOMES[0].load()?,
        };
        Ok(Self::new(map, scene))
    }

    /// A home of which only the rooms are known: where a real robot drives.
    pub fn unfurnished(map: RoomMap) -> Self {
        let (version, name) = (1, "unknown".to_string());
        let scene = Scene {
            version,
            name,
            map: map.name.clone(),
            furniture: Vec::new(),
            objects: Vec::new(),
            noise: None,
            camera: None,
        };
        Self::new(map, scene)
    }

    /// The simulated robot's camera.
    pub fn camera(&self) -> Camera {
        Camera::kinect().mounted(self.scene.camera.unwrap_or_default())
    }

    /// The scene, to be shared within one trial.
    pub(super) fn shared_scene(&self) -> Rc<Scene> {
        Rc::new(self.scene.clone())
    }
}

//! A home to drive in: its room map and its scene.

use std::path::Path;
use std::rc::Rc;

use crate::world::{RoomMap, Scene, WorldError};

/// A room map with the scene on it.
#[derive(Clone, Debug)]
pub struct Home {
    /// What the robot knows.
    pub map: RoomMap,
    /// What is true.
    pub scene: Scene,
}

impl Home {
    /// The home of the given files; the apartment where none is named.
    pub fn load(map: Option<&Path>, scene: Option<&Path>) -> Result<Self, WorldError> {
        let map = map.map_or_else(|| Ok(RoomMap::apartment()), RoomMap::load)?;
        let scene = match scene {
            Some(path) => Scene::load(path, &map)?,
            None => Scene::apartment(),
        };
        crate::world::check(&scene, &map, "the embedded scene")?;
        Ok(Self { map, scene })
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
            noise: Default::default(),
        };
        Self { map, scene }
    }

    /// The scene, to be shared within one trial.
    pub(super) fn shared_scene(&self) -> Rc<Scene> {
        Rc::new(self.scene.clone())
    }
}

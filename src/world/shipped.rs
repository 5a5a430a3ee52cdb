//! The homes that come with the program, so that a bare binary works.

use super::error::WorldError;
use super::{RoomMap, Scene};

/// A home embedded in the program.
#[derive(Clone, Copy, Debug)]
pub struct ShippedHome {
    /// What `--world` calls it.
    pub name: &'static str,
    /// Its room map, JSON.
    map: &'static str,
    /// Its scene, JSON.
    scene: &'static str,
}

/// All shipped homes; the first is the one used where none is named.
pub const SHIPPED_HOMES: &[ShippedHome] = &[
    ShippedHome {
        name: "apartment",
        map: include_str!("../../fixtures/apartment.map.json"),
        scene: include_str!("../../fixtures/apartment.scene.json"),
    },
    ShippedHome {
        name: "apartment-modified",
        map: include_str!("../../fixtures/apartment.map.json"),
        scene: include_str!("../../fixtures/apartment-modified.scene.json"),
    },
    ShippedHome {
        name: "studio",
        map: include_str!("../../fixtures/studio.map.json"),
        scene: include_str!("../../fixtures/studio.scene.json"),
    },
    ShippedHome {
        name: "flat",
        map: include_str!("../../fixtures/flat.map.json"),
        scene: include_str!("../../fixtures/flat.scene.json"),
    },
    ShippedHome {
        name: "l-shaped",
        map: include_str!("../../fixtures/l-shaped.map.json"),
        scene: include_str!("../../fixtures/l-shaped.scene.json"),
    },
];

impl ShippedHome {
    /// The shipped home of that name.
    pub fn named(name: &str) -> Option<&'static Self> {
        SHIPPED_HOMES.iter().find(|home| home.name == name)
    }

    /// Its room map.
    pub fn map(&self) -> Result<RoomMap, WorldError> {
        RoomMap::from_json(self.map, &format!("{} (room map)", self.name))
    }

    /// Its room map and its scene.
    pub fn load(&self) -> Result<(RoomMap, Scene), WorldError> {
        let map = self.map()?;
        let scene = Scene::from_json(self.scene, &format!("{} (scene)", self.name), &map)?;
        Ok((map, scene))
    }

    /// The names of all shipped homes, for people.
    pub(super) fn names() -> String {
        SHIPPED_HOMES.iter().map(|home| home.name).collect::<Vec<_>>().join(", ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shipped_home_is_sound_and_has_something_to_find() {
        for home in SHIPPED_HOMES {
            let (map, scene) = home.load().expect("a sound home");
            assert!(map.rooms_by_distance().len() >= 2, "{}", home.name);
            assert!(scene.objects.len() >= 6, "{}", home.name);
        }
    }
}

//! The scenes of the homes that come with the program.

use crate::map::{SHIPPED_MAPS, ShippedMap};

/// A home embedded in the program.
#[derive(Clone, Copy, Debug)]
pub struct ShippedHome {
    /// Its room map, and its name.
    pub map: ShippedMap,
    /// Its scene, JSON.
    pub(super) scene: &'static str,
}

/// All shipped homes, in the order of their maps; the first is the one used where none is named.
pub const SHIPPED_HOMES: &[ShippedHome] = &[
    ShippedHome { map: SHIPPED_MAPS[0], scene: include_str!("../../fixtures/apartment.scene.json") },
    ShippedHome { map: SHIPPED_MAPS[1], scene: include_str!("../../fixtures/apartment-modified.scene.json") },
    ShippedHome { map: SHIPPED_MAPS[2], scene: include_str!("../../fixtures/studio.scene.json") },
    ShippedHome { map: SHIPPED_MAPS[3], scene: include_str!("../../fixtures/flat.scene.json") },
    ShippedHome { map: SHIPPED_MAPS[4], scene: include_str!("../../fixtures/l-shaped.scene.json") },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shipped_home_is_sound_and_has_something_to_find() {
        assert_eq!(SHIPPED_HOMES.len(), SHIPPED_MAPS.len());
        for home in SHIPPED_HOMES {
            let (_, scene) = home.load();
            assert!(scene.objects.len() >= 6, "{}", home.map.name);
        }
    }
}

//! The room maps of the homes that come with the program, so that a bare binary works.

use super::room_map::RoomMap;

/// A room map embedded in the program.
#[derive(Clone, Copy, Debug)]
pub struct ShippedMap {
    /// What `--world` and `--map` call the home.
    pub name: &'static str,
    /// JSON.
    json: &'static str,
}

const fn home(name: &'static str, json: &'static str) -> ShippedMap {
    ShippedMap { name, json }
}

/// Those of all shipped homes; the first is the one used where none is named.
pub const SHIPPED_MAPS: &[ShippedMap] = &[
    home("apartment", include_str!("../../fixtures/apartment.map.json")),
    home("apartment-modified", include_str!("../../fixtures/apartment.map.json")),
    home("studio", include_str!("../../fixtures/studio.map.json")),
    home("flat", include_str!("../../fixtures/flat.map.json")),
    home("l-shaped", include_str!("../../fixtures/l-shaped.map.json")),
];

impl ShippedMap {
    /// Its room map.
    ///
    /// # Panics
    /// When what is embedded is no sound map: the program was built wrongly, and must not drive by an empty one.
    pub fn map(&self) -> RoomMap {
        let map = RoomMap::from_json(self.json, &format!("{} (room map)", self.name));
        map.unwrap_or_else(|error| panic!("embedded: {error}"))
    }

    /// The names of all shipped homes, for people.
    pub(super) fn names() -> String {
        SHIPPED_MAPS.iter().map(|home| home.name).collect::<Vec<_>>().join(", ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_embedded_map_is_sound_and_has_rooms_to_search() {
        for home in SHIPPED_MAPS {
            assert!(home.map().rooms_by_distance().len() >= 2, "{}", home.name);
        }
    }
}

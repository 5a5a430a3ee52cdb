//! World files are read or refused, and a world that was accepted can be looked at, without a panic.
#![no_main]

use libfuzzer_sys::fuzz_target;
use spatial_fetch::map::RoomMap;
use spatial_fetch::simulation::Scene;

fuzz_target!(|text: &str| {
    if let Ok(map) = RoomMap::from_json(text, "fuzz") {
        let _ = (map.walls(), map.room_at(map.start.position()));
        let _ = Scene::from_json(text, "fuzz", &map);
    }
    let apartment = RoomMap::apartment();
    if let Ok(scene) = Scene::from_json(text, "fuzz", &apartment) {
        for item in &scene.furniture {
            let _ = (item.footprint(), item.solids());
        }
    }
});

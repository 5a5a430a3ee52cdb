//! Files with bytes knocked out, doubled or changed are read or refused, never with a panic.
//!
//! The fuzz targets in `fuzz/` look further; these few hundred cases need no nightly toolchain.

use proptest::prelude::*;
use spatial_fetch::evaluation::{parse_tree, read_gold, score, with_texts};
use spatial_fetch::map::RoomMap;
use spatial_fetch::record::Record;
use spatial_fetch::simulation::Scene;

const MAP: &str = include_str!("../fixtures/apartment.map.json");
const SCENE: &str = include_str!("../fixtures/apartment.scene.json");

/// A text with up to four edits: where (a share of its length), how many characters go, what comes instead.
fn mangled(text: &'static str) -> impl Strategy<Value = String> {
    let edit = (0.0..1.0f64, 0usize..12, "[-0-9eE.{}\\[\\]\",:a-z é]{0,4}");
    prop::collection::vec(edit, 1..5).prop_map(move |edits| {
        let mut characters: Vec<char> = text.chars().collect();
        for (at, gone, new) in edits {
            let start = (at * characters.len() as f64) as usize;
            let end = (start + gone).min(characters.len());
            characters.splice(start..end, new.chars());
        }
        characters.into_iter().collect()
    })
}

fn first_templates() -> &'static str {
    let text = include_str!("../corpus/templates.jsonl");
    let end = text.match_indices('\n').nth(2).map_or(text.len(), |(at, _)| at);
    &text[..end]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(200) })]

    #[test]
    fn worlds(map in mangled(MAP), scene in mangled(SCENE)) {
        if let Ok(map) = RoomMap::from_json(&map, "map") {
            let _ = (map.walls(), map.room_at(map.start.position()));
            let _ = Scene::from_json(&scene, "scene", &map);
        }
        if let Ok(scene) = Scene::from_json(&scene, "scene", &RoomMap::apartment()) {
            for item in &scene.furniture {
                prop_assert!(!item.footprint().corners().is_empty() && !item.solids().is_empty());
            }
        }
    }

    #[test]
    fn corpora(text in mangled(first_templates())) {
        let gold = read_gold(&text, "gold").unwrap_or_default();
        let _ = with_texts(gold.clone(), gold.clone());
        let _ = score(&gold, &text.lines().map(str::to_string).collect::<Vec<_>>());
        let _ = parse_tree(&text);
    }

    #[test]
    fn records(line in mangled(r#"{"id":7,"text":"go left","chunks":[{"tag":"ORMTP","start":0,"end":7}],"x":[1.0,{"k":null}]}"#)) {
        if let Ok(record) = Record::parse(&line) {
            let written = serde_json::to_string(&record).expect("a record serializes");
            prop_assert!(Record::parse(&written).is_ok());
            let _ = record.get::<Vec<spatial_fetch::record::Chunk>>("chunks");
        }
    }
}

//! The schemas in `docs/schema/` are those of the types, and records keep to them.
//!
//! `UPDATE=1 cargo test --test schema` writes them anew.

mod common;

use common::{pipe, run};
use spatial_fetch::map::RoomMap;
use spatial_fetch::simulation::Scene;

fn compare(name: &str, schema: &serde_json::Value) {
    let path = format!("{}/docs/schema/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let text = format!("{schema:#}\n");
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(&path, &text).expect("written");
    }
    let stored = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(stored == text, "docs/schema/{name}.json differs from the types: run UPDATE=1 cargo test --test schema");
}

#[test]
fn the_schemas_of_all_stages_and_worlds_are_up_to_date() {
    for name in ["chunk", "ground", "plan", "drive", "hof", "perceive"] {
        let schema = run(name, &["--schema"], "").expect_code(0).out;
        compare(name, &serde_json::from_str(&schema).expect("JSON"));
    }
    compare("room-map", schemars::schema_for!(RoomMap).as_value());
    compare("scene", schemars::schema_for!(Scene).as_value());
}

#[test]
fn records_keep_to_their_schemas() {
    let out = pipe(
        &["chunk", "ground", "plan", "drive"],
        "um turn left no right and the fork is on the table behind the couch\n",
    );
    let record: serde_json::Value = serde_json::from_str(&out).expect("JSON");
    for (name, key) in [("ground", "grounding"), ("plan", "plan"), ("drive", "trial")] {
        let schema: serde_json::Value = serde_json::from_str(&run(name, &["--schema"], "").out).expect("JSON");
        let validator = jsonschema::validator_for(&schema).expect("a schema");
        let errors: Vec<String> = validator.iter_errors(&record[key]).map(|e| e.to_string()).collect();
        assert!(errors.is_empty(), "{key}: {errors:?}");
    }
}

#[test]
fn the_fixtures_keep_to_their_schemas() {
    let schema = schemars::schema_for!(Scene);
    let validator = jsonschema::validator_for(schema.as_value()).expect("a schema");
    let map_schema = schemars::schema_for!(RoomMap);
    let map_validator = jsonschema::validator_for(map_schema.as_value()).expect("a schema");
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures");
    for entry in std::fs::read_dir(folder).expect("the fixtures") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let text = || serde_json::from_str(&std::fs::read_to_string(&path).expect("read")).expect("JSON");
        if name.ends_with(".scene.json") {
            assert!(validator.is_valid(&text()), "{name}");
        } else if name.ends_with(".map.json") {
            assert!(map_validator.is_valid(&text()), "{name}");
        }
    }
}

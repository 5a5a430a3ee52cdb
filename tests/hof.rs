//! `hof` through the real executable.

mod common;

use common::run;

const SQUARES: &str = r#"{"id":"s","a":{"type":"Polygon","coordinates":[[[3,0],[4,0],[4,1],[3,1],[3,0]]]},"b":{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,1],[0,0]]]}}"#;

#[test]
fn forces_degrees_and_a_sentence_are_added() {
    let record =
        run("hof", &["--forces", "0,2,hybrid", "--directions", "8"], SQUARES).expect_code(0).records().remove(0);
    let hof = &record["hof"];
    assert_eq!(hof["forces"]["0"][0], 1.0);
    assert!((hof["forces"]["2"][0].as_f64().unwrap_or(0.0) - 0.117_783_035_656_383_46).abs() < 1e-12);
    assert!(hof["degrees"]["right"]["a"].as_f64().is_some_and(|a| a > 0.95));
    assert_eq!(hof["distance_m"], 2.0);
}

#[test]
fn a_force_that_diverges_is_said_to_be_infinite() {
    let touching = SQUARES.replace("[3,0],[4,0],[4,1],[3,1],[3,0]", "[1,0],[2,0],[2,1],[1,1],[1,0]");
    let record = run("hof", &[], touching).expect_code(0).records().remove(0);
    assert_eq!(record["hof"]["forces"]["2"], "infinite");
    assert!(record["hof"]["forces"]["hybrid"].is_array());
}

#[test]
fn a_bad_shape_is_called_by_its_fault() {
    let open = SQUARES.replace("[3,1],[3,0]]", "[3,1]]");
    let ran = run("hof", &[], open).expect_code(1);
    assert!(ran.err.contains("`a`: ring 1 is open") && ran.err.contains("(record \"s\")"), "{}", ran.err);
}

//! `ground` through the real executable.

mod common;

use common::{pipe, run};

fn grounding(text: &str) -> serde_json::Value {
    let out = pipe(&["chunk", "ground"], &format!("{text}\n"));
    serde_json::from_str::<serde_json::Value>(&out).expect("JSON")["grounding"].take()
}

#[test]
fn room_node_and_object_are_understood() {
    let g = grounding("the mug is in the bedroom on the left on the table to the right side behind the couch");
    assert_eq!((&g["room"]["name"], &g["room"]["side"]), (&"bedroom".into(), &"left".into()));
    assert_eq!(g["object"]["name"], "mug");
    let node = &g["nodes"][0];
    assert_eq!(node["target"], "table");
    let pairs: Vec<_> = node["pairs"]
        .as_array()
        .into_iter()
        .flatten()
        .map(|p| (p["reference"].clone(), p["direction"].clone()))
        .collect();
    assert_eq!(pairs, [("robot".into(), "right".into()), ("couch".into(), "back".into())]);
    assert_eq!(node["pairs"][1]["frame"], "viewer");
}

#[test]
fn what_was_taken_back_no_longer_counts() {
    assert_eq!(grounding("turn left no sorry turn right and find the book")["room"]["side"], "right");
}

#[test]
fn every_reading_is_explained_unless_brief() {
    let chunked = pipe(&["chunk"], "roll ahead and veer left and the vase will be on the desk\n");
    let full = run("ground", &[], &chunked).expect_code(0).records().remove(0);
    assert!(full["grounding"]["why"].as_array().is_some_and(|why| !why.is_empty()));
    let brief = run("ground", &["--brief"], &chunked).expect_code(0).records().remove(0);
    assert!(brief["grounding"]["why"].is_null());
}

#[test]
fn the_papers_method_grounds_by_the_nearest_example() {
    let chunked = pipe(&["chunk"], "drive ahead and bear right and you should spot the fork just to your right\n");
    let record = run("ground", &["--method", "paper"], chunked).expect_code(0).records().remove(0);
    assert_eq!(record["grounding"]["room"]["side"], "right");
    assert_eq!(record["grounding"]["object"]["name"], "fork");
}

#[test]
fn a_tree_that_does_not_fit_its_text_is_refused() {
    let ran =
        run("ground", &[], "{\"id\":\"x\",\"text\":\"é\",\"chunks\":[{\"tag\":\"OBTP\",\"start\":1,\"end\":9}]}\n");
    let ran = ran.expect_code(1);
    assert!(ran.err.contains("OBTP from byte 1 to 9 does not fit `text`"), "{}", ran.err);
}

#[test]
fn a_model_is_trained_written_and_used_in_every_variant() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = folder.path().join("model.json");
    let (model, corpus) =
        (model.to_str().expect("UTF-8"), concat!(env!("CARGO_MANIFEST_DIR"), "/corpus/training/descriptions.jsonl"));
    run("ground", &["--train", corpus, "-o", model], "").expect_code(0);
    let chunked = pipe(&["chunk"], "drive ahead and bear right and you should spot the fork just to your right\n");
    for factors in ["similarity", "prior", "all"] {
        for distance in ["plain", "weighted"] {
            let args = ["--method", "paper", "--model", model, "--factors", factors, "--distance", distance];
            let record = run("ground", &args, chunked.as_str()).expect_code(0).records().remove(0);
            assert!(record["grounding"]["why"][0]["because"].as_str().is_some_and(|why| why.contains("nearest")));
        }
    }
}

#[test]
fn a_training_file_without_labels_is_located() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("bare.jsonl");
    std::fs::write(&path, "{\"id\":\"a\",\"text\":\"the mug\",\"chunks\":[]}\n").expect("written");
    let ran = run("ground", &["--train", path.to_str().expect("UTF-8")], "").expect_code(1);
    assert!(ran.err.contains("bare.jsonl:1") && ran.err.contains("groundings"), "{}", ran.err);
}

#[test]
fn the_answer_to_the_question_settles_the_room() {
    let chunked = pipe(&["chunk"], "the mug is on the shelf behind the armchair\n");
    let asked = run("ground", &[], chunked.as_str()).expect_code(0).records().remove(0);
    assert!(asked["grounding"]["question"].is_string());
    let settled = run("ground", &["--answer", "the left one"], chunked).expect_code(0).records().remove(0);
    assert_eq!(settled["grounding"]["room"]["side"], "left");
    assert!(settled["grounding"]["question"].is_null());
}

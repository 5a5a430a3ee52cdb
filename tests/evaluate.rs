//! `evaluate` through the real executable.

mod common;

use common::{pipe, run};

#[test]
fn a_corpus_is_run_end_to_end_and_told_as_tables() {
    let text = run("evaluate", &["run", "--format", "text"], "").expect_code(0).out;
    assert!(text.contains("right first") && text.contains("95 % interval") && text.contains("table only"), "{text}");
}

#[test]
fn piped_records_are_scored_and_the_missing_are_named() {
    let gold = concat!(env!("CARGO_MANIFEST_DIR"), "/corpus/templates.jsonl");
    let corpus = std::fs::read_to_string(gold).expect("the corpus");
    let texts: String = corpus
        .lines()
        .skip(1)
        .map(|line| {
            let entry: serde_json::Value = serde_json::from_str(line).expect("JSON");
            format!("{}\n", serde_json::json!({"id": entry["id"], "text": entry["text"]}))
        })
        .collect();
    let ran = run("evaluate", &["score", "--gold", gold], pipe(&["chunk", "ground"], &texts)).expect_code(3);
    let scores: serde_json::Value = serde_json::from_str(&ran.out).expect("JSON");
    assert_eq!(scores["missing"], serde_json::json!(["t-001"]));
    assert_eq!(scores["all"]["object"]["of"], corpus.lines().count());
    assert_eq!(scores["all"]["found"]["of"], 0);
}

#[test]
fn a_gold_file_that_is_none_is_located() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("gold.jsonl");
    std::fs::write(&path, "{\"id\": 3}\n").expect("written");
    let ran = run("evaluate", &["score", "--gold", path.to_str().expect("UTF-8")], "{}\n").expect_code(1);
    assert!(ran.err.contains("gold.jsonl:1: no gold description"), "{}", ran.err);
}

#[test]
fn a_made_scene_is_one_file_that_can_be_driven_in_and_the_same_for_the_same_seed() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("home.json");
    let path = path.to_str().expect("UTF-8");
    for what in ["--keep", "--break", "--new"] {
        let made = |seed: &str| run("evaluate", &["scene", what, "--seed", seed], "").expect_code(0).out;
        assert_eq!(made("2"), made("2"));
        assert_ne!(made("2"), made("3"));
        run("evaluate", &["scene", what, "--seed", "2", "--force", "-o", path], "").expect_code(0);
        let grounded = pipe(&["chunk", "ground"], "find the book on the table\n");
        let plan = run("plan", &["--map", path], grounded).expect_code(0).out;
        let trial = run("drive", &["--world", path], plan).expect_code(0).records().remove(0)["trial"].take();
        assert_eq!(trial["collisions"], 0, "{trial}");
    }
}

#[test]
fn robustness_is_told_as_a_table_and_the_same_for_any_number_of_jobs() {
    let folder = tempfile::tempdir().expect("a folder");
    let gold = folder.path().join("gold.jsonl");
    let line = r#"{"id":"g-1","object":"mug","room":{"name":null,"side":"left"},"target":"nightstand","pairs":[],"nodes":[{"target":"nightstand","pairs":[["bed","side"]]}]}"#;
    std::fs::write(&gold, format!("{line}\n")).expect("written");
    let gold = gold.to_str().expect("UTF-8");
    let arguments = ["robustness", "--placements", "3", "--no-homes", "--gold", gold];
    let one = run("evaluate", &[&arguments[..], &["-j", "1"]].concat(), "").expect_code(0).out;
    let two = run("evaluate", &[&arguments[..], &["-j", "2"]].concat(), "").expect_code(0).out;
    assert_eq!(one, two);
    let scores: serde_json::Value = serde_json::from_str(&one).expect("JSON");
    assert_eq!((&scores["kept"]["trials"], &scores["gold"]["trials"]), (&3.into(), &1.into()));
    let text = run("evaluate", &[&arguments[..], &["--format", "text"]].concat(), "").expect_code(0).out;
    assert!(text.contains("placements that keep the relations") && text.contains("collisions"), "{text}");
}

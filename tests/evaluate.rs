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

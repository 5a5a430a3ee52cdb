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

/// The first descriptions of the corpus in a file of their own.
fn few(folder: &std::path::Path) -> String {
    let corpus = include_str!("../corpus/templates.jsonl");
    let lines: Vec<&str> = corpus.lines().take(3).collect();
    let path = folder.join("few.jsonl");
    std::fs::write(&path, lines.join("\n")).expect("written");
    path.to_str().expect("UTF-8").to_string()
}

#[test]
fn the_experiments_with_the_robot_stand_beside_the_papers_figures() {
    let folder = tempfile::tempdir().expect("a folder");
    let arguments = ["behavior", "--gold", &few(folder.path()), "--seeds", "2", "--explain", "--format", "text"];
    let text = run("evaluate", &arguments, "").expect_code(0).out;
    for part in
        ["Table II", "Table III", "90.1 %", "78.1 %", "least clearance", "blind", "3 instructions (gold), 2 trials"]
    {
        assert!(text.contains(part), "no {part} in\n{text}");
    }
}

#[test]
fn ablations_are_the_same_bytes_for_any_number_of_jobs() {
    let folder = tempfile::tempdir().expect("a folder");
    let gold = few(folder.path());
    let with = |jobs: &str| {
        let source = ["--instructions", "text", "--ablations", "--seeds", "1", "-j", jobs];
        run("evaluate", &[&["behavior", "--gold", &gold], &source[..]].concat(), "").expect_code(0).out
    };
    let one = with("1");
    assert_eq!(one, with("3"));
    let report: serde_json::Value = serde_json::from_str(&one).expect("JSON");
    let names: Vec<&str> =
        report["conditions"].as_array().expect("a list").iter().filter_map(|c| c["name"].as_str()).collect();
    assert!(names.contains(&"no localization") && names.contains(&"first pair only"), "{names:?}");
    assert_eq!(report["conditions"][0]["all"]["collisions"], 0);
}

#[test]
fn descriptions_without_labels_give_no_gold_instructions() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("bare.jsonl");
    std::fs::write(&path, "{\"id\":\"1\",\"text\":\"it is there\",\"chunks\":[]}\n").expect("written");
    let ran = run("evaluate", &["behavior", "--gold", path.to_str().expect("UTF-8")], "").expect_code(1);
    assert!(ran.err.contains("--gold needs labels"), "{}", ran.err);
}

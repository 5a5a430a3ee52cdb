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
fn the_papers_tables_and_the_report_are_the_same_bytes_for_any_number_of_jobs() {
    let folder = tempfile::tempdir().expect("a folder");
    let gold = few(folder.path());
    let tables = |jobs: &str| {
        let report = folder.path().join(jobs);
        let report = report.to_str().expect("UTF-8");
        let arguments = ["paper", "--gold", &gold, "--seeds", "2", "-j", jobs, "--report", report];
        let out = run("evaluate", &arguments, "").expect_code(0).out;
        (out, std::fs::read(format!("{report}/index.html")).expect("a report"))
    };
    let one = tables("1");
    assert!(one == tables("3"));
    let result: serde_json::Value = serde_json::from_str(&one.0).expect("JSON");
    assert_eq!(result["tables"].as_array().map(Vec::len), Some(3));
    let text = run("evaluate", &["paper", "--gold", &gold, "--seeds", "1", "--format", "text"], "").expect_code(0).out;
    assert!(text.contains("paper: robot") && text.contains("26/32 (64.7–91.1)"), "{text}");
}

#[test]
fn a_report_is_not_overwritten_without_force() {
    let folder = tempfile::tempdir().expect("a folder");
    let gold = few(folder.path());
    let report = folder.path().join("report");
    let arguments = ["paper", "--gold", &gold, "--seeds", "1", "--report", report.to_str().expect("UTF-8")];
    run("evaluate", &arguments, "").expect_code(0);
    let ran = run("evaluate", &arguments, "").expect_code(2);
    assert!(ran.err.contains("index.html exists"), "{}", ran.err);
}

#[test]
fn a_regression_fails_when_asked_to() {
    let folder = tempfile::tempdir().expect("a folder");
    let good = pipe(&["chunk", "ground", "plan", "drive"], "the mug is in the bedroom on the table by the chairs\n");
    let bad = good.replace("\"outcome\":\"found\"", "\"outcome\":\"not_found\"");
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("written");
        path.to_str().expect("UTF-8").to_string()
    };
    let (a, b) = (file("a.jsonl", &good), file("b.jsonl", &bad));
    let text = run("evaluate", &["compare", &a, &b, "--format", "text"], "").expect_code(0).out;
    assert!(text.contains("broken: 1") && text.contains("1: trial.outcome found → not_found"), "{text}");
    let ran = run("evaluate", &["compare", &a, &b, "--fail-on-regression"], "").expect_code(1);
    assert!(ran.err.contains("1 records broken"), "{}", ran.err);
    run("evaluate", &["compare", &b, &a, "--fail-on-regression"], "").expect_code(0);
    run("evaluate", &["compare", &a], "").expect_code(2);
}

#[test]
fn failures_are_charged_and_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let gold = few(folder.path());
    // Labelled with furniture that the words do not mean: whatever is understood, it is not that.
    let wrong = std::fs::read_to_string(&gold).expect("readable").replacen("round-table-1", "coffee-table-1", 1);
    std::fs::write(&gold, wrong).expect("written");
    let text = run("evaluate", &["blame", "--gold", &gold, "--format", "text"], "").expect_code(0).out;
    assert!(text.contains("1 of 3 descriptions failed: 33.3 % (6.1–79.2)"), "{text}");
}

#[test]
fn what_if_names_the_word_that_decides() {
    let sentence = "the mug is in the bedroom on the table by the chairs\n";
    let arguments = ["what-if", "--piece", "couch-1", "--format", "text"];
    let text = run("evaluate", &arguments, sentence).expect_code(0).out;
    assert!(text.contains("as it is: first to hexagon-table-1, found"), "{text}");
    assert!(text.contains("bedroom → living room"), "{text}");
    run("evaluate", &["what-if", "--piece", "sofa-9"], sentence).expect_code(2);
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
    assert!(names.contains(&"no localization") && names.contains(&"no glance, first pair only"), "{names:?}");
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

#[test]
fn what_would_be_ignored_or_overwritten_is_said_before_the_work_begins() {
    let folder = tempfile::tempdir().expect("a folder");
    let gold = few(folder.path());
    let ran = run("evaluate", &["paper", &gold], "").expect_code(2);
    assert!(ran.err.contains("few.jsonl: this subcommand takes no FILE") && ran.err.contains("--gold"), "{}", ran.err);
    let ran = run("evaluate", &["paper", "-o", &gold, "--gold", "/no/such/file"], "").expect_code(2);
    assert!(ran.err.contains("few.jsonl exists"), "{}", ran.err);
}

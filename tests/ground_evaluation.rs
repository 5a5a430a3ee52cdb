//! `evaluate chunking`, `grounding` and `import` through the real executable.

mod common;

use common::run;
use serde_json::Value;

fn fixture(name: &str) -> String {
    format!("{}/fixtures/import/{name}", env!("CARGO_MANIFEST_DIR"))
}

fn scores(args: &[&str]) -> Value {
    let out = run("evaluate", args, "").expect_code(0).out;
    serde_json::from_str(&out).expect("JSON")
}

#[test]
fn the_shipped_corpora_are_chunked_and_scored_by_tag() {
    let scores = scores(&["chunking"]);
    assert_eq!(scores.as_array().map(Vec::len), Some(2));
    let speech = &scores[1];
    assert!(speech["brackets"]["f1"].as_f64() > Some(0.75), "{}", speech["brackets"]);
    for tag in ["ORMTP", "ORMRP", "IRMRP", "FURTP", "FURRP", "OBTP", "OBRP", "PERS", "CONF"] {
        assert!(speech["by_tag"][tag]["recall"]["hit"].as_u64() > Some(0), "{tag}");
    }
    let text = run("evaluate", &["chunking", "--format", "text"], "").expect_code(0).out;
    assert!(text.contains("path labels") && text.contains("95 % interval"), "{text}");
}

/// The labels are what a person would write; that the program reads as many of them as it did is kept here.
#[test]
fn the_shipped_corpora_are_understood_and_noise_changes_little() {
    let scores = scores(&["grounding", "--noise", "0.1"]);
    for (corpus, least) in [(0, 0.97), (1, 0.93)] {
        let rates = &scores[corpus];
        let command = rates["from_text"]["composed"]["command"]["rate"].as_f64();
        assert!(command > Some(least), "{}: {command:?}", rates["corpus"]);
        for part in ["room", "object", "pairs"] {
            let kept = rates["noise"]["kept"][part].as_f64();
            assert!(kept >= Some(0.95), "{}: {part} {kept:?}", rates["corpus"]);
        }
    }
}

#[test]
fn both_methods_stand_side_by_side_and_every_variant_is_shown() {
    let corpus = concat!(env!("CARGO_MANIFEST_DIR"), "/corpus/templates.jsonl");
    let scores = scores(&["grounding", corpus, "--splits", "2"]);
    let scores = &scores[0];
    assert!(scores["from_text"]["paper"]["command"]["of"] == 180 && scores["from_gold_trees"]["paper"].is_object());
    let variants = scores["splits"].as_array().expect("variants");
    assert_eq!(variants.len(), 6);
    assert!(
        variants
            .iter()
            .all(|v| v["trained_on"] == 36 && v["commands"]["min"].as_f64() <= v["commands"]["max"].as_f64())
    );
    let again = run("evaluate", &["grounding", corpus, "--splits", "2", "-j", "1"], "").expect_code(0).out;
    assert_eq!(&serde_json::from_str::<Value>(&again).expect("JSON")[0], scores);
}

#[test]
fn gold_without_text_asks_for_the_texts() {
    let folder = tempfile::tempdir().expect("a folder");
    let (gold, texts) = (folder.path().join("gold.jsonl"), folder.path().join("texts.jsonl"));
    let meaning =
        r#"{"id":"a","object":"mug","room":{"name":null,"side":"left"},"target":"desk","pairs":[["bed","side"]]}"#;
    std::fs::write(&gold, meaning).expect("written");
    let text = r#"{"id":"a","text":"the mug is in the room on the left on the desk by the bed","chunks":[]}"#;
    std::fs::write(&texts, text).expect("written");
    let (gold, texts) = (gold.to_str().expect("UTF-8"), texts.to_str().expect("UTF-8"));
    let error = run("evaluate", &["grounding", gold], "").expect_code(1).err;
    assert!(error.contains("record \"a\" has no text") && error.contains("--texts"), "{error}");
    let scores = scores(&["grounding", gold, "--texts", texts]);
    assert_eq!(scores[0]["from_text"]["composed"]["command"]["hit"], 1);
    assert_eq!(scores[0]["disagreements"], serde_json::json!([]));
}

#[test]
fn the_authors_files_become_a_corpus_and_the_slip_is_told() {
    let (treebank, sheet) = (fixture("treebank.xml"), fixture("groundings.xlsx"));
    let ran = run("evaluate", &["import", &treebank, "--groundings", &sheet], "").expect_code(0);
    assert!(
        ran.err.contains("sentence 3 is a slip of the numbering; the chunks are those of sentence 2"),
        "{}",
        ran.err
    );
    let records: Vec<Value> = ran.out.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert_eq!(records.len(), 3);
    assert_eq!(records[0]["groundings"][3]["direction"], "central");
    assert_eq!(records[1]["groundings"][2]["direction"], "side");
    assert_eq!(records[2]["text"], "it 's on the table");
    let folder = tempfile::tempdir().expect("a folder");
    let corpus = folder.path().join("corpus.jsonl");
    std::fs::write(&corpus, &ran.out).expect("written");
    let scores = scores(&["grounding", corpus.to_str().expect("UTF-8")]);
    assert_eq!(scores[0]["from_text"]["composed"]["command"]["hit"], 3);
}

#[test]
fn a_treebank_that_is_none_says_so() {
    let ran = run("evaluate", &["import", &fixture("groundings.xlsx")], "").expect_code(1);
    assert!(ran.err.contains("groundings.xlsx"), "{}", ran.err);
    run("evaluate", &["import"], "").expect_code(2);
}

//! `chunk` through the real executable.

mod common;

use common::run;

fn tags(text: &str) -> Vec<String> {
    fn walk(chunks: &serde_json::Value, found: &mut Vec<String>) {
        for chunk in chunks.as_array().into_iter().flatten() {
            found.push(chunk["tag"].as_str().unwrap_or_default().to_string());
            walk(&chunk["chunks"], found);
        }
    }
    let record = run("chunk", &[], format!("{text}\n")).expect_code(0).records().remove(0);
    let mut found = Vec::new();
    walk(&record["chunks"], &mut found);
    found
}

#[test]
fn a_plain_line_becomes_a_record_with_tokens_and_chunks() {
    let record = run("chunk", &[], "The keys are on the table.\n").expect_code(0).records().remove(0);
    assert_eq!(record["id"], "1");
    assert_eq!(record["text"], "The keys are on the table.");
    assert_eq!(record["tokens"][1]["text"], "keys");
    assert_eq!(record["tokens"][1]["start"], 4);
}

#[test]
fn the_tree_nests_as_the_phrases_do() {
    let text = "the mug is in the bedroom on the left on the table to the right side behind the couch";
    assert_eq!(tags(text), ["OBTP", "ORMTP", "ORMRP", "FURTP", "IRMRP", "FURRP"]);
}

#[test]
fn text_draws_the_tree_and_explain_names_the_rules() {
    let drawn = run("chunk", &["--format", "text", "--explain"], "find the mug behind the couch\n").expect_code(0).out;
    assert!(drawn.contains("OBTP") && drawn.contains("└─ FURRP") && drawn.contains("{rel} {list}"), "{drawn}");
}

#[test]
fn odd_texts_get_an_answer() {
    let long = "go forward and turn left ".repeat(2000);
    for text in ["", "🤖🙂", "¿dónde está la mesa?", "()[]{}", "'s 's n't", long.as_str()] {
        let input = format!("{}\n", serde_json::json!({"id": "x", "text": text}));
        let record = run("chunk", &[], input).expect_code(0).records().remove(0);
        assert!(record["tokens"].is_array() && record["chunks"].is_array());
    }
}

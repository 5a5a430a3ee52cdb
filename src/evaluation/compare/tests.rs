use super::*;

fn lines(records: &[&str]) -> Vec<String> {
    records.iter().map(|record| (*record).to_string()).collect()
}

fn trial(id: &str, outcome: &str, right: bool) -> String {
    format!(
        r#"{{"id":"{id}","trial":{{"outcome":"{outcome}","why":"","final_pose":{{"x":0,"y":0,"heading":0}},"target_id":null,"approached":[],"right_first":{right},"duration_s":1,"distance_m":1,"spl":1,"collisions":0,"min_clearance_m":1,"actions":[],"path":[]}}}}"#
    )
}

fn compared(a: &[String], b: &[String], measure: Measure) -> Comparison {
    compare(("a", a), ("b", b), measure, false).expect("compared")
}

#[test]
fn a_changed_direction_is_named_with_its_field() {
    let a = lines(&[
        r#"{"id":42,"grounding":{"nodes":[{"pairs":[{"reference":"couch","direction":"right"}],"score":0.5}]}}"#,
    ]);
    let b = lines(&[
        r#"{"id":42,"grounding":{"nodes":[{"pairs":[{"reference":"couch","direction":"left"}],"score":0.4}]}}"#,
    ]);
    let comparison = compared(&a, &b, Measure::Found);
    assert_eq!(comparison.changes.len(), 1);
    assert!(comparison_text(&comparison).contains("42: grounding.nodes.0.pairs.0.direction right → left"));
    let everything = compare(("a", &a), ("b", &b), Measure::Found, true).expect("compared");
    assert_eq!(everything.changes.len(), 2);
}

#[test]
fn fixed_and_broken_are_told_by_the_measure_asked_for() {
    let a = [trial("1", "not_found", false), trial("2", "found", true), trial("3", "found", true)];
    let b = [trial("1", "found", false), trial("2", "not_found", false), trial("3", "found", false)];
    let found = compared(&a, &b, Measure::Found);
    assert_eq!((found.fixed, found.broken), (vec!["1".to_string()], vec!["2".to_string()]));
    assert_eq!(found.mcnemar_p, Rounded(1.0));
    let first = compared(&a, &b, Measure::RightFirst);
    assert_eq!((first.fixed.len(), first.broken.len(), first.first.hit), (0, 2, 2));
}

#[test]
fn missing_extra_and_doubled_ids_are_named() {
    let a = [trial("1", "found", true), trial("2", "found", true), trial("2", "found", true)];
    let b = [trial("1", "found", true), trial("3", "found", true)];
    let comparison = compared(&a, &b, Measure::Found);
    assert_eq!((&comparison.missing[..], &comparison.extra[..]), (&["2".to_string()][..], &["3".to_string()][..]));
    assert_eq!(comparison.doubled, ["2"]);
    assert!(comparison.regressed() && comparison.first.of == 1);
}

#[test]
fn a_line_that_is_no_record_is_located() {
    let error = compare(("a.jsonl", &lines(&["{\"id\":1}", "{"])), ("b", &[]), Measure::Found, false);
    assert!(error.expect_err("no record").to_string().starts_with("a.jsonl:2: "));
}

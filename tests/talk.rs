//! A conversation, through the real executable.

mod common;

use common::{Ran, run};

fn talk(lines: &[&str], arguments: &[&str]) -> Ran {
    let arguments: Vec<&str> = ["--talk"].iter().chain(arguments).copied().collect();
    run("drive", &arguments, format!("{}\n", lines.join("\n"))).expect_code(0)
}

#[test]
fn a_question_is_a_record_and_the_next_line_its_answer() {
    let records = talk(&["find my mug", "where are you?", "the left one"], &[]).records();
    assert!(records[0]["question"].as_str().is_some_and(|asked| asked.starts_with("Which room")), "{}", records[0]);
    assert_eq!(records[1]["answer"], "I am in the hallway.");
    assert_eq!(records[2]["trial"]["outcome"], "found", "{}", records[2]);
    assert!(records[2]["answer"].as_str().is_some_and(|said| said.starts_with("Your mug is in the bedroom")));
}

#[test]
fn the_other_one_is_another_piece() {
    let records = talk(&["go to the table in the bedroom", "no, the other one"], &[]).records();
    let place = |at: usize| records[at]["trial"]["target_id"].clone();
    assert!(place(0).is_string() && place(1).is_string() && place(0) != place(1), "{records:?}");
}

#[test]
fn what_was_found_once_is_gone_to_without_a_question_the_next_time() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("seen.json");
    let remember = ["--remember", file.to_str().expect("UTF-8")];
    let first = talk(&["find my mug", "the left one"], &remember).records();
    let second = talk(&["find my mug"], &remember).records();
    assert!(first[0]["question"].is_string() && second[0]["question"].is_null());
    assert_eq!(second[0]["trial"]["outcome"], "found", "{}", second[0]);
}

#[test]
fn it_comes_back_to_where_the_person_is_from_another_room() {
    let records = talk(&["go to the table in the bedroom", "come back", "where are you?"], &[]).records();
    assert_eq!(records[1]["answer"], "Here I am.", "{}", records[1]);
    let (began, ended) = (&records[0]["trial"]["path"][0], &records[1]["trial"]["final_pose"]);
    let off = |axis: &str, at: usize| began[at].as_f64().zip(ended[axis].as_f64()).map(|(a, b)| (a - b).abs());
    assert!(off("x", 1).is_some_and(|m| m < 0.4) && off("y", 2).is_some_and(|m| m < 0.4), "{began} {ended}");
    assert_eq!(records[2]["answer"], "I am in the hallway.");
}

#[test]
fn it_says_why() {
    let said = talk(&["find my mug in the bedroom", "why?"], &["--format", "text"]).out;
    let lines: Vec<&str> = said.lines().collect();
    assert!(lines[1].starts_with("You said \"find my mug in the bedroom\"; "), "{said}");
}

#[test]
fn the_memory_of_another_home_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("seen.json");
    std::fs::write(&file, r#"{"map":"palace","furniture":[],"objects":[]}"#).expect("written");
    let refused = run("drive", &["--talk", "--remember", file.to_str().expect("UTF-8")], "why?\n").expect_code(1);
    assert!(refused.err.contains("remembers the home `palace`"), "{}", refused.err);
}

//! `plan` through the real executable.

mod common;

use common::{pipe, run};

fn plan(text: &str, code: i32) -> serde_json::Value {
    let grounded = pipe(&["chunk", "ground"], &format!("{text}\n"));
    run("plan", &[], grounded).expect_code(code).records().remove(0)["plan"].take()
}

#[test]
fn the_side_picks_the_room_and_the_steps_follow_in_order() {
    let plan = plan("roll ahead and veer left, advance to the middle of the room, make a right and find the mug", 0);
    assert_eq!((&plan["map"], &plan["room"]), (&"apartment".into(), &"bedroom".into()));
    let steps: Vec<_> = plan["actions"].as_array().into_iter().flatten().map(|a| a["do"].clone()).collect();
    assert_eq!(steps, ["enter", "go", "move", "search", "find"]);
}

#[test]
fn a_room_the_map_does_not_have_is_a_problem_that_lists_what_it_has() {
    let plan = plan("the keys are in the kitchen on the counter", 3);
    let problem = plan["problems"][0].as_str().unwrap_or_default();
    assert!(problem.contains("no room called `kitchen`") && problem.contains("`bedroom`"), "{problem}");
    assert_eq!(plan["actions"], serde_json::json!([]));
}

#[test]
fn text_numbers_the_steps() {
    let grounded = pipe(&["chunk", "ground"], "the mug is in the bedroom on the table behind the couch\n");
    let text = run("plan", &["--format", "text"], grounded).expect_code(0).out;
    assert!(text.contains("1. enter the bedroom") && text.contains("2. search table: back of the couch"), "{text}");
}

#[test]
fn a_wrong_map_is_refused_with_its_fault() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("home.json");
    let apartment = include_str!("../fixtures/apartment.map.json");
    std::fs::write(&path, apartment.replace("\"at\": [2.63, -1.41]", "\"at\": [2.63, -3.0]")).expect("written");
    let ran = run("plan", &["--map", path.to_str().expect("UTF-8")], "").expect_code(1);
    assert!(ran.err.contains("door `bedroom_door`: does not lie in a wall"), "{}", ran.err);
}

//! `drive` through the real executable.

mod common;

use common::{pipe, run};

fn planned(text: &str) -> String {
    pipe(&["chunk", "ground", "plan"], &format!("{text}\n"))
}

#[test]
fn the_robot_finds_the_mug_and_leaves_plot_picture_and_log() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_string();
    let (plot, log) = (file("way.svg"), file("trial-{id}.mcap"));
    let pictures = file("pictures");
    let arguments = ["--plot", &plot, "--picture", &pictures, "--record", &log];
    let ran =
        run("drive", &arguments, planned("the mug is in the bedroom on the table next to the chairs")).expect_code(0);
    let trial = &ran.records()[0]["trial"];
    assert_eq!(trial["outcome"], "found", "{trial}");
    assert_eq!((&trial["target_id"], &trial["right_first"]), (&"hexagon-table-1".into(), &true.into()));
    assert_eq!(trial["collisions"], 0);
    assert_eq!(trial["picture"], "1.png");
    assert!(std::fs::read_to_string(&plot).expect("a plot").contains("<svg"));
    assert!(std::fs::read(folder.path().join("pictures/1.png")).expect("a picture").starts_with(b"\x89PNG"));
    let records =
        spatial_fetch::recording::records(&folder.path().join("trial-1.mcap"), "/fetch/drive").expect("a log");
    assert_eq!(records, [ran.out.trim_end()]);
}

#[test]
fn a_wrong_relation_is_mended_by_looking_elsewhere() {
    let ran = run("drive", &["--no-glance"], planned("the fork is in the living room on the table with the chairs"))
        .expect_code(0);
    let trial = &ran.records()[0]["trial"];
    assert_eq!((&trial["outcome"], &trial["right_first"]), (&"found".into(), &false.into()));
    assert!(trial["approached"].as_array().is_some_and(|ids| ids.len() > 1));
}

#[test]
fn an_object_that_is_not_there_is_not_found_and_the_record_says_why() {
    let plan = planned("find the umbrella on a table in the bedroom");
    let ran = run("drive", &["--search-anyway"], plan).expect_code(0);
    let trial = &ran.records()[0]["trial"];
    assert_eq!(trial["outcome"], "not_found");
    assert!(
        trial["why"].as_str().is_some_and(|why| why.contains("no umbrella") && why.contains("looked at;")),
        "{trial}"
    );
}

#[test]
fn to_enter_the_room_it_stands_in_the_robot_need_not_move() {
    let plan = r#"{"id":"1","plan":{"map":"apartment","room":"hallway","actions":[{"do":"enter","room":"hallway"},{"do":"move","direction":"front","amount":{"meters":0.5}}],"problems":[]}}"#;
    let trial = run("drive", &[], plan).expect_code(0).records().remove(0)["trial"].take();
    assert_ne!(trial["outcome"], "blocked", "{trial}");
    assert_eq!((&trial["actions"][0]["why"], &trial["actions"][0]["end_s"]), (&"already there".into(), &0.0.into()));
}

#[test]
fn every_action_says_why() {
    let ran = run(
        "drive",
        &["--no-glance", "--format", "text"],
        planned("my statue stands on the nightstand to the right of the bed in the bedroom on your left"),
    );
    let text = ran.expect_code(0).out;
    assert!(text.contains("before") && text.contains("found: the statue is on"), "{text}");
}

#[test]
fn the_same_plan_gives_the_same_bytes() {
    let plan = planned("find the laptop in the living room");
    assert_eq!(run("drive", &["-j", "1"], &plan).out, run("drive", &[], &plan).out);
}

#[test]
fn a_plan_for_another_map_is_refused() {
    let plan = planned("find the laptop in the living room").replace("\"map\":\"apartment\"", "\"map\":\"castle\"");
    let ran = run("drive", &[], plan).expect_code(1);
    assert!(ran.err.contains("made for the map `castle`, the robot is in `apartment`"), "{}", ran.err);
}

#[test]
fn the_modified_home_is_driven_as_well() {
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/apartment-modified.scene.json");
    let ran = run("drive", &["--world", scene], planned("find the monitor in the bedroom")).expect_code(0);
    assert_eq!(ran.records()[0]["trial"]["outcome"], "found");
}

#[test]
fn the_robots_luck_hangs_on_the_seed_and_not_without_noise() {
    let plan = planned("find the laptop in the living room");
    let way = |arguments: &[&str]| run("drive", arguments, &plan).expect_code(0).out;
    assert_ne!(way(&["--seed", "1"]), way(&["--seed", "2"]));
    assert_eq!(way(&["--seed", "1", "--noise", "off"]), way(&["--seed", "2", "--noise", "off"]));
}

#[test]
fn a_scene_says_how_imperfect_the_robot_is_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = include_str!("../fixtures/apartment.scene.json");
    let exact = scene.replacen('{', "{\"noise\": {\"start_m\": 0, \"start_rad\": 0, \"slip\": 0.05},", 1);
    let path = folder.path().join("slippery.json");
    std::fs::write(&path, &exact).expect("written");
    let plan = planned("find the laptop in the living room");
    let scene = path.to_str().expect("UTF-8");
    let slippery = run("drive", &["--world", scene], &plan).expect_code(0).out;
    assert_ne!(slippery, run("drive", &[], &plan).out);
    std::fs::write(&path, exact.replace("slip", "glide")).expect("written");
    let ran = run("drive", &["--world", scene], &plan).expect_code(1);
    assert!(ran.err.contains("glide"), "{}", ran.err);
}

#[test]
fn a_shipped_home_is_driven_by_its_name_and_a_misspelt_one_lists_them() {
    let grounded = pipe(&["chunk", "ground"], "the laptop is in the living room on the desk\n");
    let plan = run("plan", &["--map", "studio"], grounded).expect_code(0).out;
    let trial = run("drive", &["--world", "studio"], plan).expect_code(0).records().remove(0)["trial"].take();
    assert_eq!((&trial["outcome"], &trial["target_id"]), (&"found".into(), &"desk-1".into()));
    let ran = run("drive", &["--world", "stduio"], "").expect_code(1);
    assert!(ran.err.contains("did you mean `studio`? Shipped are apartment,"), "{}", ran.err);
}

#[test]
fn a_world_that_cannot_be_is_refused_by_the_item_with_what_mends_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("home.scene.json");
    let scene = include_str!("../fixtures/apartment.scene.json");
    for (right, wrong, message) in [
        ("\"category\": \"couch\"", "\"category\": \"coach\"", "`coach`; did you mean `couch`?"),
        ("\"x\": 4.5, \"y\": 4,", "\"x\": 4.5, \"y\": 3,", "stands in the place of `couch-1`; move one of the two"),
        ("\"on\": \"round-table-1\"", "\"on\": \"round-tabel-1\"", "did you mean `round-table-1`?"),
        ("\"version\": 1", "\"version\": 2", "version 2 of the format; this program reads version 1"),
        ("\"map\": \"apartment\"", "\"map\": \"castle\"", "no room map `castle`: looked for"),
    ] {
        std::fs::write(&path, scene.replacen(right, wrong, 1)).expect("written");
        let ran = run("drive", &["--world", path.to_str().expect("UTF-8")], "").expect_code(1);
        assert!(ran.err.contains("home.scene.json") && ran.err.contains(message), "{}", ran.err);
    }
}

#[cfg(not(feature = "live"))]
#[test]
fn without_a_server_for_foxglove_live_says_how_to_build_one() {
    let ran = run("drive", &["--live"], "").expect_code(2);
    assert!(ran.err.contains("--live: this build has no server for Foxglove; build it with `--features live`"));
}

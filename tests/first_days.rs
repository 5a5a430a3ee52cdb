//! What a newcomer meets in the first two days, through the real executables.

mod common;

use common::{pipe, run};

fn planned(text: &str) -> String {
    pipe(&["chunk", "ground", "plan"], &format!("{text}\n"))
}

fn driven(text: &str, arguments: &[&str]) -> serde_json::Value {
    run("drive", arguments, planned(text)).expect_code(0).records().remove(0)["trial"].take()
}

#[test]
fn what_the_home_does_not_have_is_said_at_once_with_what_it_has() {
    let trial = driven("find my keys", &[]);
    assert_eq!((&trial["outcome"], &trial["duration_s"]), (&"not_found".into(), &0.0.into()));
    let why = trial["why"].as_str().expect("a reason");
    assert!(why.starts_with("this home has no keys; it has fork, glasses case, laptop, monitor, mug, statue"), "{why}");
}

#[test]
fn looked_for_all_the_same_each_piece_is_counted_once() {
    let trial = driven("find my keys", &["--search-anyway"]);
    let why = trial["why"].as_str().expect("a reason");
    assert!(why.contains("no keys on any of 6 pieces of furniture looked at"), "{why}");
}

#[test]
fn where_nothing_to_look_for_is_named_the_robot_arrives() {
    for (said, room) in [("bedroom", "bedroom"), ("go straight 2 meters", "hallway"), ("go home", "hallway")] {
        let trial = driven(said, &[]);
        assert_eq!(trial["outcome"], "arrived", "{said}: {trial}");
        let why = trial["why"].as_str().expect("a reason");
        assert_eq!(why, format!("in the {room}; nothing to look for was named"), "{said}");
    }
}

#[test]
fn text_calls_outcomes_and_furniture_as_records_do_and_fits_a_terminal() {
    let said = "the mug is in the bedroom on the table next to the chairs";
    let text = run("drive", &["--format", "text"], planned(said)).expect_code(0).out;
    assert!(text.contains("found: the mug is on hexagon table 1"), "{text}");
    assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
    let text = run("drive", &["--format", "text"], planned("find my keys")).expect_code(0).out;
    assert!(text.contains("\nnot found: this home has no keys"), "{text}");
}

#[test]
fn text_is_coloured_when_that_is_asked_for() {
    let plain = run("chunk", &["--format", "text"], "go left\n").expect_code(0).out;
    let colored = run("chunk", &["--format", "text", "--color", "always"], "go left\n").expect_code(0).out;
    assert!(!plain.contains('\x1b') && colored.starts_with("\x1b[1mgo left\x1b[0m"), "{colored:?}");
    let ended = run("drive", &["--format", "text", "--color", "always"], planned("bedroom")).expect_code(0).out;
    assert!(ended.contains("\x1b[32marrived: in the bedroom"), "{ended:?}");
}

#[test]
fn where_it_was_is_said_so_that_it_leads_back_to_the_same_piece() {
    for asked in ["find my mug", "find the fork", "find my laptop"] {
        let trial = driven(asked, &[]);
        let description = trial["description"].as_str().expect("a description").to_string();
        assert!(description.starts_with("Your ") && description.contains(" is in the "), "{description}");
        let again = driven(&description, &["--no-glance"]);
        assert_eq!(again["approached"][0], trial["target_id"], "{description}: {again}");
    }
}

#[test]
fn a_narration_tells_each_decision_in_plain_words_and_figures_are_asked_for_twice() {
    let plan = planned("the mug is in the bedroom on the table next to the chairs");
    let told = run("drive", &["-v"], &plan).expect_code(0).err;
    assert!(told.contains("going into the bedroom"), "{told}");
    assert!(told.contains("going to hexagon table 1, the best fit for \"next to the chair\""), "{told}");
    assert!(told.contains("1: found: the mug is on hexagon table 1"), "{told}");
    assert!(!told.contains("0.66"), "{told}");
    let figures = run("drive", &["-vv"], &plan).expect_code(0).err;
    assert!(figures.contains("off the heading"), "{figures}");
    assert_eq!(run("drive", &["-v", "-q"], &plan).expect_code(0).err, "");
}

#[test]
fn the_other_filters_tell_what_a_record_came_to() {
    let ran = run("ground", &["-v"], pipe(&["chunk"], "the mug is in the bedroom\n")).expect_code(0);
    assert!(ran.err.contains("object  mug"), "{}", ran.err);
    assert_eq!(ran.records().len(), 1);
}

#[test]
fn a_home_is_listed_as_text_as_json_and_drawn() {
    let folder = tempfile::tempdir().expect("a folder");
    let drawing = folder.path().join("home.svg");
    let drawing = drawing.to_str().expect("UTF-8");
    let text = run("drive", &["--world", "studio", "--list", "--format", "text"], "").expect_code(0).out;
    assert!(text.starts_with("studio: ") && text.contains("desk 1"), "{text}");
    let listed = run("drive", &["--world", "studio", "--list", "--plot", drawing], "").expect_code(0).records();
    assert_eq!(listed[0]["map"], "studio");
    assert!(listed[0]["objects"].as_array().is_some_and(|objects| objects.iter().any(|o| o["name"] == "laptop")));
    let svg = std::fs::read_to_string(drawing).expect("a drawing");
    assert!(svg.contains(">desk 1</text>") && svg.contains("objects"), "{svg}");
}

#[test]
fn a_plot_explains_itself_and_shows_what_was_looked_for_in_vain() {
    let folder = tempfile::tempdir().expect("a folder");
    let plot = folder.path().join("w.svg");
    let plan = planned("the mug is in the living room on the table next to the couch");
    run("drive", &["--plot", plot.to_str().expect("UTF-8")], plan).expect_code(0);
    let svg = std::fs::read_to_string(&plot).expect("a plot");
    for sign in ["start and heading", "order of visits", "front of a piece", "where the mug is", ">mug</text>"] {
        assert!(svg.contains(sign), "{sign}");
    }
    assert!(svg.contains("not found: ") && svg.contains(">2</text>"), "{svg}");
}

#[test]
fn a_page_of_ones_own_run_is_written_and_not_overwritten() {
    let folder = tempfile::tempdir().expect("a folder");
    let report = folder.path().join("report");
    let report = report.to_str().expect("UTF-8");
    let plan = planned("the mug is in the bedroom on the table next to the chairs");
    run("drive", &["--report", report], &plan).expect_code(0);
    let page = std::fs::read_to_string(folder.path().join("report/index.html")).expect("a page");
    assert!(page.contains("class=\"player\"") && page.contains("hexagon table 1"));
    // Style and script and one trial, which is to stay under 60 kB.
    assert!(page.len() < 75_000, "{} bytes", page.len());
    let ran = run("drive", &["--report", report], &plan).expect_code(2);
    assert!(ran.err.contains("index.html exists"), "{}", ran.err);
}

#[test]
fn a_table_goes_in_and_a_table_comes_out() {
    let table = "who,said\nAda,the mug is in the bedroom on the table\n\"B, C\",find my keys\n";
    let records = run("chunk", &["--csv", "said"], table).expect_code(0).out;
    let rows = run("drive", &["--format", "csv"], pipe(&["ground", "plan"], &records)).expect_code(0).out;
    let rows: Vec<&str> = rows.lines().collect();
    assert!(
        rows[0].starts_with("id,text,who,outcome,why,description,target_id,first_approached,right_first"),
        "{}",
        rows[0]
    );
    assert!(rows[1].starts_with("1,the mug is in the bedroom on the table,Ada,found,"), "{}", rows[1]);
    assert!(rows[2].starts_with("2,find my keys,\"B, C\",not_found,"), "{}", rows[2]);
    assert_eq!(rows.len(), 3);
    let ran = run("chunk", &["--format", "csv"], "go left\n").expect_code(2);
    assert!(ran.err.contains("rows are made by `drive`"), "{}", ran.err);
}

#[test]
fn scores_come_as_rows_as_well() {
    let gold = include_str!("../corpus/templates.jsonl").lines().next().expect("a description");
    let gold: serde_json::Value = serde_json::from_str(gold).expect("JSON");
    let record = serde_json::json!({"id": gold["id"], "text": gold["text"]}).to_string();
    let rows = run("evaluate", &["score", "--part", "--format", "csv"], pipe(&["chunk", "ground"], &record));
    let rows = rows.expect_code(0).out;
    assert!(rows.starts_with("by,group,measure,hit,of,share,low,high\nall,all,brackets found,"), "{rows}");
}

#[test]
fn a_table_that_is_taken_for_sentences_is_said_to_be_one() {
    let ran = run("chunk", &[], "id,text\n1,go left\n").expect_code(1);
    assert!(ran.err.contains("<stdin>:1:1: this reads like the heading of a table"), "{}", ran.err);
    assert!(ran.err.contains("--csv 'text'"), "{}", ran.err);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("said.csv");
    std::fs::write(&path, "a,b\n1,go left\n").expect("written");
    let ran = run("chunk", &[path.to_str().expect("UTF-8")], "").expect_code(2);
    assert!(ran.err.contains("name the column of its descriptions: --csv COLUMN"), "{}", ran.err);
    run("chunk", &[], "stop, go left, then text me\n").expect_code(0);
}

#[test]
fn what_is_no_text_is_told_by_its_kind_with_what_mends_it() {
    let ran = run("chunk", &[], b"\x1f\x8b\x08\x00\x00\n".as_slice()).expect_code(1);
    assert!(ran.err.contains("this is gzip; unpack it first") && !ran.err.contains("iconv"), "{}", ran.err);
    let utf16: Vec<u8> = "go left\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    let ran = run("chunk", &[], &utf16).expect_code(1);
    assert!(ran.err.contains("iconv -f UTF-16LE"), "{}", ran.err);
    assert_eq!(ran.out, "");
}

#[test]
fn a_sentence_in_the_place_of_a_file_is_told_where_it_belongs() {
    let ran = run("chunk", &["my mug is on the table"], "").expect_code(1);
    assert!(ran.err.contains("echo 'my mug is on the table' | chunk"), "{}", ran.err);
}

#[test]
fn help_puts_files_under_input() {
    for name in ["chunk", "ground", "plan", "drive"] {
        let help = run(name, &["--help"], "").expect_code(0).out;
        let heading = help.split("[FILE]...\n").next().map(|before| before.lines().rfind(|l| l.ends_with(':')));
        let place = help.find("\nInput:\n").expect("a heading of its own");
        assert!(help[place..].starts_with("\nInput:\n  [FILE]..."), "{name}: {heading:?}\n{help}");
    }
}

#[test]
fn evaluate_says_its_schema_without_a_subcommand() {
    let schema = run("evaluate", &["--schema"], "").expect_code(0).out;
    assert!(serde_json::from_str::<serde_json::Value>(&schema).is_ok());
}

#[test]
fn frames_are_files_in_a_folder_that_is_named_as_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("x");
    let path = path.to_str().expect("UTF-8");
    let ran = run("evaluate", &["frames", "--count", "1", "-o", path], "").expect_code(2);
    assert!(ran.err.contains("name their folder by --into"), "{}", ran.err);
    assert!(!folder.path().join("x").exists());
    assert!(run("perceive", &["--help"], "").out.contains("evaluate frames --count 10 --into frames"));
}

#[cfg(unix)]
#[test]
fn an_interrupt_says_which_file_is_not_there() {
    use std::io::{Read, Write};
    use std::process::{Command, Stdio};
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("out.jsonl");
    let mut child = Command::new(common::executable("chunk"))
        .args(["-o", path.to_str().expect("UTF-8")])
        .stdin(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("starts");
    let mut stdin = child.stdin.take().expect("piped");
    stdin.write_all(b"go left\n").expect("written");
    while std::fs::read_dir(folder.path()).expect("readable").count() == 0 {
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    std::thread::sleep(std::time::Duration::from_millis(300));
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill runs");
    assert!(killed.success());
    let mut err = String::new();
    child.stderr.take().expect("piped").read_to_string(&mut err).expect("UTF-8");
    assert_eq!(child.wait().expect("ends").code(), Some(130));
    assert!(err.contains("interrupted: ") && err.contains("out.jsonl was not written"), "{err}");
    assert!(!path.exists());
}

//! What each executable does when the world fails it: a full disk, a closed pipe, an interrupt.
#![cfg(target_os = "linux")]

mod common;

use std::fs::{File, OpenOptions};
use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;

use common::{executable, pipe, run};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use spatial_fetch::frame::Camera;
use spatial_fetch::geometry::Pose;
use spatial_fetch::map::RoomMap;
use spatial_fetch::perception::FrameFiles;
use spatial_fetch::simulation::Scene;
use spatial_fetch::simulation::camera::{Kinect, SolidScene};

/// Each filter with a record that it takes.
fn filters() -> Vec<(&'static str, String)> {
    let text = "the mug is in the bedroom on the table by the chairs\n".to_string();
    let chunked = pipe(&["chunk"], &text);
    let grounded = pipe(&["ground"], &chunked);
    let planned = pipe(&["plan"], &grounded);
    let shapes = r#"{"a":{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,0]]]},"b":{"type":"Polygon","coordinates":[[[3,0],[4,0],[4,1],[3,0]]]}}"#;
    vec![
        ("chunk", text),
        ("ground", chunked),
        ("plan", grounded),
        ("drive", planned),
        ("hof", format!("{shapes}\n")),
        ("perceive", frame_line()),
    ]
}

/// A line that names one rendered frame.
fn frame_line() -> String {
    static FOLDER: OnceLock<tempfile::TempDir> = OnceLock::new();
    let folder = FOLDER.get_or_init(|| {
        let folder = tempfile::tempdir().expect("a folder");
        let solids = SolidScene::new(&RoomMap::apartment(), &Scene::apartment());
        let kinect = Kinect { camera: Camera::kinect().coarser(4), ..Kinect::default() };
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let (frame, _) = kinect.capture(&solids, Pose::new(3.0, 2.0, 0.4), &mut rng);
        let [rgb, depth] = ["rgb.png", "depth.png"].map(|name| folder.path().join(name));
        std::fs::write(&rgb, frame.color_png()).expect("written");
        std::fs::write(&depth, frame.depth_png()).expect("written");
        let line = serde_json::to_string(&FrameFiles::of(&frame, rgb, depth)).expect("a line");
        std::fs::write(folder.path().join("frames.jsonl"), format!("{line}\n")).expect("written");
        folder
    });
    std::fs::read_to_string(folder.path().join("frames.jsonl")).expect("readable")
}

/// The quick subcommands of `evaluate` with what they need: each writes something.
fn experiments(folder: &Path) -> Vec<Vec<String>> {
    let file = |name: &str, text: &str| {
        let path = folder.join(name);
        std::fs::write(&path, text).expect("written");
        path.display().to_string()
    };
    let corpus = include_str!("../corpus/templates.jsonl");
    let gold = file("gold.jsonl", corpus.lines().next().unwrap_or_default());
    let driven = file("driven.jsonl", &pipe(&["chunk", "ground", "plan", "drive"], "the mug is on the table\n"));
    let scores = file("scores.json", &run("evaluate", &["score", "--gold", &gold, &driven], "").out);
    let fixture = |name: &str| format!("{}/fixtures/import/{name}", env!("CARGO_MANIFEST_DIR"));
    let words = |line: &str| line.split(' ').map(str::to_string).collect::<Vec<String>>();
    vec![
        words(&format!("score --gold {gold} {driven}")),
        words(&format!("merge {scores}")),
        words(&format!("compare {driven} {driven}")),
        words(&format!("chunking {gold}")),
        words(&format!("grounding {gold}")),
        words(&format!("import {}", fixture("treebank.xml"))),
        words(&format!("run --gold {gold}")),
        words(&format!("paper --seeds 1 --gold {gold}")),
        words(&format!("blame --gold {gold}")),
        words(&format!("behavior --seeds 1 --gold {gold}")),
        words("robustness --placements 1 --no-homes"),
        words("scene --keep"),
        [words("what-if --piece couch-1 --text"), vec!["the mug is on the table".to_string()]].concat(),
    ]
}

fn start(name: &str, arguments: &[&str], out: impl Into<Stdio>) -> Child {
    Command::new(executable(name))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(out)
        .stderr(Stdio::piped())
        .spawn()
        .expect("starts")
}

/// Feeds `input`, waits, and gives the exit code with what was said on standard error.
fn finish(mut child: Child, input: &str) -> (Option<i32>, String) {
    // A program that ends early closes the pipe: no failure of the test.
    let _ = child.stdin.take().expect("piped").write_all(input.as_bytes());
    let mut said = String::new();
    child.stderr.take().expect("piped").read_to_string(&mut said).expect("UTF-8");
    (child.wait().expect("ends").code(), said)
}

fn interrupt(child: &Child) {
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill runs");
    assert!(killed.success());
}

#[test]
fn a_full_disk_behind_standard_output_is_said_by_each() {
    for (name, input) in filters() {
        let full = OpenOptions::new().write(true).open("/dev/full").expect("a full disk");
        let (code, said) = finish(start(name, &[], full), &input);
        assert_eq!(code, Some(1), "{name}: {said}");
        assert!(said.contains("standard output: the disk is full"), "{name}: {said}");
    }
    let folder = tempfile::tempdir().expect("a folder");
    for arguments in experiments(folder.path()) {
        let full = OpenOptions::new().write(true).open("/dev/full").expect("a full disk");
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let (code, said) = finish(start("evaluate", &arguments, full), "");
        assert!(code == Some(1) && said.contains("the disk is full"), "{arguments:?}: {said}");
    }
}

#[test]
fn a_log_on_a_full_disk_is_said() {
    let planned = pipe(&["chunk", "ground", "plan"], "the mug is on the table\n");
    let ran = run("drive", &["--record", "/dev/full"], planned).expect_code(1);
    assert!(ran.err.contains("/dev/full: the disk is full; free space"), "{}", ran.err);
}

#[test]
fn an_output_that_cannot_be_made_is_named_before_any_work() {
    for (name, input) in filters() {
        let ran = run(name, &["-o", "/proc/no-such-folder/out.jsonl"], &input).expect_code(1);
        assert!(ran.err.contains("/proc/no-such-folder/out.jsonl: "), "{name}: {}", ran.err);
    }
    let folder = tempfile::tempdir().expect("a folder");
    for arguments in experiments(folder.path()) {
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).chain(["-o", "/proc/out.json"]).collect();
        let ran = run("evaluate", &arguments, "").expect_code(1);
        assert!(ran.err.contains("/proc/out.json: "), "{arguments:?}: {}", ran.err);
    }
}

#[test]
fn what_is_left_beside_the_records_is_named_when_it_cannot_be_made() {
    let planned = pipe(&["chunk", "ground", "plan"], "the mug is on the table\n");
    for option in ["--record", "--plot", "--picture"] {
        let ran = run("drive", &[option, "/proc/left"], &planned).expect_code(1);
        assert!(ran.err.contains("/proc/left"), "{option}: {}", ran.err);
    }
    let ran = run("perceive", &["--overlay", "/proc/left"], frame_line()).expect_code(1);
    assert!(ran.err.contains("/proc/left"), "{}", ran.err);
    for arguments in [["frames", "--count", "1", "--into"], ["train", "--count", "1", "-o"]] {
        let ran = run("evaluate", &[&arguments[..], &["/proc/left"]].concat(), "").expect_code(1);
        assert!(ran.err.contains("/proc/left"), "{arguments:?}: {}", ran.err);
    }
}

#[test]
fn a_closed_pipe_ends_each_quietly() {
    for (name, input) in filters() {
        let mut child = start(name, &[], Stdio::piped());
        drop(child.stdout.take());
        assert_eq!(finish(child, &input.repeat(3)), (Some(0), String::new()), "{name}");
    }
    let folder = tempfile::tempdir().expect("a folder");
    for arguments in experiments(folder.path()) {
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let mut child = start("evaluate", &arguments, Stdio::piped());
        drop(child.stdout.take());
        let (code, said) = finish(child, "");
        assert_eq!(code, Some(0), "{arguments:?}: {said}");
    }
}

#[test]
fn an_interrupt_ends_each_with_130_and_leaves_nothing_half_written() {
    for (name, input) in filters() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("out.jsonl");
        let mut child = start(name, &["-o", path.to_str().expect("UTF-8")], Stdio::null());
        // Held open until the end: waiting for a child closes what it still holds, and that would be the end of input.
        let mut stdin = child.stdin.take().expect("piped");
        stdin.write_all(input.as_bytes()).expect("written");
        // The temporary file shows that the handler is about to be or is in place.
        while std::fs::read_dir(folder.path()).expect("readable").count() == 0 {
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
        std::thread::sleep(std::time::Duration::from_millis(100));
        interrupt(&child);
        assert_eq!(child.wait().expect("ends").code(), Some(130), "{name}");
        assert_eq!(std::fs::read_dir(folder.path()).expect("readable").count(), 0, "{name}");
        drop(stdin);
    }
}

#[test]
fn a_run_that_ends_early_leaves_nothing_half_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let (path, good) = (folder.path().join("out.jsonl"), folder.path().join("good.txt"));
    std::fs::write(&good, "go left\n").expect("written");
    let files = [good.to_str().expect("UTF-8"), "no/such/file", "-o", path.to_str().expect("UTF-8")];
    run("chunk", &files, "").expect_code(1);
    assert_eq!(std::fs::read_dir(folder.path()).expect("readable").count(), 1);
}

#[test]
fn interrupted_pictures_are_whole_or_not_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let arguments = ["frames", "--count", "5000", "--into", folder.path().to_str().expect("UTF-8")];
    let child = start("evaluate", &arguments, Stdio::null());
    let pictures = || std::fs::read_dir(folder.path()).expect("readable").count();
    while pictures() < 9 {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    interrupt(&child);
    assert_eq!(finish(child, "").0, Some(130));
    for entry in std::fs::read_dir(folder.path()).expect("readable") {
        let path = entry.expect("readable").path();
        assert!(path.extension().is_some_and(|end| end == "png"), "{} was left", path.display());
        let bytes = std::fs::read(&path).expect("readable");
        assert!(bytes.ends_with(b"IEND\xaeB`\x82"), "{} is cut", path.display());
    }
}

#[test]
fn an_interrupted_experiment_ends_with_130_and_writes_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let (path, report) = (folder.path().join("tables.json"), folder.path().join("report"));
    let arguments =
        ["paper", "--seeds", "500", "-o", path.to_str().expect("UTF-8"), "--report", report.to_str().expect("UTF-8")];
    let child = start("evaluate", &arguments, Stdio::null());
    std::thread::sleep(std::time::Duration::from_millis(500));
    interrupt(&child);
    assert_eq!(finish(child, "").0, Some(130));
    assert!(!path.exists() && !report.exists());
}

#[test]
fn a_folder_that_is_a_file_is_said_by_the_report() {
    let folder = tempfile::tempdir().expect("a folder");
    let (gold, blocked) = (folder.path().join("gold.jsonl"), folder.path().join("blocked"));
    let templates = include_str!("../corpus/templates.jsonl");
    std::fs::write(&gold, templates.lines().next().unwrap_or_default()).expect("written");
    File::create(&blocked).expect("created");
    let arguments = [
        "paper",
        "--seeds",
        "1",
        "--gold",
        gold.to_str().expect("UTF-8"),
        "--report",
        blocked.to_str().expect("UTF-8"),
    ];
    let ran = run("evaluate", &arguments, "").expect_code(1);
    assert!(ran.err.contains("blocked: "), "{}", ran.err);
}

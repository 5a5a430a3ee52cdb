//! What each executable does when the world fails it: a full disk, a closed pipe, an interrupt.
#![cfg(target_os = "linux")]

mod common;

use std::fs::{File, OpenOptions};
use std::io::{Read, Write};
use std::process::{Child, Command, Stdio};

use common::{executable, pipe, run};

/// Each filter with a record that it takes.
fn filters() -> Vec<(&'static str, String)> {
    let text = "the mug is in the bedroom on the table by the chairs\n".to_string();
    let chunked = pipe(&["chunk"], &text);
    let grounded = pipe(&["ground"], &chunked);
    let planned = pipe(&["plan"], &grounded);
    let shapes = r#"{"a":{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,0]]]},"b":{"type":"Polygon","coordinates":[[[3,0],[4,0],[4,1],[3,0]]]}}"#;
    vec![("chunk", text), ("ground", chunked), ("plan", grounded), ("drive", planned), ("hof", format!("{shapes}\n"))]
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
    let full = OpenOptions::new().write(true).open("/dev/full").expect("a full disk");
    let (code, said) = finish(start("evaluate", &["run"], full), "");
    assert!(code == Some(1) && said.contains("the disk is full"), "{said}");
}

#[test]
fn an_output_that_cannot_be_made_is_named_before_any_work() {
    for (name, input) in filters() {
        let ran = run(name, &["-o", "/proc/no-such-folder/out.jsonl"], &input).expect_code(1);
        assert!(ran.err.contains("/proc/no-such-folder/out.jsonl: "), "{name}: {}", ran.err);
    }
}

#[test]
fn a_closed_pipe_ends_each_quietly() {
    for (name, input) in filters() {
        let mut child = start(name, &[], Stdio::piped());
        drop(child.stdout.take());
        assert_eq!(finish(child, &input.repeat(3)), (Some(0), String::new()), "{name}");
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

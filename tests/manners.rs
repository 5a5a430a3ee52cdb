//! The manners all seven executables share.

mod common;

use common::{ALL, run};

#[test]
fn each_says_its_version_and_helps_with_an_example() {
    for name in ALL {
        let version = run(name, &["--version"], "").expect_code(0);
        assert!(version.out.starts_with(&format!("{name} {}", env!("CARGO_PKG_VERSION"))), "{version:?}");
        assert!(run(name, &["--help"], "").expect_code(0).out.contains("Example"), "{name}");
    }
}

#[test]
fn an_unknown_option_is_a_usage_error() {
    for name in ALL {
        run(name, &["--no-such-option"], "").expect_code(2);
    }
}

#[test]
fn each_filter_prints_its_schema_and_a_completion_script() {
    for name in ["chunk", "ground", "plan", "drive", "hof", "perceive"] {
        let schema = run(name, &["--schema"], "").expect_code(0).out;
        assert!(serde_json::from_str::<serde_json::Value>(&schema).is_ok(), "{name}");
        assert!(run(name, &["--completions", "bash"], "").expect_code(0).out.contains(name));
    }
}

#[test]
fn a_missing_file_is_named_and_fails() {
    for name in ["chunk", "ground", "plan", "drive", "hof", "perceive"] {
        let ran = run(name, &["no/such/file.jsonl"], "").expect_code(1);
        assert!(ran.err.starts_with(&format!("{name}: no/such/file.jsonl: ")), "{ran:?}");
    }
}

#[test]
fn no_input_gives_no_output() {
    for name in ["chunk", "ground", "plan", "drive", "hof", "perceive"] {
        assert_eq!(run(name, &[], "").expect_code(0).out, "");
    }
}

#[test]
fn an_error_names_file_line_column_and_id_and_stops() {
    let ran =
        run("ground", &[], "{\"id\":\"a\",\"text\":\"x\",\"chunks\":[]}\n{\"id\":\"b\",\"text\": 7}\n{\"id\":\"c\"}\n");
    let ran = ran.expect_code(1);
    assert_eq!(ran.out.lines().count(), 1);
    assert!(ran.err.contains("ground: <stdin>:2:19: `text`: invalid type: integer"), "{}", ran.err);
    assert!(ran.err.contains("(record \"b\")") && !ran.err.contains("<stdin>:3"), "{}", ran.err);
}

#[test]
fn keep_going_reports_passes_on_and_exits_with_three() {
    let input = "{\"id\":1,\"text\":\"x\",\"chunks\":[]}\n{\"id\":2,\"extra\":[1.0,1e3]}\n[1,2]\n{\"id\":3,\"text\":\"x\",\"chunks\":[]}\n";
    let ran = run("ground", &["--keep-going"], input).expect_code(3);
    let lines: Vec<&str> = ran.out.lines().collect();
    assert_eq!(lines.len(), 3);
    assert_eq!(lines[1], "{\"id\":2,\"extra\":[1.0,1e3]}");
    assert!(ran.err.contains("<stdin>:3:1: ") && ran.err.contains("expected a record"), "{}", ran.err);
}

#[test]
fn a_half_line_at_the_end_is_said_to_be_one() {
    let ran = run("chunk", &["--keep-going"], "{\"id\":1,\"text\":\"ok\"}\n{\"id\":2,\"te").expect_code(3);
    assert_eq!(ran.records().len(), 1);
    assert!(ran.err.contains("<stdin>:2:11: ") && ran.err.contains("ends in the middle of this record"), "{}", ran.err);
}

#[test]
fn what_is_no_utf8_is_located() {
    let ran = run("chunk", &["--keep-going"], b"go left\n\xff\xfe\ngo right\n".as_slice()).expect_code(3);
    assert_eq!(ran.records().len(), 2);
    assert!(ran.err.contains("<stdin>:2:1: this byte is not UTF-8"), "{}", ran.err);
}

#[test]
fn the_output_is_the_same_for_any_number_of_jobs() {
    let input: String = (0..500).map(|i| format!("{{\"id\":{i},\"text\":\"go {i} steps and turn left\"}}\n")).collect();
    let one = run("chunk", &["-j", "1"], &input).expect_code(0).out;
    assert_eq!(one, run("chunk", &["-j", "3"], &input).expect_code(0).out);
    assert_eq!(one.lines().count(), 500);
}

#[test]
fn an_output_file_is_not_overwritten_without_force() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("out.jsonl");
    let path = path.to_str().expect("UTF-8");
    run("chunk", &["-o", path], "go left\n").expect_code(0);
    let ran = run("chunk", &["-o", path], "go right\n").expect_code(2);
    assert!(ran.err.contains("exists; name another file or give --force"), "{}", ran.err);
    run("chunk", &["-o", path, "--force"], "go right\n").expect_code(0);
    assert!(std::fs::read_to_string(path).expect("readable").contains("go right"));
}

#[test]
fn a_run_that_fails_leaves_no_output_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("out.jsonl");
    run("ground", &["-o", path.to_str().expect("UTF-8")], "{\"id\":1}\n").expect_code(1);
    assert_eq!(std::fs::read_dir(folder.path()).expect("readable").count(), 0);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_said() {
    let ran = run("chunk", &["-o", "/dev/full"], "go left\n").expect_code(1);
    assert!(ran.err.contains("/dev/full: the disk is full"), "{}", ran.err);
}

#[cfg(unix)]
#[test]
fn a_closed_pipe_is_a_quiet_end() {
    use std::io::{Read, Write};
    use std::process::{Command, Stdio};
    let mut child = Command::new(common::executable("chunk"))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("starts");
    let mut stdin = child.stdin.take().expect("piped");
    drop(child.stdout.take());
    for _ in 0..2000 {
        if stdin.write_all(b"go forward and turn left into the room\n").is_err() {
            break;
        }
    }
    drop(stdin);
    let mut err = String::new();
    child.stderr.take().expect("piped").read_to_string(&mut err).expect("UTF-8");
    assert_eq!((child.wait().expect("ends").code(), err.as_str()), (Some(0), ""));
}

#[cfg(unix)]
#[test]
fn an_answer_comes_before_the_next_line_and_an_interrupt_exits_with_130() {
    use std::io::{BufRead, BufReader, Write};
    use std::process::{Command, Stdio};
    let mut child =
        Command::new(common::executable("chunk")).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("starts");
    let mut stdin = child.stdin.take().expect("piped");
    stdin.write_all(b"go left\n").expect("written");
    let mut line = String::new();
    BufReader::new(child.stdout.take().expect("piped")).read_line(&mut line).expect("readable");
    assert!(line.contains("go left") && line.ends_with('\n'));
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill runs");
    assert!(killed.success());
    assert_eq!(child.wait().expect("ends").code(), Some(130));
}

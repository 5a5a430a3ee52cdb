//! What a stranger sends – a log, a record, a name, a detector – ends in a message at worst: nothing of ours is
//! overwritten, nothing is lost, nothing is believed of the wrong frame.
#![cfg(target_os = "linux")]

mod common;

use std::collections::BTreeMap;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;

use common::{executable, pipe, run};

const PLAN: &str = r#"{"id":"1","plan":{"map":"apartment","room":"hallway","actions":[{"do":"move","direction":"left"}],"problems":[]}}"#;

/// A log with a plan, and with `options` as those of its trial.
fn log_with(path: &Path, options: &str) {
    let file = std::fs::File::create(path).expect("a file");
    let mut writer = mcap::Writer::new(std::io::BufWriter::new(file)).expect("begun");
    let schema = writer.add_schema("x", "jsonschema", br#"{"type":"object"}"#).expect("a schema");
    for (topic, line) in [("/fetch/options", options), ("/fetch/plan", PLAN)] {
        let channel_id = writer.add_channel(schema, topic, "json", &BTreeMap::new()).expect("a channel");
        let header = mcap::records::MessageHeader { channel_id, sequence: 1, log_time: 0, publish_time: 0 };
        writer.write_to_known_channel(&header, line.as_bytes()).expect("a message");
    }
    writer.finish().expect("written");
}

fn files(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("readable");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn a_log_cannot_choose_an_output_a_robot_a_server_or_a_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let (log, victim) = (folder.path().join("log.mcap"), folder.path().join("victim"));
    std::fs::write(&victim, "mine").expect("written");
    let victim = victim.to_str().expect("UTF-8");
    for (options, asked) in [
        (format!(r#"{{"options":["--output","{victim}","--force"]}}"#), "a command line"),
        (format!(r#"{{"output":"{victim}","force":true}}"#), "`output`"),
        (r#"{"seed":1,"robot":"tcp:127.0.0.1:1"}"#.to_string(), "`robot`"),
        (r#"{"serve":"tcp:127.0.0.1:0"}"#.to_string(), "`serve`"),
        (format!(r#"{{"plot":"{victim}"}}"#), "`plot`"),
        (format!(r#"{{"world":"{victim}"}}"#), "give it by --world"),
        (r#"{"map":"/dev/zero"}"#.to_string(), "give it by --map"),
        (r#"{"time_limit":1e300}"#.to_string(), "`time_limit`"),
    ] {
        let _ = std::fs::remove_file(&log);
        log_with(&log, &options);
        let ran = run("drive", &["--replay", log.to_str().expect("UTF-8")], "").expect_code(1);
        assert!(ran.out.is_empty() && ran.err.contains(asked), "{options}: {}", ran.err);
        assert_eq!(std::fs::read_to_string(victim).expect("there"), "mine", "{options}");
        assert_eq!(files(folder.path()), ["log.mcap", "victim"], "{options}");
    }
    let _ = std::fs::remove_file(&log);
    log_with(&log, r#"{"world":"apartment-modified","noise":"off","seed":7}"#);
    let ran = run("drive", &["--replay", log.to_str().expect("UTF-8")], "").expect_code(0);
    assert!(ran.err.contains("as recorded: --noise off --seed 7 --world apartment-modified"), "{}", ran.err);
}

#[test]
fn no_two_records_of_a_run_leave_one_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str| folder.path().join(name).display().to_string();
    let plan = |id: &str| PLAN.replace(r#""id":"1""#, id);
    let ids = [r#""id":"a/b""#, r#""id":"a_b""#, r#""id":"a b""#, r#""none":1"#, r#""none":2"#];
    let plans: String = ids.iter().map(|id| format!("{}\n", plan(id))).collect();
    run("drive", &["--plot", &file("t-{id}.svg"), "--force"], &plans).expect_code(0);
    let left = ["t-%line-4.svg", "t-%line-5.svg", "t-a%20b.svg", "t-a%2Fb.svg", "t-a_b.svg"];
    assert_eq!(files(folder.path()), left);
    for option in ["--plot", "--record"] {
        let ran = run("drive", &["-j", "1", option, &file("one"), "--force", "--keep-going"], &plans).expect_code(3);
        assert_eq!(ran.err.matches("of this run; give records ids that differ").count(), 4, "{}", ran.err);
    }
    let shapes = r##"{"id":"x","a":{"grid":{"rows":["#."],"cell_m":1}},"b":{"grid":{"rows":[".#"],"cell_m":1}}}"##;
    let ran = run("hof", &["-j", "1", "--svg", &file("roses"), "--force"], format!("{shapes}\n{shapes}\n"));
    assert!(ran.expect_code(1).err.contains("of this run"));
}

#[test]
fn a_trial_that_was_driven_is_in_the_record_though_its_picture_cannot_be_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let plot = folder.path().join("way.svg");
    // No file may grow beyond 512 bytes: the plot does, what goes through a pipe does not.
    let mut limited = Command::new("sh");
    limited.args(["-c", r#"ulimit -f 1; exec "$@""#, "sh", executable("drive"), "--plot"]).arg(&plot);
    let input = folder.path().join("plan");
    std::fs::write(&input, format!("{PLAN}\n")).expect("written");
    let ran = limited.arg(&input).output().expect("ends");
    let (out, said) = (String::from_utf8_lossy(&ran.stdout), String::from_utf8_lossy(&ran.stderr));
    assert_eq!(ran.status.code(), Some(3), "{said}");
    assert!(out.contains(r#""trial":{"outcome":"arrived""#), "{out}");
    assert!(said.contains("way.svg: ") && said.contains("warning"), "{said}");
    assert_eq!(files(folder.path()), ["plan"]);
}

#[test]
fn what_is_in_the_way_of_a_picture_is_said_before_anything_moves() {
    let folder = tempfile::tempdir().expect("a folder");
    let plot = folder.path().join("way.svg");
    std::fs::write(&plot, "mine").expect("written");
    let ran = run("drive", &["--plot", plot.to_str().expect("UTF-8")], PLAN).expect_code(1);
    assert!(ran.out.is_empty() && ran.err.contains("way.svg exists"), "{ran:?}");
}

#[test]
fn an_output_is_as_open_as_the_umask_says_and_one_that_is_replaced_as_it_was() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("out");
    let chunk = |options: &str| {
        let line = format!(r#"umask 027; echo 'go left' | "$0" {options} -o "$1""#);
        let ran = Command::new("sh").args(["-c", &line, executable("chunk")]).arg(&path).status().expect("runs");
        assert!(ran.success());
        path.metadata().expect("written").permissions().mode() & 0o777
    };
    assert_eq!(chunk(""), 0o640);
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o600)).expect("set");
    assert_eq!(chunk("--force"), 0o600);
}

#[test]
fn standard_output_by_its_name_is_written_to_and_not_replaced() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("out");
    let line = r#"echo 'go left' | "$0" -o /dev/stdout > "$1""#;
    let ran = Command::new("sh").args(["-c", line, executable("chunk")]).arg(&path).status().expect("runs");
    assert!(ran.success() && std::fs::read_to_string(&path).expect("there").contains("go left"));
}

#[test]
fn keep_going_covers_files_that_are_not_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let good = folder.path().join("good");
    std::fs::write(&good, "go left\n").expect("written");
    let (good, folder) = (good.to_str().expect("UTF-8"), folder.path().to_str().expect("UTF-8"));
    let ran = run("chunk", &["--keep-going", "no/such", good, folder, good], "").expect_code(3);
    assert_eq!(ran.records().len(), 2);
    assert!(ran.err.contains("no/such: ") && ran.err.contains(&format!("{folder}: ")), "{}", ran.err);
    let ran = run("chunk", &[good, "no/such"], "").expect_code(1);
    assert!(ran.out.is_empty(), "all files are looked at before the first is read: {}", ran.out);
}

#[test]
fn control_characters_never_reach_the_terminal() {
    let evil = "{\"id\":\"\\u001b[2Jx\\u009b\",\"text\":\"go \\u001b]0;x\\u0007 left\"}\n";
    let wild = |text: &str| text.chars().any(|c| c.is_control() && c != '\n' && c != '\t');
    for name in ["chunk", "ground", "plan"] {
        let input = match name {
            "chunk" => evil.to_string(),
            "ground" => pipe(&["chunk"], evil),
            _ => pipe(&["chunk", "ground"], evil),
        };
        let ran = run(name, &["--format", "text"], input).expect_code(0);
        assert!(!wild(&ran.out) && !wild(&ran.err), "{name}: {ran:?}");
    }
    let ran = run("ground", &["--keep-going", "\u{1b}[2Jfile"], "").expect_code(3);
    assert!(!wild(&ran.err) && ran.err.contains("\\u{1b}[2Jfile"), "{ran:?}");
    let ran = run("ground", &[], "{\"id\":\"\\u001b[2J\",\"text\":7}\n").expect_code(1);
    assert!(!wild(&ran.err), "{ran:?}");
}

#[test]
fn a_time_limit_that_is_no_number_is_a_usage_error() {
    for limit in ["nan", "inf", "-1"] {
        run("drive", &[&format!("--time-limit={limit}")], PLAN).expect_code(2);
    }
}

#[test]
fn a_dry_run_whose_reader_has_gone_does_not_panic() {
    let line = r#"echo "$1" | "$0" --dry-run 2>&1 >/dev/null | head -1 >/dev/null; echo ${PIPESTATUS[1]}"#;
    let ran = Command::new("bash").args(["-c", line, executable("drive"), PLAN]).output().expect("runs");
    assert_eq!(String::from_utf8_lossy(&ran.stdout).trim(), "0");
}

#[test]
fn serving_overwrites_no_file_and_no_link_of_others() {
    let folder = tempfile::tempdir().expect("a folder");
    let [mine, link] = ["mine", "link"].map(|name| folder.path().join(name));
    std::fs::write(&mine, "mine").expect("written");
    std::os::unix::fs::symlink("mine", &link).expect("a link");
    let path = mine.to_str().expect("UTF-8");
    for option in ["--truth-out", "--camera-out"] {
        let ran = run("drive", &["--serve", "tcp:127.0.0.1:0", option, path], "").expect_code(2);
        assert!(ran.err.contains("mine exists; name another file or give --force"), "{}", ran.err);
    }
    let ran = run("drive", &["--serve", &format!("pty:{}", link.display())], "").expect_code(1);
    assert!(ran.err.contains("a file is there"), "{}", ran.err);
    assert!(link.is_symlink() && std::fs::read_to_string(&mine).expect("there") == "mine");
}

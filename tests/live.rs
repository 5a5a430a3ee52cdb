//! `drive --live`, looked at by a WebSocket client that is not ours.
#![cfg(feature = "live")]

mod common;
#[path = "common/served.rs"]
mod served;
#[path = "common/viewer.rs"]
mod viewer;

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{BufRead, BufReader, Lines, Read, Write};
use std::process::{Child, ChildStderr, ChildStdin, ChildStdout, Command, Stdio};

use common::{executable, pipe, run};
use served::{AHEAD, Served, wait_for};
use viewer::{Topics, Viewer, connect, recorded};

/// `drive --live` at a free port.
struct Shown {
    child: Child,
    stdin: ChildStdin,
    lines: Lines<BufReader<ChildStdout>>,
    said: Lines<BufReader<ChildStderr>>,
    port: u16,
}

impl Shown {
    fn start(arguments: &[&str]) -> Self {
        let mut child = Command::new(executable("drive"))
            .args(["--live", "127.0.0.1:0"])
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("starts");
        let mut said = BufReader::new(child.stderr.take().expect("piped")).lines();
        let address = said.find_map(|line| {
            let line = line.expect("UTF-8");
            Some(line.split_once("live at ws://127.0.0.1:")?.1.split(' ').next()?.to_string())
        });
        let port = address.expect("the address is told").parse().expect("a port");
        let (stdin, stdout) = (child.stdin.take().expect("piped"), child.stdout.take().expect("piped"));
        Self { child, stdin, lines: BufReader::new(stdout).lines(), said, port }
    }

    /// Drives one trial to its end.
    fn drive(&mut self, plan: &str) -> String {
        writeln!(self.stdin, "{}", plan.trim_end()).expect("written");
        self.lines.next().expect("a record").expect("UTF-8")
    }

    fn end(mut self) {
        drop(self.stdin);
        let said: Vec<_> = self.said.map_while(Result::ok).collect();
        assert!(self.child.wait().expect("ends").success(), "{said:?}");
    }
}

/// Of each topic all that the log has of time zero, and every message from the first other one that came.
fn assert_same(seen: &Topics, log: &Topics) {
    assert_eq!(seen.keys().collect::<Vec<_>>(), log.keys().collect::<Vec<_>>());
    for (topic, written) in log {
        let shown = &seen[topic];
        assert!(shown.kind == written.kind, "{topic}: {:?}, not {:?}", shown.kind, written.kind);
        // Who comes late may get a message twice.
        let got: BTreeSet<_> = shown.messages.iter().collect();
        let first = got.iter().find(|(time_ns, _)| *time_ns > 0).map_or(u64::MAX, |message| message.0);
        let due: BTreeSet<_> = written.messages.iter().filter(|m| m.0 == 0 || m.0 > first).collect();
        let times = |messages: &BTreeSet<&(u64, Vec<u8>)>| messages.iter().map(|m| m.0).collect::<Vec<_>>();
        assert!(got.is_superset(&due), "{topic}: {:?}, not {:?}", times(&got), times(&due));
        assert!(got.iter().all(|message| written.messages.contains(message)), "{topic}: {:?}", times(&got));
    }
}

/// Waits until the viewer has what ends the log: clients get their messages when they do.
fn wait_for_the_end(viewer: &Viewer, log: &Topics) {
    wait_for("the end of the trial", || {
        let seen = viewer.seen().topics;
        log.iter().all(|(topic, said)| seen.get(topic).is_some_and(|got| got.messages.last() == said.messages.last()))
    });
}

#[test]
fn who_looks_on_gets_the_messages_of_the_log() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("trial.mcap");
    let mut shown = Shown::start(&["--live-speed", "20", "--record", path.to_str().expect("UTF-8")]);
    let viewer = Viewer::connected_to(shown.port);
    let record = shown.drive(AHEAD);
    let log = recorded(&path);
    assert_eq!(log["/fetch/drive"].messages[0].1, record.as_bytes());
    wait_for_the_end(&viewer, &log);
    let seen = viewer.seen();
    assert_same(&seen.topics, &log);
    assert!(seen.topics["/odom"].messages.len() > 10 && seen.clock_ns > 1_000_000_000, "{}", seen.clock_ns);
    shown.end();
}

#[test]
fn who_comes_late_still_gets_walls_grid_truth_and_records() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("trial.mcap");
    let mut shown = Shown::start(&["--live-speed", "10000", "--record", path.to_str().expect("UTF-8")]);
    shown.drive(AHEAD);
    let log = recorded(&path);
    let viewer = Viewer::connected_to(shown.port);
    wait_for_the_end(&viewer, &log);
    let seen = viewer.seen().topics;
    assert_same(&seen, &log);
    for topic in ["/tf_static", "/fetch/scene", "/fetch/scene_true", "/fetch/map", "/fetch/plan"] {
        assert_eq!(seen[topic].messages[0], log[topic].messages[0], "{topic}");
    }
    assert_eq!(seen["/odom"].messages.len(), 1);
    shown.end();
}

#[test]
fn the_next_trial_is_a_session_of_its_own() {
    let mut shown = Shown::start(&["--live-speed", "10000"]);
    let viewer = Viewer::connected_to(shown.port);
    let records = |id: &str| {
        let seen = viewer.seen();
        let said = seen.topics.get("/fetch/drive").map(|said| said.messages.clone()).unwrap_or_default();
        said.iter().any(|(_, line)| String::from_utf8_lossy(line).starts_with(&format!("{{\"id\":\"{id}\"")))
    };
    shown.drive(AHEAD);
    wait_for("the first record", || records("1"));
    let before = viewer.seen().sessions;
    shown.drive(&AHEAD.replace("\"id\":\"1\"", "\"id\":\"2\""));
    wait_for("the second record", || records("2"));
    assert_eq!(viewer.seen().sessions.len(), before.len() + 1);
    shown.end();
}

#[test]
fn a_viewer_that_never_reads_holds_nothing_up() {
    let plan = pipe(&["chunk", "ground", "plan"], "the mug is in the bedroom on the table next to the chairs\n");
    let alone = run("drive", &["--perception", "camera"], &plan).expect_code(0).out;
    let mut shown = Shown::start(&["--perception", "camera", "--live-speed", "10000"]);
    let mut socket = connect(shown.port);
    // It subscribes to what it is told of, and then reads no more.
    let stalled = std::thread::spawn({
        let mut seen = viewer::Seen::default();
        move || {
            while !seen.topics.contains_key("/camera/depth/image_raw") {
                if let Some(answer) = seen.hear(&socket.read().expect("served")) {
                    socket.send(tungstenite::Message::text(answer)).expect("served");
                }
            }
            socket
        }
    });
    assert_eq!(shown.drive(&plan), alone.trim_end());
    shown.end();
    drop(stalled.join().expect("it got so far"));
}

#[test]
fn who_looks_on_sees_the_end_though_the_log_can_no_longer_be_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let pipe = folder.path().join("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().expect("mkfifo").success());
    let mut shown = Shown::start(&["--live-speed", "20", "--record", pipe.to_str().expect("UTF-8")]);
    let reads_little = std::thread::spawn(move || File::open(pipe)?.read_exact(&mut [0; 1000]));
    let viewer = Viewer::connected_to(shown.port);
    writeln!(shown.stdin, "{AHEAD}").expect("written");
    wait_for("the record", || viewer.seen().topics.get("/fetch/drive").is_some_and(|said| !said.messages.is_empty()));
    drop(shown.stdin);
    let said: Vec<_> = shown.said.map_while(Result::ok).collect();
    assert!(said.iter().any(|line| line.contains("pipe: Broken pipe")), "{said:?}");
    reads_little.join().expect("no panic").expect("a thousand bytes");
    assert_eq!(shown.child.wait().expect("ends").code(), Some(3));
}

#[test]
fn a_real_robot_is_shown_as_it_is_logged() {
    let served = Served::start(&[]);
    let path = served.path("trial.mcap");
    let name = path.to_str().expect("UTF-8");
    let mut shown = Shown::start(&["--robot", &served.address(), "--map", &served.map(), "--record", name]);
    let viewer = Viewer::connected_to(shown.port);
    shown.drive(AHEAD);
    let log = recorded(&path);
    wait_for_the_end(&viewer, &log);
    assert_same(&viewer.seen().topics, &log);
    shown.end();
}

#[test]
fn a_port_in_use_is_named_with_what_mends_it() {
    let taken = std::net::TcpListener::bind("127.0.0.1:0").expect("a free port");
    let address = taken.local_addr().expect("bound").to_string();
    let ran = run("drive", &["--live", &address], AHEAD).expect_code(1);
    assert!(ran.err.contains(&format!("--live {address}: ")) && ran.err.contains("another port"), "{}", ran.err);
}

#[test]
fn what_is_no_address_is_not_taken_for_one() {
    let ran = run("drive", &["--live", "plans.jsonl"], AHEAD).expect_code(2);
    assert!(ran.err.contains("not HOST:PORT") && ran.err.contains("name files before"), "{}", ran.err);
}

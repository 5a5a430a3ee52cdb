//! `drive --robot` and `drive --serve` as separate processes, over pseudo-terminals and TCP.

mod common;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use common::{executable, pipe, run};
use serde_json::Value;

/// However slow the machine, something has gone wrong after this.
const PATIENCE: Duration = Duration::from_secs(40);

/// Through the door before which the robot starts, and half a metre on.
const AHEAD: &str = r#"{"id":"1","plan":{"map":"apartment","room":"living_room","actions":[{"do":"enter","room":"living_room"},{"do":"move","direction":"front","amount":{"meters":0.5}}],"problems":[]}}"#;
/// Far enough to be interrupted.
const FAR_AHEAD: &str = r#"{"id":"1","plan":{"map":"apartment","room":"living_room","actions":[{"do":"enter","room":"living_room"},{"do":"move","direction":"front","amount":{"meters":3.0}}],"problems":[]}}"#;

/// A served robot, ended when dropped.
struct Served {
    child: Child,
    folder: tempfile::TempDir,
}

impl Served {
    /// Before the door of an empty room, so that no test has far to go.
    fn start(arguments: &[&str]) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let home = home_in(folder.path());
        let home: Vec<&str> = home.iter().map(String::as_str).collect();
        Self::start_in(folder, &[&home, arguments].concat())
    }

    fn start_in(folder: tempfile::TempDir, arguments: &[&str]) -> Self {
        let (pty, truth) = (folder.path().join("p3dx"), folder.path().join("truth.jsonl"));
        let log = std::fs::File::create(folder.path().join("served.log")).expect("a log");
        let child = Command::new(executable("drive"))
            .arg("--serve")
            .arg(format!("pty:{}@38400", pty.display()))
            .arg("--truth-out")
            .arg(&truth)
            .args(arguments)
            .stdin(Stdio::null())
            .stderr(log)
            .spawn()
            .expect("starts");
        let served = Self { child, folder };
        wait_for("the pseudo-terminal", || pty.exists());
        served
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn address(&self) -> String {
        format!("serial:{}@38400", self.path("p3dx").display())
    }

    /// What the robot may know of its home.
    fn map(&self) -> String {
        self.path("home.map.json").display().to_string()
    }

    fn log(&self) -> String {
        std::fs::read_to_string(self.path("served.log")).expect("a log")
    }

    /// The last whole line of the truth.
    fn truth(&self) -> Value {
        let text = std::fs::read_to_string(self.path("truth.jsonl")).unwrap_or_default();
        let whole = text.rsplit_once('\n').map_or("", |(whole, _)| whole);
        whole.lines().last().and_then(|line| serde_json::from_str(line).ok()).unwrap_or(Value::Null)
    }

    fn speed(&self) -> f64 {
        self.truth()["speed"].as_f64().unwrap_or(0.0)
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The arguments of a home made for these tests.
fn home_in(folder: &Path) -> Vec<String> {
    let map = include_str!("../fixtures/apartment.map.json");
    let start = r#"{"x": 5.0, "y": 0.0, "heading": 3.141592653589793}"#;
    assert!(map.contains(start));
    let map = map.replace(start, r#"{"x": 2.63, "y": 0.7, "heading": 1.5708}"#);
    let scene = r#"{"version":1,"name":"empty","map":"apartment","furniture":[],"objects":[]}"#;
    let (map_file, scene_file) = (folder.join("home.map.json"), folder.join("home.scene.json"));
    std::fs::write(&map_file, map).expect("written");
    std::fs::write(&scene_file, scene).expect("written");
    ["--map".into(), map_file.display().to_string(), "--scene".into(), scene_file.display().to_string()].to_vec()
}

fn wait_for(what: &str, mut done: impl FnMut() -> bool) {
    let until = Instant::now() + PATIENCE;
    while !done() {
        assert!(Instant::now() < until, "{what} did not come");
        std::thread::sleep(Duration::from_millis(20));
    }
}

fn client(served: &Served, log: &Path, plan: &str) -> Child {
    let mut child = Command::new(executable("drive"))
        .args(["--robot", &served.address(), "--map", &served.map(), "--record"])
        .arg(log)
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(std::fs::File::create(served.path("client.log")).expect("a log"))
        .spawn()
        .expect("starts");
    let mut stdin = child.stdin.take().expect("piped");
    writeln!(stdin, "{plan}").expect("written");
    child
}

#[test]
fn a_dynamic_instruction_over_a_pseudo_terminal_ends_arrived_where_the_robot_believes_to_be() {
    let served = Served::start(&[]);
    let ran = run("drive", &["--robot", &served.address(), "--map", &served.map(), "--no-localization"], AHEAD)
        .expect_code(0);
    let trial = &ran.records()[0]["trial"];
    assert_eq!(trial["outcome"], "arrived", "{trial}");
    assert!(ran.err.contains("p3dx-sh") && ran.err.contains("battery"), "{}", ran.err);
    wait_for("a standstill", || served.speed() == 0.0);
    let truth = served.truth();
    for (key, most) in [("x", 0.02), ("y", 0.02), ("heading", 0.0175)] {
        let (believed, true_) = (trial["final_pose"][key].as_f64(), truth[key].as_f64());
        assert!((believed.expect("a pose") - true_.expect("a truth")).abs() < most, "{key}: {trial} against {truth}");
    }
    wait_for("a good-bye", || served.log().contains("the client has closed the robot"));
}

#[test]
fn a_static_instruction_without_a_camera_says_what_it_lacks() {
    let served = Served::start(&[]);
    let plan = AHEAD.replace(
        "],\"problems\"",
        ",{\"do\":\"search\",\"target\":\"table\",\"pairs\":[]},{\"do\":\"find\",\"object\":\"mug\"}],\"problems\"",
    );
    let ran = run("drive", &["--robot", &served.address(), "--map", &served.map()], plan).expect_code(0);
    let trial = &ran.records()[0]["trial"];
    assert_eq!(trial["outcome"], "arrived");
    assert!(trial["why"].as_str().is_some_and(|why| why.contains("look for the table a camera is needed")), "{trial}");
}

#[test]
fn each_signal_stops_the_robot_by_our_own_word_and_leaves_a_whole_log() {
    for signal in ["INT", "TERM", "HUP"] {
        let served = Served::start(&[]);
        let log = served.path("trial.mcap");
        let mut child = client(&served, &log, FAR_AHEAD);
        wait_for("motion", || served.speed() > 0.1);
        let sent = Command::new("kill").args(["-s", signal, &child.id().to_string()]).status().expect("kill runs");
        assert!(sent.success());
        assert_eq!(child.wait().expect("ends").code(), Some(130), "{signal}");
        wait_for("a standstill", || served.speed() == 0.0);
        wait_for("a good-bye", || served.log().contains("the client has closed the robot"));
        assert!(!served.log().contains("watchdog"), "{signal}: {}", served.log());
        let records = spatial_fetch::recording::records(&log, "/fetch/drive").expect("a whole log");
        assert!(
            records.last().is_some_and(|record| record.contains(r#""outcome":"stopped""#)),
            "{signal}: {records:?}"
        );
    }
}

#[test]
fn a_client_killed_in_mid_motion_leaves_the_robot_to_its_watchdog() {
    let served = Served::start(&["--watchdog", "500"]);
    let mut child = client(&served, &served.path("trial.mcap"), FAR_AHEAD);
    wait_for("motion", || served.speed() > 0.1);
    child.kill().expect("killed");
    child.wait().expect("ends");
    wait_for("a standstill", || served.speed() == 0.0);
    assert!(served.log().contains("stopped by the watchdog"), "{}", served.log());
    let ran = run("drive", &["--robot", &served.address(), "--map", &served.map()], AHEAD).expect_code(0);
    assert_eq!(ran.records()[0]["trial"]["outcome"], "arrived", "the session left open is taken over");
}

#[test]
fn a_robot_whose_rate_is_not_told_is_found_and_a_wrong_rate_is_named() {
    let served = Served::start(&[]);
    let path = served.path("p3dx");
    let wrong = run("drive", &["--robot", &format!("serial:{}@9600", path.display())], AHEAD).expect_code(1);
    assert!(
        wrong.err.contains("bytes came that are no packets at 9600 baud")
            || wrong.err.contains("no answer at 9600 baud"),
        "{}",
        wrong.err
    );
    let ran =
        run("drive", &["--robot", &format!("serial:{}", path.display()), "--map", &served.map()], AHEAD).expect_code(0);
    assert!(ran.err.contains("38400 baud"), "{}", ran.err);
}

#[test]
fn what_cannot_be_opened_says_why_and_what_mends_it() {
    for (address, code, part) in [
        ("serial:/dev/no-such-device", 1, "is the adapter plugged in?"),
        ("tcp:127.0.0.1:1", 1, "nobody listens there"),
        ("ttyUSB0", 2, "serial:/dev/ttyUSB0@38400"),
    ] {
        let ran = run("drive", &["--robot", address], AHEAD).expect_code(code);
        assert!(ran.err.contains(part), "{}", ran.err);
    }
}

#[test]
fn a_line_held_by_another_program_names_it() {
    let served = Served::start(&[]);
    let _held = spatial_fetch::robot::arcos::line::SerialLine::open(&served.path("p3dx"), None).expect("opens");
    let ran = run("drive", &["--robot", &served.address(), "--map", &served.map()], AHEAD).expect_code(1);
    assert!(ran.err.contains("the line is held by"), "{}", ran.err);
}

#[test]
fn a_dry_run_prints_the_commands() {
    let folder = tempfile::tempdir().expect("a folder");
    let map = home_in(folder.path()).remove(1);
    let ran = run("drive", &["--dry-run", "--map", &map], AHEAD).expect_code(0);
    for command in ["SETV 300", "ENABLE 1", "VEL 300", "ENABLE 0", "CLOSE"] {
        assert!(ran.err.contains(command), "{command} in {}", ran.err);
    }
}

/// `cargo test --release --test robot -- --ignored --nocapture`
#[test]
#[ignore = "takes about two minutes of real time"]
fn a_whole_fetch_trial_over_a_pseudo_terminal_with_its_camera_through_a_fifo() {
    let folder = tempfile::tempdir().expect("a folder");
    let fifo = folder.path().join("camera.mcap");
    assert!(Command::new("mkfifo").arg(&fifo).status().expect("mkfifo runs").success());
    let fifo = fifo.to_str().expect("UTF-8");
    let served = Served::start_in(tempfile::tempdir().expect("a folder"), &["--camera-out", fifo]);
    let plan = pipe(&["chunk", "ground", "plan"], "the mug is in the bedroom on the table next to the chairs\n");
    let ran = run("drive", &["--robot", &served.address(), "--camera", fifo, "--format", "text"], &plan);
    println!("{}\n{}\n{}", ran.out, ran.err, served.truth());
    assert!(ran.out.contains("found:"), "{}", ran.out);
}

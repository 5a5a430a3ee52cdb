//! `drive --robot` and `drive --serve` as separate processes, over pseudo-terminals and TCP.

mod common;

#[path = "common/served.rs"]
mod served;

use std::process::Command;

use common::{pipe, run};
use served::{AHEAD, FAR_AHEAD, Served, client, home_in, wait_for};
use spatial_fetch::geometry::vec2;
use spatial_fetch::simulation::Scene;

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
    use std::os::unix::process::ExitStatusExt;
    // INT, TERM and HUP end with 130; the others as they always do.
    for (signal, code) in [
        ("INT", 130),
        ("TERM", 130),
        ("HUP", 130),
        ("QUIT", -3),
        ("USR1", -10),
        ("ALRM", -14),
        ("XCPU", -24),
        ("ABRT", -6),
    ] {
        let served = Served::start(&[]);
        let log = served.path("trial.mcap");
        let mut child = client(&served, &log, FAR_AHEAD);
        wait_for("motion", || served.speed() > 0.1);
        send(signal, child.id());
        let status = child.wait().expect("ends");
        assert_eq!(status.code().unwrap_or_else(|| -status.signal().expect("a signal")), code, "{signal}");
        expect_stopped(&served, signal);
        let records = spatial_fetch::recording::records(&log, "/fetch/drive").expect("a whole log");
        assert!(
            records.last().is_some_and(|record| record.contains(r#""outcome":"stopped""#)),
            "{signal}: {records:?}"
        );
    }
}

fn send(signal: &str, process: u32) {
    let sent = Command::new("kill").args(["-s", signal, &process.to_string()]).status().expect("kill runs");
    assert!(sent.success());
}

/// The robot stands, by a word of ours and not by its watchdog, and its session is closed.
fn expect_stopped(served: &Served, how: &str) {
    wait_for("a standstill", || served.speed() == 0.0);
    wait_for("a good-bye", || served.log().contains("the client has closed the robot"));
    assert!(!served.log().contains("watchdog"), "{how}: {}", served.log());
}

#[test]
fn a_client_killed_in_mid_motion_is_spoken_for_by_its_second_process() {
    for signal in ["KILL", "ILL"] {
        let served = Served::start(&[]);
        let mut child = client(&served, &served.path("trial.mcap"), FAR_AHEAD);
        wait_for("motion", || served.speed() > 0.1);
        let before = served.truth()["distance_m"].as_f64().expect("a distance");
        send(signal, child.id());
        child.wait().expect("ends");
        expect_stopped(&served, signal);
        let driven = served.truth()["distance_m"].as_f64().expect("a distance") - before;
        eprintln!("driven after the kill: {driven:.2} m");
        assert!(driven < 0.6, "{driven} m");
    }
}

#[test]
fn a_client_that_is_suspended_stands_and_goes_on_after_it() {
    for signal in ["TSTP", "STOP"] {
        let served = Served::start(&["--watchdog", "60000"]);
        let mut child = client(&served, &served.path("trial.mcap"), FAR_AHEAD);
        wait_for("motion", || served.speed() > 0.1);
        send(signal, child.id());
        wait_for("a standstill", || served.speed() == 0.0);
        let stands = served.truth()["distance_m"].as_f64().expect("a distance");
        std::thread::sleep(std::time::Duration::from_millis(500));
        assert_eq!(served.truth()["distance_m"].as_f64(), Some(stands), "{signal}: nothing moves meanwhile");
        send("CONT", child.id());
        assert_eq!(child.wait().expect("ends").code(), Some(0), "{signal}");
        let records = spatial_fetch::recording::records(&served.path("trial.mcap"), "/fetch/drive").expect("a log");
        assert!(records[0].contains(r#""outcome":"arrived""#), "{signal}: {records:?}");
    }
}

#[test]
fn a_client_killed_with_its_second_process_leaves_the_robot_to_its_watchdog() {
    let served = Served::start(&["--watchdog", "500"]);
    let mut child = client(&served, &served.path("trial.mcap"), FAR_AHEAD);
    wait_for("motion", || served.speed() > 0.1);
    let children = format!("/proc/{0}/task/{0}/children", child.id());
    let second = std::fs::read_to_string(children).expect("readable");
    second.split_whitespace().for_each(|process| send("KILL", process.parse().expect("a number")));
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

#[test]
fn every_test_that_the_documentation_names_exists() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    // What needs a ROS master is checked by CI, in Python.
    let mut folders = vec![root.join("src"), root.join("tests"), root.join(".ci")];
    let mut code = String::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("readable").map(|entry| entry.expect("readable").path()) {
            match entry.extension().and_then(|extension| extension.to_str()) {
                Some("rs" | "py") => code += &std::fs::read_to_string(&entry).expect("readable"),
                _ if entry.is_dir() => folders.push(entry),
                _ => {}
            }
        }
    }
    let page = include_str!("../docs/robot.md");
    let quoted = page.split('`').skip(1).step_by(2);
    let tests: Vec<&str> = quoted.filter(|text| text.matches('_').count() > 3 && !text.contains(' ')).collect();
    assert!(tests.len() > 20, "{tests:?}");
    for test in tests {
        assert!(
            code.contains(&format!("fn {test}(")) || code.contains(&format!("def {test}(")),
            "docs/robot.md names {test}, which is no test"
        );
    }
}

/// `cargo test --release --test robot -- --ignored --nocapture`
#[test]
#[ignore = "takes about a minute of real time"]
fn a_whole_fetch_trial_over_a_pseudo_terminal_with_its_camera_through_a_fifo() {
    let folder = tempfile::tempdir().expect("a folder");
    let fifo = folder.path().join("camera.mcap");
    assert!(Command::new("mkfifo").arg(&fifo).status().expect("mkfifo runs").success());
    let fifo = fifo.to_str().expect("UTF-8");
    let served = Served::start_in(tempfile::tempdir().expect("a folder"), &["--camera-out", fifo]);
    let plan = pipe(&["chunk", "ground", "plan"], "the mug is in the bedroom on the table next to the chairs\n");
    // Brisk, for the sake of those who wait for the test.
    let options = ["--camera", fifo, "--no-localization", "--max-speed", "0.5"];
    let ran = run("drive", &[&["--robot", &served.address()], options.as_slice()].concat(), &plan);
    let (ran, truth) = (ran.expect_code(0), served.truth());
    let trial = ran.records().remove(0)["trial"].take();
    let number = |value: &serde_json::Value| value.as_f64().expect("a number");
    let sips = number(&truth["sips"]) / number(&truth["t"]);
    println!("{}\n{}\n{truth}\n{sips:.2} packets a second; {}", trial["why"], trial["final_pose"], ran.err);
    assert_eq!((&trial["outcome"], &truth["collisions"]), (&"found".into(), &0.into()), "{trial} {}", ran.err);
    let in_process = run("drive", &["--perception", "camera", "--noise", "off"], &plan).expect_code(0);
    let in_process = in_process.records().remove(0)["trial"].take();
    let place = vec2(number(&truth["x"]), number(&truth["y"]));
    let scene = Scene::apartment();
    let distance = |item: &&spatial_fetch::simulation::Item| item.footprint().distance_to(place);
    let tables = scene.furniture.iter().filter(|item| item.category.contains("table"));
    let reached = tables.min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("tables");
    assert_eq!(reached.id, in_process["target_id"], "{trial}");
    // Wheels without slip: what the odometry believes is true but for the rounding of the protocol.
    for (key, most) in [("x", 0.02), ("y", 0.02), ("heading", 0.0175)] {
        let off = (number(&trial["final_pose"][key]) - number(&truth[key])).abs();
        assert!(off < most, "{key}: {trial} against {truth}");
    }
}

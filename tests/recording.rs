//! Logs through the real executables: written by `drive`, read again by every stage.

mod common;

use std::path::Path;
use std::process::{Command, Stdio};

use common::{executable, pipe, run};
use serde_json::Value;
use spatial_fetch::behavior::Watcher;
use spatial_fetch::frame::RgbdFrame;
use spatial_fetch::geometry::Pose;
use spatial_fetch::map::RoomMap;
use spatial_fetch::perception::Detector;
use spatial_fetch::record::{Plan, Record};
use spatial_fetch::recording::records;
use spatial_fetch::simulation::{Home, Perception, TrialSettings, stream_of};

const SENTENCE: &str = "the mug is in the bedroom on the table next to the chairs\n";

struct Recorded {
    _folder: tempfile::TempDir,
    log: String,
    stages: [String; 4],
}

/// One sentence through all four, the last one recorded.
fn recorded() -> Recorded {
    let folder = tempfile::tempdir().expect("a folder");
    let log = folder.path().join("trial.mcap").to_str().expect("UTF-8").to_string();
    let chunked = pipe(&["chunk"], SENTENCE);
    let grounded = pipe(&["ground"], &chunked);
    let planned = pipe(&["plan"], &grounded);
    let driven = run("drive", &["--record", &log], &planned).expect_code(0).out;
    Recorded { _folder: folder, log, stages: [chunked, grounded, planned, driven] }
}

#[test]
fn every_stage_run_from_the_log_gives_the_same_bytes_as_the_first_time() {
    let recorded = recorded();
    for (stage, first) in ["chunk", "ground", "plan", "drive"].iter().zip(&recorded.stages) {
        let again = run(stage, &["--from", &recorded.log], "").expect_code(0);
        assert_eq!(again.out, *first, "{stage}");
    }
    assert_eq!(run("drive", &["--replay", &recorded.log], "").expect_code(0).out, recorded.stages[3]);
}

#[test]
fn each_line_is_one_message_byte_for_byte_and_the_same_trial_gives_the_same_file() {
    let recorded = recorded();
    let path = Path::new(&recorded.log);
    assert_eq!(records(path, "/fetch/plan").expect("a log"), [recorded.stages[2].trim_end()]);
    assert_eq!(records(path, "/fetch/drive").expect("a log"), [recorded.stages[3].trim_end()]);
    let first = std::fs::read(path).expect("readable");
    run("drive", &["--record", &recorded.log, "--force", "-j", "1"], &recorded.stages[2]).expect_code(0);
    assert!(std::fs::read(path).expect("readable") == first, "two files for one trial");
}

/// Sees with the camera as the robot does, and keeps what it sees.
struct Witness {
    detector: Detector,
    map: RoomMap,
    seen: Vec<Value>,
}

impl Watcher for Witness {
    fn frame(&mut self, _time_s: f64, _believed: Pose, frame: &RgbdFrame) {
        let view = self.detector.detect(frame, Some(&self.map));
        self.seen.push(serde_json::to_value(view.furniture).expect("serializes"));
    }
}

/// A trial with the camera: what the robot saw, look by look, and the log of the same trial.
fn seen_and_recorded(folder: &Path) -> (Vec<Value>, String) {
    let log = folder.join("seen.mcap").to_str().expect("UTF-8").to_string();
    let planned = pipe(&["chunk", "ground", "plan"], "the fork is in the living room on the table on the right\n");
    let record = Record::parse(&planned).expect("a record");
    let plan: Plan = record.require("plan", "").expect("a plan");
    let home = Home::load(None, None).expect("the apartment");
    let settings = TrialSettings { perception: Perception::Camera, seed: 2, ..TrialSettings::default() };
    let mut witness = Witness { detector: Detector::default(), map: home.map.clone(), seen: Vec::new() };
    let stream = stream_of(&record.id().expect("an id"));
    spatial_fetch::simulation::run(&home, &plan, &settings, stream, &mut witness);
    run("drive", &["--perception", "camera", "--seed", "2", "--record", &log], &planned).expect_code(0);
    (witness.seen, log)
}

#[test]
fn perceive_sees_in_the_log_what_the_robot_saw_and_one_room_when_fused() {
    let folder = tempfile::tempdir().expect("a folder");
    let (seen, log) = seen_and_recorded(folder.path());
    let map = "fixtures/apartment.map.json";
    let again = run("perceive", &["--least-confidence", "0", "--map", map, &log], "").expect_code(0).records();
    assert!(seen.len() > 10, "{} looks", seen.len());
    let again: Vec<&Value> = again.iter().map(|record| &record["detections"]).collect();
    assert_eq!(again, seen.iter().collect::<Vec<_>>());

    let fused = run("perceive", &["--fuse", "--map", map, &log], "").expect_code(0).records();
    assert_eq!((fused.len(), fused[0]["frames"].as_array().map(Vec::len)), (1, Some(seen.len())));
    let couches = fused[0]["detections"].as_array().expect("an array").iter().filter(|d| d["category"] == "couch");
    // The couch faces away from the door at (4.5, 3).
    let near = |d: &&Value| (d["x"].as_f64().unwrap_or(0.0) - 4.5).hypot(d["y"].as_f64().unwrap_or(0.0) - 3.0) < 0.5;
    assert_eq!(couches.filter(near).count(), 1, "{}", fused[0]["detections"]);
}

#[test]
fn a_topic_that_is_not_there_is_answered_with_those_that_are() {
    let recorded = recorded();
    let ran = run("plan", &["--from", &recorded.log, "--topic", "/no/such"], "").expect_code(3);
    assert!(ran.err.contains("no record on /no/such") && ran.err.contains("/fetch/ground"), "{}", ran.err);
    let ran = run("plan", &["--from", &recorded.log, "--topic", "/tf"], "").expect_code(3);
    assert!(
        ran.err.contains("/tf holds no records: its encoding is `protobuf` (foxglove.FrameTransforms)"),
        "{}",
        ran.err
    );
}

#[test]
fn a_window_of_time_leaves_out_what_lies_outside() {
    let recorded = recorded();
    let ran = run("ground", &["--from", &recorded.log, "--start", "0.5"], "").expect_code(0);
    assert_eq!(ran.out, "");
    let ran = run("ground", &["--from", &recorded.log, "--end", "0.5"], "").expect_code(0);
    assert_eq!(ran.out, recorded.stages[1]);
    let ran = run("ground", &["--start", "0.5"], "").expect_code(2);
    assert!(ran.err.contains("name it by --from"), "{}", ran.err);
}

#[test]
fn a_log_that_is_no_log_and_one_that_is_not_there_are_named() {
    let manifest = concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml");
    let ran = run("chunk", &["--from", manifest], "").expect_code(1);
    assert!(ran.err.contains("Cargo.toml: not an MCAP log"), "{}", ran.err);
    let ran = run("chunk", &["--from", "no/such.mcap"], "").expect_code(1);
    assert!(ran.err.contains("no/such.mcap: "), "{}", ran.err);
}

#[test]
fn a_cut_log_gives_what_it_has_and_exit_3() {
    let recorded = recorded();
    let bytes = std::fs::read(&recorded.log).expect("readable");
    std::fs::write(&recorded.log, &bytes[..bytes.len() / 2]).expect("written");
    for arguments in [vec!["--from", recorded.log.as_str()], vec!["--from", &recorded.log, "--recover"]] {
        let ran = run("chunk", &arguments, "").expect_code(3);
        assert_eq!(ran.out, recorded.stages[0]);
        assert!(ran.err.contains("cut off here"), "{}", ran.err);
    }
}

/// The seconds at which the robot's odometry was logged.
fn odometry_times(log: &Path) -> Vec<f64> {
    let file = std::fs::File::open(log).expect("a log");
    let reader = spatial_fetch::recording::LogReader::new(file, "log", true).expect("a log");
    let messages = reader.filter_map(Result::ok).filter(|message| message.channel.topic == "/odom");
    messages.map(|message| message.log_time as f64 / 1e9).collect()
}

#[test]
fn a_trial_that_was_killed_leaves_everything_but_the_last_second() {
    let folder = tempfile::tempdir().expect("a folder");
    let log = folder.path().join("killed.mcap");
    let chunked = pipe(&["chunk"], SENTENCE);
    let plan = folder.path().join("plan.jsonl");
    std::fs::write(&plan, pipe(&["ground", "plan"], &chunked)).expect("written");
    let whole = folder.path().join("whole.mcap");
    run("drive", &["--record", whole.to_str().expect("UTF-8"), plan.to_str().expect("UTF-8")], "").expect_code(0);
    let all = odometry_times(&whole);
    let whole = std::fs::read(whole).expect("readable");
    // The log grows while the trial goes on: it is killed once so much of it is there.
    for tenth in 1..=10 {
        killed_at(whole.len() as u64 * tenth / 11, &log, &plan);
        let left = std::fs::read(&log).expect("readable");
        assert_eq!(left, whole[..left.len()], "killed after {tenth} parts of 11: not the beginning of the whole log");
        let times = odometry_times(&log);
        assert!(times == all[..times.len()], "killed after {tenth} parts of 11: a gap");
        let again = run("chunk", &["--from", log.to_str().expect("UTF-8"), "--recover"], "");
        assert!([0, 3].contains(&again.code) && again.out == chunked, "killed after {tenth} parts of 11: {again:?}");
    }
}

#[test]
fn what_the_camera_showed_is_perceived_again_from_the_log() {
    let folder = tempfile::tempdir().expect("a folder");
    let log = folder.path().join("camera.mcap");
    let planned = pipe(&["chunk", "ground", "plan"], "go into the bedroom\n");
    let arguments = ["--perception", "camera", "--time-limit", "30", "--record", log.to_str().expect("UTF-8")];
    run("drive", &arguments, &planned).expect_code(0);
    let detections = |line: String| -> serde_json::Value {
        serde_json::from_str::<serde_json::Value>(&line).expect("JSON")["detections"].take()
    };
    let seen: Vec<_> = records(&log, "/fetch/seen").expect("a log").into_iter().map(detections).collect();
    let again = run("perceive", &["--least-confidence", "0", "--map", "apartment", log.to_str().expect("UTF-8")], "");
    let again = again.expect_code(0);
    let again: Vec<_> = again.out.lines().map(str::to_string).map(detections).collect();
    assert!(seen.len() > 3 && again == seen, "{again:?} instead of {seen:?}");
}

#[test]
fn at_no_moment_is_more_than_a_second_missing_from_the_log() {
    let recorded = recorded();
    let whole = std::fs::read(&recorded.log).expect("readable");
    let cut = Path::new(&recorded.log).with_extension("cut");
    let mut last = 0.0;
    for length in (1..=1000).map(|part| whole.len() * part / 1000) {
        std::fs::write(&cut, &whole[..length]).expect("written");
        let reached = odometry_times(&cut).last().copied().unwrap_or(0.0);
        // The trial's first second may be shorter or longer by a control period.
        assert!((0.0..=1.1).contains(&(reached - last)), "from {last} s to {reached} s at once");
        last = reached;
    }
}

/// Records a trial and kills it as soon as its log has so many bytes.
fn killed_at(bytes: u64, log: &Path, plan: &Path) {
    let mut drive = Command::new(executable("drive"))
        .args(["--force", "--record"])
        .args([log, plan])
        .stdout(Stdio::null())
        .spawn()
        .expect("starts");
    while std::fs::metadata(log).map_or(0, |found| found.len()) < bytes {
        if drive.try_wait().expect("waits").is_some() {
            break;
        }
    }
    let _ = drive.kill();
    drive.wait().expect("ends");
}

#[test]
fn a_replay_is_run_as_the_first_time_unless_told_otherwise() {
    let folder = tempfile::tempdir().expect("a folder");
    let log = folder.path().join("trial.mcap");
    let log = log.to_str().expect("UTF-8");
    let first = ["--seed", "7", "--noise", "double", "--no-glance", "--world", "studio"];
    let planned = pipe(&["chunk", "ground"], "the book is on the table\n");
    let planned = run("plan", &["--map", "studio"], planned).expect_code(0).out;
    let driven = run("drive", &[&first[..], &["--record", log]].concat(), &planned).expect_code(0).out;
    let again = run("drive", &["--replay", log], "").expect_code(0);
    assert_eq!(again.out, driven);
    assert!(again.err.contains("as recorded: --no-glance --noise double --seed 7 --world studio"), "{}", again.err);
    let other = run("drive", &["--replay", log, "--seed", "8"], "").expect_code(0);
    assert_ne!(other.out, driven);
    assert!(other.err.contains("--seed 8 instead of 7, as recorded"), "{}", other.err);
    assert_eq!(other.out, run("drive", &[&first[..], &["--seed", "8"]].concat()[2..], &planned).expect_code(0).out);
}

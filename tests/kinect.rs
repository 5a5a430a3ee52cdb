//! `drive --camera kinect`, with libfreenect's own replay in the place of a Kinect.
#![cfg(feature = "kinect")]

mod common;
#[path = "common/served.rs"]
mod served;

use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

use common::{executable, run};
use served::{AHEAD, Served};
use spatial_fetch::recording::{FrameOptions, FrameReader, records};

/// A recording of two seconds that shows a wall, near on the left and far on the right, as the recorder leaves it.
fn record_into(folder: &Path) {
    let row: Vec<u8> = (0..640).flat_map(|column| if column < 320 { 700_u16 } else { 900 }.to_le_bytes()).collect();
    let depth = [b"P5 640 480 65535\n".as_slice(), &row.repeat(480)].concat();
    let color = [b"P6 640 480 255 \n".as_slice(), &[200, 30, 60].repeat(640 * 480)].concat();
    let mut index = String::new();
    for (kind, bytes) in [("d-1000.000000-0.pgm", depth), ("r-1000.000000-0.ppm", color)] {
        std::fs::write(folder.join(kind), bytes).expect("written");
        for frame in 1..60 {
            let time = format!("{:.6}-{frame}", 1000.0 + f64::from(frame) / 30.0);
            let name = kind.replace("1000.000000-0", &time);
            std::fs::hard_link(folder.join(kind), folder.join(&name)).expect("linked");
        }
    }
    for frame in 0..60 {
        let time = format!("{:.6}-{frame}", 1000.0 + f64::from(frame) / 30.0);
        index += &format!("d-{time}.pgm\nr-{time}.ppm\n");
    }
    std::fs::write(folder.join("INDEX.txt"), index).expect("written");
}

#[test]
fn what_the_kinect_sees_is_in_the_log_in_metres() {
    let served = Served::start(&[]);
    let folder = tempfile::tempdir().expect("a folder");
    record_into(folder.path());
    let log = served.path("trial.mcap");
    let mut child = Command::new("fakenect")
        .arg(folder.path())
        .arg(executable("drive"))
        .args(["--robot", &served.address(), "--map", &served.map(), "--camera", "kinect", "--time-limit", "6"])
        .arg("--record")
        .arg(&log)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("fakenect is installed: apt install libfreenect-bin");
    writeln!(child.stdin.take().expect("piped"), "{AHEAD}").expect("written");
    let ended = child.wait_with_output().expect("ends");
    let said = String::from_utf8_lossy(&ended.stderr);
    assert_eq!(ended.status.code(), Some(0), "{said}");
    assert!(said.contains("camera: the recording has ended"), "{said}");
    let file = std::fs::File::open(&log).expect("a log");
    let frames = FrameReader::new(file, "trial.mcap", FrameOptions::default()).expect("a log");
    let frame = frames.flatten().next().expect("a frame").frame;
    assert!(!records(&log, "/fetch/seen").expect("a log").is_empty());
    let at = |column: usize| f64::from(frame.depth[240 * 640 + column]) * frame.depth_unit_m;
    assert!((0.8..0.95).contains(&at(150)) && (1.5..2.2).contains(&at(500)), "{} {}", at(150), at(500));
}

#[test]
fn without_a_kinect_the_robot_is_told_so_and_drives_on() {
    let served = Served::start(&[]);
    let arguments = ["--robot", &served.address(), "--map", &served.map(), "--camera", "kinect", "--time-limit", "4"];
    let ran = run("drive", &arguments, AHEAD).expect_code(0);
    assert!(ran.err.contains("camera: fakenect-record: ") && ran.err.contains("plugged in"), "{}", ran.err);
}

//! Frames from the logs of other robots: ROS 2, ROS 1 and Foxglove give what the picture files give.

mod common;

use std::collections::BTreeMap;
use std::path::Path;

use common::{Ran, run};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use serde_json::{Value, json};
use spatial_fetch::frame::RgbdFrame;
use spatial_fetch::geometry::Pose;
use spatial_fetch::map::RoomMap;
use spatial_fetch::recording::{FrameWriter, TimedFrame};
use spatial_fetch::simulation::Scene;
use spatial_fetch::simulation::camera::{Kinect, SolidScene};

/// When the first frame was taken, and the time to the next, seconds.
const BEGIN_S: f64 = 1_700_000_000.0;
const STEP_S: f64 = 0.5;

fn frames() -> Vec<RgbdFrame> {
    let solids = SolidScene::new(&RoomMap::apartment(), &Scene::apartment());
    let kinect = Kinect { camera: spatial_fetch::frame::Camera::kinect().coarser(2), ..Kinect::default() };
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let poses = [Pose::new(3.0, 2.0, 0.4), Pose::new(3.0, 2.0, 2.0)];
    poses.map(|pose| kinect.capture(&solids, pose, &mut rng).0).to_vec()
}

/// The frames as JSON lines and PNG files, and what `perceive` finds in them.
fn detections_from_files(folder: &Path, frames: &[RgbdFrame]) -> Vec<Value> {
    let mut lines = String::new();
    for (i, frame) in frames.iter().enumerate() {
        std::fs::write(folder.join(format!("{i}.depth.png")), frame.depth_png()).expect("written");
        std::fs::write(folder.join(format!("{i}.png")), frame.color_png()).expect("written");
        let k = frame.intrinsics;
        let line = json!({"depth": format!("{i}.depth.png"), "rgb": format!("{i}.png"),
            "fx": k.fx, "fy": k.fy, "cx": k.cx, "cy": k.cy, "depth_unit_m": 0.001, "T_world_cam": frame.world_from_camera});
        lines.push_str(&format!("{line}\n"));
    }
    let path = folder.join("frames.jsonl");
    std::fs::write(&path, lines).expect("written");
    detections(&run("perceive", &[path.to_str().expect("UTF-8")], "").expect_code(0))
}

fn detections(ran: &Ran) -> Vec<Value> {
    ran.records().into_iter().map(|mut record| record["detections"].take()).collect()
}

/// ROS serialization, of either kind.
struct Ros {
    bytes: Vec<u8>,
    ros1: bool,
}

impl Ros {
    fn new(ros1: bool) -> Self {
        Self { bytes: if ros1 { Vec::new() } else { vec![0, 1, 0, 0] }, ros1 }
    }

    fn align(&mut self, size: usize) {
        while !self.ros1 && !(self.bytes.len() - 4).is_multiple_of(size) {
            self.bytes.push(0);
        }
    }

    fn u32(&mut self, value: u32) {
        self.align(4);
        self.bytes.extend(value.to_le_bytes());
    }

    fn f64(&mut self, value: f64) {
        self.align(8);
        self.bytes.extend(value.to_le_bytes());
    }

    fn string(&mut self, text: &str) {
        self.u32(text.len() as u32 + u32::from(!self.ros1));
        self.bytes.extend(text.as_bytes());
        if !self.ros1 {
            self.bytes.push(0);
        }
    }

    fn header(&mut self, time_s: f64, frame: &str) {
        if self.ros1 {
            self.u32(0);
        }
        self.u32(time_s as u32);
        self.u32((time_s.fract() * 1e9) as u32);
        self.string(frame);
    }

    fn image(ros1: bool, time_s: f64, frame: &RgbdFrame, encoding: &str, data: &[u8]) -> Vec<u8> {
        let mut ros = Self::new(ros1);
        ros.header(time_s, "kinect_optical");
        ros.u32(frame.height as u32);
        ros.u32(frame.width as u32);
        ros.string(encoding);
        ros.bytes.push(0);
        ros.u32((data.len() / frame.height) as u32);
        ros.u32(data.len() as u32);
        ros.bytes.extend(data);
        ros.bytes
    }

    fn info(ros1: bool, time_s: f64, frame: &RgbdFrame) -> Vec<u8> {
        let mut ros = Self::new(ros1);
        ros.header(time_s, "kinect_optical");
        ros.u32(frame.height as u32);
        ros.u32(frame.width as u32);
        ros.string("plumb_bob");
        ros.u32(0);
        let k = frame.intrinsics;
        [k.fx, 0.0, k.cx, 0.0, k.fy, k.cy, 0.0, 0.0, 1.0].into_iter().for_each(|value| ros.f64(value));
        (0..21).for_each(|_| ros.f64(0.0));
        ros.bytes.extend([0; 48]);
        ros.bytes
    }

    fn transform(ros1: bool, time_s: f64, frame: &RgbdFrame) -> Vec<u8> {
        let mut ros = Self::new(ros1);
        ros.u32(1);
        ros.header(time_s, "map");
        ros.string("kinect_optical");
        let t = &frame.world_from_camera;
        let turn = Matrix3::from_fn(|row, column| t[row][column]);
        let q = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(turn));
        [t[0][3], t[1][3], t[2][3], q.i, q.j, q.k, q.w].into_iter().for_each(|value| ros.f64(value));
        ros.bytes
    }
}

/// What to do to a message's log time and stamp, and which messages to leave out.
#[derive(Clone, Copy, Default)]
struct Faults {
    color_late_s: f64,
    no_info: bool,
    clock_back_s: f64,
    tf_off_s: f64,
    encoding: &'static str,
}

fn ros_log(frames: &[RgbdFrame], ros1: bool, metres: bool, faults: Faults) -> Vec<u8> {
    let mut writer = mcap::Writer::new(std::io::Cursor::new(Vec::new())).expect("begun");
    let (message, schema) = if ros1 { ("ros1", "ros1msg") } else { ("cdr", "ros2msg") };
    let message = if faults.encoding.is_empty() { message } else { faults.encoding };
    let mut channel = |topic: &str, ros2_name: &str| {
        let name = if ros1 { ros2_name.replace("/msg/", "/") } else { ros2_name.to_string() };
        let schema = writer.add_schema(&name, schema, b"# left out").expect("added");
        writer.add_channel(schema, topic, message, &BTreeMap::new()).expect("added")
    };
    let depth = channel("/kinect/depth", "sensor_msgs/msg/Image");
    let color = channel("/kinect/rgb", "sensor_msgs/msg/Image");
    let info = channel("/kinect/info", "sensor_msgs/msg/CameraInfo");
    let tf = channel("/tf", "tf2_msgs/msg/TFMessage");
    let mut put = |channel_id: u16, time_s: f64, data: &[u8]| {
        let time = (time_s * 1e9) as u64;
        let header = mcap::records::MessageHeader { channel_id, sequence: 0, log_time: time, publish_time: time };
        writer.write_to_known_channel(&header, data).expect("written");
    };
    for (i, frame) in frames.iter().enumerate() {
        let log_s = BEGIN_S + STEP_S * i as f64;
        let time_s = if i == 0 { log_s } else { log_s - faults.clock_back_s };
        let bytes: Vec<u8> = if metres {
            frame.depth.iter().flat_map(|&d| (f32::from(d) / 1000.0).to_le_bytes()).collect()
        } else {
            frame.depth.iter().flat_map(|d| d.to_le_bytes()).collect()
        };
        put(depth, log_s, &Ros::image(ros1, time_s, frame, if metres { "32FC1" } else { "16UC1" }, &bytes));
        let bgr: Vec<u8> = frame.color.iter().flat_map(|&[r, g, b]| [b, g, r]).collect();
        put(color, log_s, &Ros::image(ros1, time_s + faults.color_late_s, frame, "bgr8", &bgr));
        if !faults.no_info {
            put(info, log_s, &Ros::info(ros1, time_s, frame));
        }
        put(tf, log_s, &Ros::transform(ros1, time_s + faults.tf_off_s, frame));
    }
    writer.finish().expect("finished");
    writer.into_inner().into_inner()
}

#[test]
fn ros_2_ros_1_and_foxglove_give_the_detections_of_the_picture_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let frames = frames();
    let wanted = detections_from_files(folder.path(), &frames);
    assert!(wanted.iter().any(|found| found.as_array().is_some_and(|all| !all.is_empty())), "nothing to compare");
    let mut foxglove = FrameWriter::new(Vec::new()).expect("begun");
    for (i, frame) in frames.iter().enumerate() {
        foxglove.write(&TimedFrame::at(STEP_S * i as f64, None, frame.clone())).expect("written");
    }
    let logs = [
        ("ros 2", ros_log(&frames, false, false, Faults::default())),
        ("ros 2 in metres", ros_log(&frames, false, true, Faults::default())),
        ("ros 1", ros_log(&frames, true, false, Faults::default())),
        ("foxglove", foxglove.finish().expect("finished")),
    ];
    for (name, log) in logs {
        let path = folder.path().join("log.mcap");
        std::fs::write(&path, &log).expect("written");
        let from_file = run("perceive", &["--from", path.to_str().expect("UTF-8")], "").expect_code(0);
        assert_eq!(detections(&from_file), wanted, "{name}");
        let from_pipe = run("perceive", &[], &log).expect_code(0);
        assert_eq!(detections(&from_pipe), wanted, "{name} through a pipe");
    }
}

#[test]
fn a_record_of_a_frame_keeps_its_times() {
    let log = ros_log(&frames()[..1], false, false, Faults::default());
    let record = run("perceive", &[], log).expect_code(0).records().remove(0);
    assert_eq!((&record["id"], &record["stamp_ns"]), (&"1".into(), &1_700_000_000_000_000_000_u64.into()));
}

/// Runs `perceive` on a log with faults: how many frames came out, and what was said; the exit code must be 3.
fn faulty(faults: Faults) -> (usize, String) {
    let ran = run("perceive", &[], ros_log(&frames(), false, false, faults)).expect_code(3);
    (ran.records().len(), ran.err)
}

#[test]
fn streams_that_are_not_synchronised_are_said_to_be_so_and_depth_is_still_read() {
    let (count, said) = faulty(Faults { color_late_s: 0.2, ..Faults::default() });
    assert_eq!(count, 2);
    assert!(said.contains("colour and depth are not synchronised"), "{said}");
}

#[test]
fn frames_without_intrinsics_are_skipped_and_named() {
    let (count, said) = faulty(Faults { no_info: true, ..Faults::default() });
    assert_eq!(count, 0);
    assert!(said.contains("no camera info") && said.contains("in all 2 frames without intrinsics"), "{said}");
}

#[test]
fn a_clock_that_was_moved_is_said_and_what_comes_after_is_read() {
    let (count, said) = faulty(Faults { clock_back_s: 100.0, ..Faults::default() });
    assert_eq!(count, 2, "{said}");
    assert!(said.contains("the clock moved back by 99.5 s"), "{said}");
}

#[test]
fn poses_of_another_clock_are_not_believed() {
    let (count, said) = faulty(Faults { tf_off_s: -5000.0, ..Faults::default() });
    assert_eq!(count, 0);
    assert!(said.contains("the clocks of the pictures and the poses differ"), "{said}");
}

#[test]
fn an_encoding_that_is_not_read_is_named_with_its_topic_and_type() {
    let (count, said) = faulty(Faults { encoding: "x-flatbuffer", ..Faults::default() });
    assert_eq!(count, 0);
    let named = "/kinect/depth (sensor_msgs/msg/Image) is skipped: its encoding `x-flatbuffer` is not read";
    assert!(said.contains(named) && said.contains("no frame in this log"), "{said}");
}

#[test]
fn only_the_topics_named_are_read() {
    let log = ros_log(&frames(), false, false, Faults::default());
    let ran = run("perceive", &["--topic", "/other/depth"], &log).expect_code(3);
    assert!(ran.err.contains("/kinect/depth (sensor_msgs/msg/Image, cdr, 2 messages)"), "{}", ran.err);
    let ran = run("perceive", &["--topic", "/kinect/depth", "--start", "0.4"], &log).expect_code(0);
    assert_eq!(ran.records().len(), 1);
}

//! Logs as robots write them: what is said another way, in another order, by two robots, or in several files.

mod common;

use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::Path;

use common::{Ran, run};
use mcap::records::MessageHeader;
use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use serde_json::Value;
use spatial_fetch::frame::{Camera, RgbdFrame};
use spatial_fetch::geometry::Pose;
use spatial_fetch::map::RoomMap;
use spatial_fetch::simulation::Scene;
use spatial_fetch::simulation::camera::{Kinect, SolidScene};

const BEGIN_S: f64 = 1_700_000_000.0;
const STEP_S: f64 = 0.5;
const OPTICAL: &str = "camera_optical";

/// A message of ROS 2, byte by byte.
#[derive(Clone)]
struct Cdr(Vec<u8>);

impl Cdr {
    fn new() -> Self {
        Self(vec![0, 1, 0, 0])
    }

    fn align(mut self, size: usize) -> Self {
        while !(self.0.len() - 4).is_multiple_of(size) {
            self.0.push(0);
        }
        self
    }

    fn byte(mut self, value: u8) -> Self {
        self.0.push(value);
        self
    }

    fn u32s(self, values: &[u32]) -> Self {
        let mut aligned = self.align(4);
        values.iter().for_each(|value| aligned.0.extend(value.to_le_bytes()));
        aligned
    }

    fn f64s(self, values: &[f64]) -> Self {
        let mut aligned = self.align(8);
        values.iter().for_each(|value| aligned.0.extend(value.to_le_bytes()));
        aligned
    }

    fn bytes(self, values: &[u8]) -> Self {
        let mut sized = self.u32s(&[values.len() as u32]);
        sized.0.extend(values);
        sized
    }

    fn string(self, text: &str) -> Self {
        self.bytes(&[text.as_bytes(), b"\0"].concat())
    }

    fn header(self, time_s: f64, frame: &str) -> Self {
        self.u32s(&[time_s as u32, (time_s.fract() * 1e9) as u32]).string(frame)
    }

    fn isometry(self, at: &Isometry3<f64>) -> Self {
        let (t, q) = (at.translation.vector, at.rotation.coords);
        self.f64s(&[t.x, t.y, t.z, q.x, q.y, q.z, q.w])
    }
}

/// How a log differs from the usual.
#[derive(Clone)]
struct Robot {
    space: &'static str,
    base: &'static str,
    /// Where the robot stands in its odometry's frame.
    pose: Pose,
    depth: (&'static str, &'static str),
    millimetres: bool,
    /// Camera info: pixels of the sensor for each of the picture's, binning, and columns and rows cut off before it.
    info: (u32, u32, [u32; 2]),
    without: &'static [&'static str],
}

const USUAL: Robot = Robot {
    space: "",
    base: "base_link",
    pose: Pose { x: 3.0, y: 2.0, heading: 0.4 },
    depth: ("/camera/depth/image_raw", "16UC1"),
    millimetres: false,
    info: (1, 0, [0, 0]),
    without: &[],
};

/// Topic, type, time and bytes.
type Written = (String, &'static str, f64, Vec<u8>);

fn taken(pose: Pose, seed: u64) -> RgbdFrame {
    let solids = SolidScene::new(&RoomMap::apartment(), &Scene::apartment());
    let kinect = Kinect { camera: Camera::kinect().coarser(2), ..Kinect::default() };
    kinect.capture(&solids, pose, &mut ChaCha8Rng::seed_from_u64(seed)).0
}

fn on_floor(pose: Pose) -> Isometry3<f64> {
    let turn = UnitQuaternion::from_euler_angles(0.0, 0.0, pose.heading);
    Isometry3::from_parts(Translation3::new(pose.x, pose.y, 0.0), turn)
}

/// The camera in the robot's base.
fn mount(frame: &RgbdFrame, pose: Pose) -> Isometry3<f64> {
    let t = &frame.world_from_camera;
    let turn = Rotation3::from_matrix_unchecked(Matrix3::from_fn(|row, column| t[row][column]));
    let at = Translation3::new(t[0][3], t[1][3], t[2][3]);
    on_floor(pose).inverse() * Isometry3::from_parts(at, UnitQuaternion::from_rotation_matrix(&turn))
}

fn transform(time_s: f64, parent: &str, child: &str, at: &Isometry3<f64>) -> Vec<u8> {
    Cdr::new().u32s(&[1]).header(time_s, parent).string(child).isometry(at).0
}

fn depth_picture(robot: &Robot, time_s: f64, frame: &RgbdFrame) -> Vec<u8> {
    let unit = if robot.millimetres { 1.0 } else { 0.001 };
    let data: Vec<u8> = match robot.depth.1 {
        "32FC1" => frame.depth.iter().flat_map(|&d| (f32::from(d) * unit).to_le_bytes()).collect(),
        _ => frame.depth.iter().flat_map(|d| d.to_le_bytes()).collect(),
    };
    let (w, h) = (frame.width as u32, frame.height as u32);
    let step = data.len() as u32 / h;
    Cdr::new().header(time_s, OPTICAL).u32s(&[h, w]).string(robot.depth.1).byte(0).u32s(&[step]).bytes(&data).0
}

fn camera_info(robot: &Robot, time_s: f64, frame: &RgbdFrame) -> Vec<u8> {
    let (sensor, binning, [left, top]) = robot.info;
    let (w, h, s) = (frame.width as u32, frame.height as u32, f64::from(sensor));
    let k = frame.intrinsics;
    let (cx, cy) = (k.cx * s + f64::from(left), k.cy * s + f64::from(top));
    let window = if left + top > 0 { [left, top, h, w] } else { [0; 4] };
    let [fx, fy] = [k.fx * s, k.fy * s];
    let size = [h * sensor + 2 * top, w * sensor + 2 * left];
    let told = Cdr::new().header(time_s, OPTICAL).u32s(&size).string("plumb_bob").u32s(&[0]);
    let told = told.f64s(&[fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0]).f64s(&[0.0; 21]);
    told.u32s(&[binning, binning]).u32s(&window).byte(0).0
}

/// What a robot writes of some frames, the first at a time.
fn written(robot: &Robot, count: usize, begin_s: f64) -> Vec<Written> {
    let frame = taken(robot.pose, 7);
    let topic = |name: &str| format!("{}{name}", robot.space);
    let mut all = Vec::new();
    let camera = mount(&frame, robot.pose);
    all.push((
        topic("/tf_static"),
        "tf2_msgs/msg/TFMessage",
        begin_s,
        transform(begin_s, "base_link", OPTICAL, &camera),
    ));
    for time_s in (0..count).map(|i| begin_s + STEP_S * i as f64) {
        let odometry = Cdr::new().header(time_s, "odom").string(robot.base).isometry(&on_floor(robot.pose));
        all.push((topic(robot.depth.0), "sensor_msgs/msg/Image", time_s, depth_picture(robot, time_s, &frame)));
        let info = camera_info(robot, time_s, &frame);
        all.push((topic("/camera/depth/camera_info"), "sensor_msgs/msg/CameraInfo", time_s, info));
        all.push((topic("/odom"), "nav_msgs/msg/Odometry", time_s, odometry.0));
    }
    all.retain(|(topic, ..)| !robot.without.iter().any(|name| topic.ends_with(name)));
    all
}

fn log(messages: &[Written]) -> Vec<u8> {
    let options = mcap::WriteOptions::new().chunk_size(Some(4096));
    let mut writer = options.create(Cursor::new(Vec::new())).expect("begun");
    // An attachment is read past, whatever its size.
    let (name, media_type, data) = ("map".to_string(), "any".to_string(), vec![7; 100_000].into());
    let attachment = mcap::Attachment { log_time: 0, create_time: 0, name, media_type, data };
    writer.attach(&attachment).expect("attached");
    let mut channels = BTreeMap::new();
    for (topic, name, time_s, data) in messages {
        let channel_id = *channels.entry(topic.clone()).or_insert_with(|| {
            let schema = writer.add_schema(name, "ros2msg", b"# left out").expect("added");
            writer.add_channel(schema, topic, "cdr", &BTreeMap::new()).expect("added")
        });
        let time = (time_s * 1e9) as u64;
        let header = MessageHeader { channel_id, sequence: 0, log_time: time, publish_time: time };
        writer.write_to_known_channel(&header, data).expect("written");
    }
    writer.finish().expect("finished");
    writer.into_inner().into_inner()
}

fn seen(folder: &Path, name: &str, messages: &[Written]) -> Ran {
    let path = folder.join(name);
    std::fs::write(&path, log(messages)).expect("written");
    run("perceive", &[path.to_str().expect("UTF-8")], "")
}

fn detections(ran: &Ran) -> Vec<Value> {
    ran.records().into_iter().map(|mut record| record["detections"].take()).collect()
}

/// What `perceive` finds in the log of a robot, and the code it ends with.
fn of(robot: &Robot) -> Ran {
    let folder = tempfile::tempdir().expect("a folder");
    seen(folder.path(), "robot.mcap", &written(robot, 2, BEGIN_S))
}

fn usual() -> Vec<Value> {
    let found = detections(&of(&USUAL).expect_code(0));
    assert!(found.len() == 2 && found[0].as_array().is_some_and(|all| !all.is_empty()), "nothing to compare");
    found
}

#[test]
fn odometry_of_the_base_by_another_name_is_the_same_or_is_said_to_be_of_another() {
    assert_eq!(detections(&of(&Robot { base: "/base_link", ..USUAL }).expect_code(0)), usual());
    let other = of(&Robot { base: "robot2/base_link", ..USUAL }).expect_code(3);
    assert!(other.records().is_empty(), "never in the frame of a base that moves");
    assert!(other.err.contains("end at `base_link`, and odometry moves `robot2/base_link`"), "{}", other.err);
}

#[test]
fn a_camera_described_at_another_size_binned_or_cut_out_sees_the_same() {
    for info in [(2, 0, [0, 0]), (2, 2, [0, 0]), (1, 0, [40, 30])] {
        assert_eq!(detections(&of(&Robot { info, ..USUAL }).expect_code(0)), usual(), "{info:?}");
    }
}

#[test]
fn topic_after_topic_is_read_in_the_order_of_time() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut messages = written(&USUAL, 6, BEGIN_S);
    let in_order = seen(folder.path(), "in-order.mcap", &messages).expect_code(0);
    messages.sort_by(|a, b| a.0.cmp(&b.0));
    let by_topic = seen(folder.path(), "by-topic.mcap", &messages).expect_code(0);
    assert_eq!((detections(&by_topic), detections(&in_order).len()), (detections(&in_order), 6));
    let piped = run("perceive", &[], log(&messages)).expect_code(3);
    assert!(piped.err.contains("not in the order of its times"), "{}", piped.err);
}

#[test]
fn of_two_robots_each_is_placed_by_its_own_transforms_and_odometry() {
    let folder = tempfile::tempdir().expect("a folder");
    let one = written(&Robot { space: "/robot1", ..USUAL }, 2, BEGIN_S);
    let elsewhere = Pose { x: -4.0, y: 1.0, heading: 2.0 };
    let other = Robot { space: "/robot2", without: &["/image_raw"], pose: elsewhere, ..USUAL };
    let mut both = [one, written(&other, 2, BEGIN_S)].concat();
    both.sort_by(|a, b| a.2.total_cmp(&b.2));
    assert_eq!(detections(&seen(folder.path(), "two.mcap", &both).expect_code(0)), usual());
}

#[test]
fn floats_of_millimetres_are_said_to_be_none_of_metres() {
    let depth = ("/camera/depth/image_raw", "32FC1");
    let ran = of(&Robot { depth, millimetres: true, ..USUAL }).expect_code(3);
    assert!(ran.records().is_empty() && ran.err.contains("perhaps the floats are millimetres"), "{}", ran.err);
    assert_eq!(detections(&of(&Robot { depth, ..USUAL }).expect_code(0)), usual());
}

#[test]
fn infrared_is_no_depth() {
    let folder = tempfile::tempdir().expect("a folder");
    let infrared = Robot { depth: ("/camera/ir/image_raw", "mono16"), ..USUAL };
    let alone = of(&infrared).expect_code(3);
    assert!(alone.records().is_empty() && alone.err.contains("infrared, by the topic's name"), "{}", alone.err);
    let grey = of(&Robot { depth: ("/camera/image_raw", "mono16"), ..USUAL }).expect_code(3);
    assert!(grey.err.contains("mono16 is no depth unless it is named"), "{}", grey.err);
    let mut both = [written(&infrared, 2, BEGIN_S), written(&USUAL, 2, BEGIN_S)].concat();
    both.sort_by(|a, b| a.2.total_cmp(&b.2));
    assert_eq!(detections(&seen(folder.path(), "both.mcap", &both).expect_code(0)), usual());
}

#[test]
fn the_files_of_a_split_recording_go_on_with_each_other() {
    let folder = tempfile::tempdir().expect("a folder");
    let second = Robot { without: &["/tf_static"], ..USUAL };
    let parts = [("b.mcap", written(&USUAL, 2, BEGIN_S)), ("a.mcap", written(&second, 2, BEGIN_S + 1.0))];
    let paths = parts.map(|(name, messages)| {
        let path = folder.path().join(name);
        std::fs::write(&path, log(&messages)).expect("written");
        path.display().to_string()
    });
    let together = run("perceive", &[&paths[0], &paths[1]], "").expect_code(0);
    assert_eq!(detections(&together), [usual(), usual()].concat());
    let turned = run("perceive", &[&paths[1], &paths[0]], "").expect_code(0);
    assert_eq!(turned.out, together.out);
    run("perceive", &[&paths[1]], "").expect_code(3);
}

#[test]
fn a_camera_held_in_the_hand_stands_over_the_floor_that_it_sees() {
    let ran = of(&Robot { without: &["/tf_static", "/odom"], ..USUAL }).expect_code(0);
    let record = &ran.records()[0];
    assert_eq!(record["camera"]["from"], "floor");
    assert!((record["camera"]["height"].as_f64().expect("metres") - 1.2).abs() < 0.05, "{}", record["camera"]);
    assert_eq!(record["robot_pose"], Value::Null);
}

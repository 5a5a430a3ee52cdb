//! The log of one trial, to be opened in Foxglove as it is.

use std::collections::BTreeMap;

use foxglove::messages::{Color, CompressedImage, FrameTransforms, Log, Pose as Pose3, PoseInFrame, PosesInFrame, log};
use nalgebra::Isometry3;
use serde::Serialize;

use super::frame_writer::{TF, camera_transforms, link_to_optical, transform, write_pictures};
use super::log_writer::LogWriter;
use super::mount::tower_link;
use super::record_schema::RECORD_SCHEMA;
use super::shapes::{self, ShownPiece, pose3};
use super::time::{nanoseconds, timestamp};
use super::timed_frame::in_space;
use super::trial_sinks::TrialSinks;
use super::{LogError, Target, TimedFrame};
use crate::frame::Camera;
use crate::geometry::{ClearanceGrid, Pose, Vec2};

/// The log is handed to the disk at least this often, seconds of the trial.
const FLUSH_S: f64 = 1.0;
/// The path is shown with a pose at least this far from the last, metres.
const PATH_SPACING_M: f64 = 0.1;

/// Writes one trial while it goes on: what has been flushed can be read whatever happens next.
pub struct TrialLog {
    name: String,
    log: LogWriter<TrialSinks>,
    path: Vec<Pose>,
    flushed_s: f64,
    failed: Option<LogError>,
}

/// What the base measures, for plots.
#[derive(Serialize)]
struct Velocity {
    linear_m_s: f64,
    angular_rad_s: f64,
}

impl TrialLog {
    /// Begins a log; refuses a file that exists unless forced. `camera` is where it sits on the robot, `about` says
    /// how the trial is run.
    ///
    /// # Errors
    /// When the file exists and is not to be overwritten, or cannot be written.
    pub fn create(target: &Target, camera: &Camera, about: BTreeMap<String, String>) -> Result<Self, LogError> {
        let name = target.file.map_or("the log".to_string(), |path| path.display().to_string());
        let log = Self::begin(target, camera, about).map_err(|error| error.named(&name))?;
        Ok(Self { name, log, path: Vec::new(), flushed_s: 0.0, failed: None })
    }

    fn begin(
        target: &Target,
        camera: &Camera,
        about: BTreeMap<String, String>,
    ) -> Result<LogWriter<TrialSinks>, LogError> {
        let mut log = LogWriter::new(TrialSinks::open(target, about)?);
        let link = |parent: &str, child: &str, pose| transform(0, parent, child, pose);
        let fixed = vec![
            link("map", "odom", Isometry3::identity()),
            link("base_link", "camera_link", tower_link(camera)),
            link_to_optical(0),
        ];
        log.message("/tf_static", 0, &FrameTransforms { transforms: fixed })?;
        log.flush()?;
        Ok(log)
    }

    /// Whether a write has failed, as on a full disk.
    pub fn has_failed(&self) -> bool {
        self.failed.is_some()
    }

    /// Writes; a simulated trial is not broken off for its log's sake.
    fn put(&mut self, write: impl FnOnce(&mut LogWriter<TrialSinks>) -> Result<(), LogError>) {
        if let Err(error) = write(&mut self.log) {
            self.failed.get_or_insert(error);
        }
    }

    /// The robot is here, by its own belief, and moves at this velocity (m/s, rad/s).
    pub fn pose(&mut self, time_s: f64, pose: Pose, (linear_m_s, angular_rad_s): (f64, f64)) {
        let time_ns = nanoseconds(time_s);
        let transforms = vec![transform(time_ns, "odom", "base_link", in_space(pose))];
        self.put(|log| log.message(TF, time_ns, &FrameTransforms { transforms }));
        let odometry =
            PoseInFrame { timestamp: Some(timestamp(time_ns)), frame_id: "odom".to_string(), pose: Some(pose3(pose)) };
        self.put(|log| log.message("/odom", time_ns, &odometry));
        // Two numbers always serialize.
        let line = serde_json::to_string(&Velocity { linear_m_s, angular_rad_s }).unwrap_or_default();
        self.put(|log| log.json("/fetch/velocity", "spatial_fetch.Velocity", VELOCITY_SCHEMA, time_ns, &line));
        if self.path.last().is_none_or(|last| last.distance_to(pose.position()) >= PATH_SPACING_M) {
            self.path.push(pose);
        }
        // Times are sums of steps, so a whole second may fall short by a rounding.
        if time_s - self.flushed_s >= FLUSH_S - 1e-6 {
            self.flush(time_s);
        }
    }

    /// What the sonars hear: points about the robot, metres from its centre.
    pub fn sonar(&mut self, time_s: f64, echoes: &[Vec2]) {
        let time_ns = nanoseconds(time_s);
        self.put(|log| log.message("/sonar", time_ns, &shapes::echoes(time_ns, echoes)));
    }

    fn flush(&mut self, time_s: f64) {
        self.flushed_s = time_s;
        let time_ns = nanoseconds(time_s);
        let poses: Vec<Pose3> = self.path.iter().map(|pose| pose3(*pose)).collect();
        let path = PosesInFrame { timestamp: Some(timestamp(time_ns)), frame_id: "map".to_string(), poses };
        self.put(|log| log.message("/fetch/path", time_ns, &path));
        self.put(LogWriter::flush);
    }

    /// A decision or an event, with its reason; handed to the disk at once.
    pub fn said(&mut self, time_s: f64, text: &str) {
        let line = Log {
            timestamp: Some(timestamp(nanoseconds(time_s))),
            level: log::Level::Info as i32,
            message: text.to_string(),
            name: "drive".to_string(),
            ..Log::default()
        };
        self.put(|log| log.message("/fetch/log", nanoseconds(time_s), &line));
        self.flush(time_s);
    }

    /// The walls of the room map.
    pub fn walls(&mut self, walls: &[(Vec2, Vec2)], height: f64) {
        self.put(|log| log.message("/fetch/scene", 0, &shapes::walls(walls, height)));
    }

    /// What the robot believes of the furniture.
    pub fn believed(&mut self, time_s: f64, pieces: &[ShownPiece]) {
        let color = Color { r: 0.2, g: 0.45, b: 0.8, a: 0.8 };
        let time_ns = nanoseconds(time_s);
        let update = shapes::furniture("believed", time_ns, pieces, color);
        self.put(|log| log.message("/fetch/scene", time_ns, &update));
    }

    /// What is true of the furniture.
    pub fn truth(&mut self, pieces: &[ShownPiece]) {
        let color = Color { r: 0.7, g: 0.6, b: 0.45, a: 0.4 };
        let update = shapes::furniture("true", 0, pieces, color);
        self.put(|log| log.message("/fetch/scene_true", 0, &update));
    }

    /// The grid on which ways are planned.
    pub fn grid(&mut self, time_s: f64, grid: &ClearanceGrid) {
        let time_ns = nanoseconds(time_s);
        self.put(|log| log.message("/fetch/map", time_ns, &shapes::grid(time_ns, grid)));
    }

    /// What the camera shows, raw, for perception to be run again on it.
    pub fn frame(&mut self, frame: &TimedFrame) {
        self.put(|log| log.message(TF, frame.log_ns, &camera_transforms(frame)));
        self.put(|log| write_pictures(log, frame));
    }

    /// What the eyes made of a look, one JSON line.
    pub fn seen(&mut self, time_s: f64, line: &str) {
        self.put(|log| log.json("/fetch/seen", "spatial_fetch.Seen", SEEN_SCHEMA, nanoseconds(time_s), line));
    }

    /// The last picture, as PNG.
    pub fn picture(&mut self, time_s: f64, png: Vec<u8>) {
        let time_ns = nanoseconds(time_s);
        let image = CompressedImage {
            timestamp: Some(timestamp(time_ns)),
            frame_id: "camera_optical_frame".to_string(),
            data: png.into(),
            format: "png".to_string(),
        };
        self.put(|log| log.message("/camera/color/image_raw/compressed", time_ns, &image));
    }

    /// A record as a stage wrote it, byte for byte: `/fetch/STAGE`; handed to the disk at once.
    pub fn record(&mut self, time_s: f64, stage: &str, line: &str) {
        let topic = format!("/fetch/{stage}");
        let schema = RECORD_SCHEMA.as_str();
        self.put(|log| log.json(&topic, "spatial_fetch.Record", schema, nanoseconds(time_s), line));
        self.put(LogWriter::flush);
    }

    /// The options of the run, one JSON line.
    pub fn options(&mut self, topic: &str, line: &str) {
        self.put(|log| log.json(topic, "spatial_fetch.Options", OPTIONS_SCHEMA, 0, line));
    }

    /// Ends the log; tells of any write that failed on the way.
    ///
    /// # Errors
    /// When anything could not be written on the way.
    pub fn finish(mut self, time_s: f64) -> Result<(), LogError> {
        self.flush(time_s);
        let finished = match self.failed {
            Some(error) => Err(error),
            None => self.log.into_sink().finish(),
        };
        finished.map_err(|error| error.named(&self.name))
    }
}

const SEEN_SCHEMA: &str = r#"{"type":"object","properties":{"detections":{"type":"array","items":{"type":"object"}}}}"#;

const OPTIONS_SCHEMA: &str = r#"{"type":"object"}"#;

const VELOCITY_SCHEMA: &str =
    r#"{"type":"object","properties":{"linear_m_s":{"type":"number"},"angular_rad_s":{"type":"number"}}}"#;

#[cfg(test)]
mod tests {
    use std::fs::File;
    use std::path::Path;

    use super::*;
    use crate::frame::{Intrinsics, RgbdFrame};
    use crate::recording::timed_frame::optical_from_link;
    use crate::recording::{FrameOptions, FrameReader, records};

    fn link_from_optical() -> Isometry3<f64> {
        optical_from_link().inverse()
    }

    fn into(path: &Path) -> Target<'_> {
        Target { file: Some(path), force: true, live: None }
    }

    fn write(path: &Path) {
        let mut log = TrialLog::create(&into(path), &Camera::kinect(), BTreeMap::new()).expect("created");
        log.walls(&[(Vec2::new(0.0, 0.0), Vec2::new(1.0, 0.0))], 2.5);
        log.pose(0.1, Pose::new(1.0, 2.0, 0.5), (0.3, 0.0));
        log.sonar(0.1, &[Vec2::new(1.0, 0.0)]);
        log.grid(0.1, &ClearanceGrid::new(Vec2::zeros(), Vec2::repeat(1.0), 0.1, 0.5));
        log.said(0.2, "begin enter");
        log.record(1.5, "drive", r#"{"id":"ä","x":1.0}"#);
        log.finish(1.5).expect("finished");
    }

    #[test]
    fn a_record_comes_back_byte_for_byte() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("log.mcap");
        write(&path);
        assert_eq!(records(&path, "/fetch/drive").expect("readable"), [r#"{"id":"ä","x":1.0}"#]);
    }

    #[test]
    fn the_camera_s_frames_come_back_where_they_were_taken() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("log.mcap");
        let mut log = TrialLog::create(&into(&path), &Camera::kinect(), BTreeMap::new()).expect("created");
        let robot = Pose::new(1.0, 2.0, 0.5);
        let world_from_optical = in_space(robot) * tower_link(&Camera::kinect()) * link_from_optical();
        let matrix = world_from_optical.to_homogeneous();
        let frame = RgbdFrame {
            width: 1,
            height: 1,
            color: vec![[7, 8, 9]],
            depth: vec![2345],
            depth_unit_m: 0.001,
            intrinsics: Intrinsics { fx: 525.0, fy: 525.0, cx: 0.0, cy: 0.0 },
            world_from_camera: std::array::from_fn(|row| std::array::from_fn(|column| matrix[(row, column)])),
        };
        log.pose(0.6, robot, (0.5, 0.0));
        log.frame(&TimedFrame::at(0.6, Some(robot), frame.clone()));
        log.pose(0.7, Pose::new(1.1, 2.0, 0.5), (0.5, 0.0));
        log.picture(0.7, frame.color_png());
        log.finish(0.7).expect("finished");
        let file = File::open(&path).expect("a log");
        let items: Vec<_> = FrameReader::new(file, "log", FrameOptions::default()).expect("a log").collect();
        let [Ok(read)] = items.as_slice() else { panic!("{items:?}") };
        assert_eq!((&read.frame.color, &read.frame.depth, read.stamp_ns), (&frame.color, &frame.depth, 600_000_000));
        let (got, want) = (read.frame.world_from_camera, frame.world_from_camera);
        let off = got.iter().flatten().zip(want.iter().flatten()).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f64::max) < 2e-9, "{got:?}");
    }

    #[test]
    fn the_same_trial_gives_the_same_bytes() {
        let folder = tempfile::tempdir().expect("a folder");
        let paths = ["a.mcap", "b.mcap"].map(|name| folder.path().join(name));
        let bytes = paths.map(|path| {
            write(&path);
            std::fs::read(path).expect("written")
        });
        assert_eq!(bytes[0], bytes[1]);
    }

    #[test]
    fn a_log_that_exists_is_not_overwritten() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("log.mcap");
        write(&path);
        let target = Target { force: false, ..into(&path) };
        let error = TrialLog::create(&target, &Camera::kinect(), BTreeMap::new()).err().expect("refused").to_string();
        assert!(error.contains("exists; name another file or give --force"), "{error}");
    }
}

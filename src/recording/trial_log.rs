//! The log of one trial, to be opened in Foxglove as it is.

use std::borrow::Cow;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;
use std::sync::Arc;

use foxglove::messages::{
    Color, CompressedImage, FrameTransform, LinePrimitive, Log, Point3, Pose as Pose3, PosesInFrame, Quaternion,
    SceneEntity, SceneUpdate, TextPrimitive, Timestamp, TriangleListPrimitive, Vector3,
};
use foxglove::{
    Channel, ChannelBuilder, Context, FoxgloveError, McapWriterHandle, PartialMetadata, RawChannel, Schema,
};

use crate::geometry::{Pose, Vec2};

/// The log is handed to the disk at least this often, seconds of the trial.
const FLUSH_S: f64 = 1.0;

/// A piece of furniture to be shown.
#[derive(Clone, Debug)]
pub struct Piece<'a> {
    /// Its name.
    pub label: String,
    /// Corners on the floor, counter-clockwise, metres.
    pub corners: &'a [Vec2],
    /// Metres.
    pub height: f64,
}

/// Writes one trial.
pub struct TrialLog {
    writer: McapWriterHandle<BufWriter<File>>,
    tf: Channel<FrameTransform>,
    scene: Channel<SceneUpdate>,
    truth: Channel<SceneUpdate>,
    path: Channel<PosesInFrame>,
    picture: Channel<CompressedImage>,
    log: Channel<Log>,
    record: Arc<RawChannel>,
    walked: Vec<Pose3>,
    flushed_s: f64,
    /// Channels live as long as their context.
    _context: Arc<Context>,
}

impl TrialLog {
    /// Begins a log at `path`; refuses a file that exists unless `force`.
    pub fn create(path: &Path, force: bool) -> Result<Self, String> {
        let named = |error: FoxgloveError| format!("{}: {error}", path.display());
        if force && path.is_file() {
            std::fs::remove_file(path).map_err(|error| format!("{}: {error}", path.display()))?;
        }
        if path.exists() {
            return Err(format!("{} exists; name another file or give --force", path.display()));
        }
        let context = Context::new();
        let writer = context.mcap_writer().create_new_buffered_file(path).map_err(named)?;
        let builder = |topic: &str| ChannelBuilder::new(topic).context(&context);
        let schema =
            Schema::new("spatial_fetch.Record", "jsonschema", Cow::Borrowed(br#"{"type":"object"}"#.as_slice()));
        Ok(Self {
            tf: builder("/tf").build(),
            scene: builder("/fetch/scene").build(),
            truth: builder("/fetch/scene_true").build(),
            path: builder("/fetch/path").build(),
            picture: builder("/camera/color/image").build(),
            log: builder("/fetch/log").build(),
            record: builder("/fetch/record").message_encoding("json").schema(schema).build_raw().map_err(named)?,
            writer,
            walked: Vec::new(),
            flushed_s: 0.0,
            _context: context,
        })
    }

    /// The robot is here: `map` → `odom` → `base_link`, odometry being exact.
    pub fn pose(&mut self, time_s: f64, pose: Pose) {
        let transform = |parent: &str, child: &str, pose: Pose| FrameTransform {
            timestamp: Some(stamp(time_s)),
            parent_frame_id: parent.to_string(),
            child_frame_id: child.to_string(),
            translation: Some(Vector3 { x: pose.x, y: pose.y, z: 0.0 }),
            rotation: Some(turned(pose.heading)),
        };
        self.tf.log_with_meta(&transform("map", "odom", Pose::default()), at(time_s));
        self.tf.log_with_meta(&transform("odom", "base_link", pose), at(time_s));
        self.walked.push(pose3(pose));
        if time_s - self.flushed_s >= FLUSH_S {
            self.flush(time_s);
        }
    }

    fn flush(&mut self, time_s: f64) {
        self.flushed_s = time_s;
        let poses =
            PosesInFrame { timestamp: Some(stamp(time_s)), frame_id: "map".to_string(), poses: self.walked.clone() };
        self.path.log_with_meta(&poses, at(time_s));
        // A full disk shows at the end, in `finish`.
        let _ = self.writer.flush();
    }

    /// A decision or an event.
    pub fn said(&mut self, time_s: f64, text: &str) {
        const INFO: i32 = 2;
        let name = "drive".to_string();
        let log =
            Log { timestamp: Some(stamp(time_s)), level: INFO, message: text.to_string(), name, ..Log::default() };
        self.log.log_with_meta(&log, at(time_s));
    }

    /// The walls of the room map.
    pub fn walls(&mut self, walls: &[(Vec2, Vec2)], height: f64) {
        let points = walls.iter().flat_map(|(a, b)| [point(*a, height / 2.0), point(*b, height / 2.0)]).collect();
        const LINE_LIST: i32 = 2;
        let line = LinePrimitive {
            r#type: LINE_LIST,
            pose: Some(pose3(Pose::default())),
            thickness: 0.05,
            points,
            color: Some(Color { r: 0.3, g: 0.3, b: 0.35, a: 1.0 }),
            ..LinePrimitive::default()
        };
        let entity = SceneEntity { lines: vec![line], ..entity("walls", 0.0) };
        self.scene.log_with_meta(&SceneUpdate { deletions: Vec::new(), entities: vec![entity] }, at(0.0));
    }

    /// What the robot believes of the furniture.
    pub fn believed(&mut self, time_s: f64, pieces: &[Piece]) {
        let color = Color { r: 0.2, g: 0.45, b: 0.8, a: 0.8 };
        self.scene.log_with_meta(&update("believed", time_s, pieces, color), at(time_s));
    }

    /// What is true of the furniture.
    pub fn truth(&mut self, pieces: &[Piece]) {
        let color = Color { r: 0.7, g: 0.6, b: 0.45, a: 0.4 };
        self.truth.log_with_meta(&update("true", 0.0, pieces, color), at(0.0));
    }

    /// What the camera shows, as PNG.
    pub fn picture(&mut self, time_s: f64, png: Vec<u8>) {
        let image = CompressedImage {
            timestamp: Some(stamp(time_s)),
            frame_id: "camera_optical_frame".to_string(),
            data: png.into(),
            format: "png".to_string(),
        };
        self.picture.log_with_meta(&image, at(time_s));
    }

    /// A record, byte for byte.
    pub fn record(&mut self, time_s: f64, line: &str) {
        self.record.log_with_meta(line.as_bytes(), at(time_s));
    }

    /// Ends the log.
    pub fn finish(mut self, time_s: f64) -> Result<(), String> {
        self.flush(time_s);
        self.writer.close().map(|_| ()).map_err(|error| format!("the log could not be finished: {error}"))
    }
}

fn stamp(time_s: f64) -> Timestamp {
    let nanoseconds = nanoseconds(time_s);
    Timestamp::new((nanoseconds / 1_000_000_000) as u32, (nanoseconds % 1_000_000_000) as u32)
}

fn at(time_s: f64) -> PartialMetadata {
    PartialMetadata::with_log_time(nanoseconds(time_s))
}

fn nanoseconds(time_s: f64) -> u64 {
    (time_s.max(0.0) * 1e9).round() as u64
}

fn turned(heading: f64) -> Quaternion {
    Quaternion { x: 0.0, y: 0.0, z: (heading / 2.0).sin(), w: (heading / 2.0).cos() }
}

fn pose3(pose: Pose) -> Pose3 {
    Pose3 { position: Some(Vector3 { x: pose.x, y: pose.y, z: 0.0 }), orientation: Some(turned(pose.heading)) }
}

fn point(p: Vec2, z: f64) -> Point3 {
    Point3 { x: p.x, y: p.y, z }
}

fn entity(id: &str, time_s: f64) -> SceneEntity {
    SceneEntity {
        timestamp: Some(stamp(time_s)),
        frame_id: "map".to_string(),
        id: id.to_string(),
        ..SceneEntity::default()
    }
}

fn update(layer: &str, time_s: f64, pieces: &[Piece], color: Color) -> SceneUpdate {
    let entities = pieces.iter().map(|piece| SceneEntity {
        triangles: vec![prism(piece, color)],
        texts: vec![label(piece)],
        ..entity(&format!("{layer}/{}", piece.label), time_s)
    });
    SceneUpdate { deletions: Vec::new(), entities: entities.collect() }
}

/// Top and sides of a prism as triangles.
fn prism(piece: &Piece, color: Color) -> TriangleListPrimitive {
    let corners = piece.corners;
    let mut points = Vec::new();
    for i in 0..corners.len() {
        let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
        let h = piece.height;
        points.extend([point(a, 0.0), point(b, 0.0), point(b, h), point(a, 0.0), point(b, h), point(a, h)]);
        if i + 1 < corners.len() && i > 0 {
            points.extend([point(corners[0], h), point(a, h), point(b, h)]);
        }
    }
    TriangleListPrimitive {
        pose: Some(pose3(Pose::default())),
        points,
        color: Some(color),
        ..TriangleListPrimitive::default()
    }
}

fn label(piece: &Piece) -> TextPrimitive {
    let sum = piece.corners.iter().fold(Vec2::zeros(), |sum, corner| sum + corner);
    let middle = sum / piece.corners.len().max(1) as f64;
    TextPrimitive {
        pose: Some(Pose3 {
            position: Some(Vector3 { x: middle.x, y: middle.y, z: piece.height + 0.1 }),
            orientation: Some(turned(0.0)),
        }),
        billboard: true,
        font_size: 0.15,
        color: Some(Color { r: 0.1, g: 0.1, b: 0.1, a: 1.0 }),
        text: piece.label.clone(),
        ..TextPrimitive::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::records;

    fn write(path: &Path) {
        let mut log = TrialLog::create(path, true).expect("created");
        log.walls(&[(Vec2::new(0.0, 0.0), Vec2::new(1.0, 0.0))], 2.5);
        log.pose(0.1, Pose::new(1.0, 2.0, 0.5));
        log.said(0.2, "begin enter");
        log.record(1.5, r#"{"id":"ä","x":1.0}"#);
        log.finish(1.5).expect("finished");
    }

    #[test]
    fn a_record_comes_back_byte_for_byte() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("log.mcap");
        write(&path);
        assert_eq!(records(&path).expect("readable"), [r#"{"id":"ä","x":1.0}"#]);
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
        let error = TrialLog::create(&path, false).err().expect("refused");
        assert!(error.contains("exists; name another file or give --force"), "{error}");
    }
}

//! RGB-D frames into a log, on a file or a pipe.

use std::io::Write;

use foxglove::messages::{CameraCalibration, FrameTransform, FrameTransforms, Quaternion, RawImage, Vector3};
use nalgebra::Isometry3;

use super::log_writer::LogWriter;
use super::mcap_sink::McapSink;
use super::sink::Sink;
use super::timed_frame::{in_space, optical_from_link};
use super::{LogError, TimedFrame, time};
use crate::frame::RgbdFrame;

/// Topics and frames, as robotics users expect them.
pub(super) const TF: &str = "/tf";
const COLOR: &str = "/camera/color/image_raw";
const DEPTH: &str = "/camera/depth/image_raw";
const INFO: &str = "/camera/color/camera_info";
const OPTICAL: &str = "camera_optical_frame";

/// Writes frames as a camera gives them; each is flushed, so that a reader at the other end of a pipe has it at once.
///
/// ```
/// use spatial_fetch::frame::{Intrinsics, RgbdFrame};
/// use spatial_fetch::recording::{FrameOptions, FrameReader, FrameWriter, TimedFrame};
///
/// let frame = RgbdFrame {
///     width: 1,
///     height: 1,
///     color: vec![[255, 0, 0]],
///     depth: vec![1500],
///     depth_unit_m: 0.001,
///     intrinsics: Intrinsics { fx: 525.0, fy: 525.0, cx: 0.0, cy: 0.0 },
///     world_from_camera: [[0.0, 0.0, 1.0, 0.0], [-1.0, 0.0, 0.0, 0.0], [0.0, -1.0, 0.0, 1.2], [0.0, 0.0, 0.0, 1.0]],
/// };
/// let mut log = Vec::new();
/// let mut writer = FrameWriter::new(&mut log)?;
/// writer.write(&TimedFrame::at(0.5, None, frame.clone()))?;
/// writer.finish()?;
/// let mut reader = FrameReader::new(log.as_slice(), "the log", FrameOptions::default())?;
/// let read = reader.next().expect("a frame").expect("undamaged");
/// assert_eq!(read.frame.depth, frame.depth);
/// # Ok::<(), spatial_fetch::recording::LogError>(())
/// ```
pub struct FrameWriter<W: Write> {
    log: LogWriter<McapSink<W>>,
}

impl<W: Write> FrameWriter<W> {
    /// Begins a log of frames, uncompressed.
    ///
    /// # Errors
    /// When the target takes no bytes.
    pub fn new(target: W) -> Result<Self, LogError> {
        Ok(Self { log: LogWriter::new(McapSink::new(target, None)?) })
    }

    /// Writes one frame and flushes it.
    ///
    /// # Errors
    /// When the target takes no more.
    pub fn write(&mut self, frame: &TimedFrame) -> Result<(), LogError> {
        self.log.message(TF, frame.log_ns, &camera_transforms(frame))?;
        write_pictures(&mut self.log, frame)?;
        self.log.flush()
    }

    /// Ends the log.
    ///
    /// # Errors
    /// When the target takes no more.
    pub fn finish(self) -> Result<W, LogError> {
        self.log.into_sink().finish()
    }
}

/// Camera, colour, then depth: with depth the frame is complete.
pub(super) fn write_pictures<S: Sink>(log: &mut LogWriter<S>, timed: &TimedFrame) -> Result<(), LogError> {
    let TimedFrame { stamp_ns, log_ns, frame, .. } = timed;
    log.message(INFO, *log_ns, &calibration(frame, *stamp_ns))?;
    if !frame.color.is_empty() {
        let data = frame.color.as_flattened().to_vec();
        log.message(COLOR, *log_ns, &image(frame, *stamp_ns, "rgb8", 3, data))?;
    }
    let depth = if (frame.depth_unit_m - 0.001).abs() < 1e-12 {
        let data = frame.depth.iter().flat_map(|value| value.to_le_bytes()).collect();
        image(frame, *stamp_ns, "16UC1", 2, data)
    } else {
        let metres = frame.depth.iter().map(|&value| (f64::from(value) * frame.depth_unit_m) as f32);
        image(frame, *stamp_ns, "32FC1", 4, metres.flat_map(f32::to_le_bytes).collect())
    };
    log.message(DEPTH, *log_ns, &depth)
}

fn image(frame: &RgbdFrame, stamp_ns: u64, encoding: &str, pixel_bytes: usize, data: Vec<u8>) -> RawImage {
    RawImage {
        timestamp: Some(time::timestamp(stamp_ns)),
        frame_id: OPTICAL.to_string(),
        width: frame.width as u32,
        height: frame.height as u32,
        encoding: encoding.to_string(),
        step: (frame.width * pixel_bytes) as u32,
        data: data.into(),
    }
}

fn calibration(frame: &RgbdFrame, stamp_ns: u64) -> CameraCalibration {
    let i = frame.intrinsics;
    CameraCalibration {
        timestamp: Some(time::timestamp(stamp_ns)),
        frame_id: OPTICAL.to_string(),
        width: frame.width as u32,
        height: frame.height as u32,
        distortion_model: "plumb_bob".to_string(),
        d: vec![0.0; 5],
        k: vec![i.fx, 0.0, i.cx, 0.0, i.fy, i.cy, 0.0, 0.0, 1.0],
        r: vec![1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        p: vec![i.fx, 0.0, i.cx, 0.0, 0.0, i.fy, i.cy, 0.0, 0.0, 0.0, 1.0, 0.0],
    }
}

/// From the map to the camera, by way of the robot where it is known.
pub(super) fn camera_transforms(timed: &TimedFrame) -> FrameTransforms {
    let world_from_link = timed.world_from_optical() * optical_from_link();
    let link = |parent: &str, child: &str, pose| transform(timed.stamp_ns, parent, child, pose);
    let mut transforms = match timed.robot {
        None => vec![link("map", "camera_link", world_from_link)],
        Some(robot) => vec![
            link("map", "odom", Isometry3::identity()),
            link("odom", "base_link", in_space(robot)),
            link("base_link", "camera_link", in_space(robot).inverse() * world_from_link),
        ],
    };
    transforms.push(link_to_optical(timed.stamp_ns));
    FrameTransforms { transforms }
}

/// From a camera's body to its optical frame.
pub(super) fn link_to_optical(stamp_ns: u64) -> FrameTransform {
    transform(stamp_ns, "camera_link", OPTICAL, optical_from_link().inverse())
}

pub(super) fn transform(stamp_ns: u64, parent: &str, child: &str, pose: Isometry3<f64>) -> FrameTransform {
    let (t, q) = (pose.translation, pose.rotation);
    FrameTransform {
        timestamp: Some(time::timestamp(stamp_ns)),
        parent_frame_id: parent.to_string(),
        child_frame_id: child.to_string(),
        translation: Some(Vector3 { x: t.x, y: t.y, z: t.z }),
        rotation: Some(Quaternion { x: q.i, y: q.j, z: q.k, w: q.w }),
    }
}

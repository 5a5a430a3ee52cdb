//! `perceive` as a stage: records that name frames in, detections out.

use std::path::PathBuf;

use super::frame_files::check;
use super::{Detector, FrameFiles};
use crate::frame::RgbdFrame;
use crate::record::{Detection, Note, Record, Stage, StageError};

/// Finds furniture in the depth pictures that records name.
#[derive(Clone, Debug, Default)]
pub struct Perceiver {
    /// Where relative paths begin.
    pub folder: PathBuf,
    /// What finds it.
    pub detector: Detector,
}

impl Perceiver {
    /// Adds what a frame shows to its record.
    pub fn see(&self, frame: &RgbdFrame, record: &mut Record) -> Result<Note, StageError> {
        check(frame).map_err(|error| StageError::new(error.to_string()))?;
        let view = self.detector.detect(frame, None);
        let detections: Vec<Detection> = view.furniture.into_iter().map(rounded).collect();
        record.set("detections", &detections);
        Ok(Note::Done)
    }
}

/// Detections are written to a tenth of a millimetre.
fn rounded(mut detection: Detection) -> Detection {
    let four = |v: f64| crate::record::Rounded(v).value();
    for value in
        [&mut detection.x, &mut detection.y, &mut detection.length, &mut detection.width, &mut detection.height]
    {
        *value = four(*value);
    }
    detection.yaw = detection.yaw.map(four);
    detection.footprint.iter_mut().flatten().for_each(|value| *value = four(*value));
    detection
}

impl Stage for Perceiver {
    fn run(&self, record: &mut Record) -> Result<Note, StageError> {
        let line = serde_json::to_string(record).map_err(|error| StageError::new(error.to_string()))?;
        let frame: FrameFiles = serde_json::from_str(&line).map_err(|error| {
            let what = crate::record::message_without_position(&error);
            StageError::new(format!("{what}; a frame needs depth, fx, fy, cx, cy, depth_unit_m and T_world_cam"))
        })?;
        let frame = frame.load(&self.folder).map_err(|error| StageError::new(error.to_string()))?;
        self.see(&frame, record)
    }

    fn text(&self, record: &Record) -> Result<String, StageError> {
        let detections: Vec<Detection> = record.require("detections", "it is what `perceive` adds")?;
        let mut lines: Vec<String> = record.get::<String>("frame")?.into_iter().collect();
        lines.extend(detections.iter().map(|d| format!("  {:12} at ({:.2}, {:.2}): {}", d.category, d.x, d.y, d.why)));
        Ok(lines.join("\n"))
    }
}

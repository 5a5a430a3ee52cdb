//! `perceive` as a stage: records that name frames in, detections out.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::Serialize;

use super::external::ExternalDetector;
use super::{Detector, FrameFiles, View, check, overlay};
use crate::escape::for_file_name;
use crate::files::{Claims, write_file};
use crate::frame::RgbdFrame;
use crate::map::RoomMap;
use crate::record::{Detection, Note, Record, Stage, StageError};

/// Finds furniture in frames, from files or from anywhere else.
#[derive(Clone, Debug, Default)]
pub struct Perceiver {
    /// Where relative paths begin.
    pub folder: PathBuf,
    /// What finds furniture.
    pub detector: Detector,
    /// A command that finds it instead.
    pub external: Option<Arc<ExternalDetector>>,
    /// The rooms, when they are known.
    pub map: Option<RoomMap>,
    /// Where to draw what was found.
    pub overlay: Option<PathBuf>,
    /// Whether drawings may replace older ones.
    pub force: bool,
    /// Which drawings belong to which frame of this run.
    pub claims: Claims,
}

impl Perceiver {
    /// What a frame shows, from whatever source it comes; `name` is that of its drawing.
    pub fn look(&self, name: &str, frame: &RgbdFrame) -> Result<View, StageError> {
        check(frame).map_err(|error| StageError::new(error.to_string()))?;
        let view = match &self.external {
            None => self.detector.detect(frame, self.map.as_ref()),
            Some(external) => external_view(external, frame)?,
        };
        self.draw(name, frame, &view)?;
        Ok(view)
    }

    /// Adds what a frame from a log shows to its record.
    pub fn see(&self, frame: &RgbdFrame, record: &mut Record) -> Result<Note, StageError> {
        let name = record.get::<String>("frame")?.or_else(|| record.id());
        self.add(name.as_deref().unwrap_or("frame"), frame, record)
    }

    fn add(&self, name: &str, frame: &RgbdFrame, record: &mut Record) -> Result<Note, StageError> {
        let view = self.look(name, frame)?;
        record.put(&view.furniture);
        Ok(Note::Done)
    }

    fn draw(&self, name: &str, frame: &RgbdFrame, view: &View) -> Result<(), StageError> {
        let Some(folder) = &self.overlay else { return Ok(()) };
        let written =
            std::fs::create_dir_all(folder).map_err(|error| StageError::new(format!("{}: {error}", folder.display())));
        written?;
        let path = folder.join(format!("{}.png", for_file_name(name)));
        self.claims.claim(&path, name).map_err(|error| StageError::new(error.to_string()))?;
        write_file(&path, &overlay(frame, view), self.force).map_err(|error| StageError::new(error.to_string()))
    }

    /// The frame a record names.
    pub fn frame_of(&self, record: &Record) -> Result<(String, RgbdFrame), StageError> {
        let line = serde_json::to_string(record).map_err(|error| StageError::new(error.to_string()))?;
        let files: FrameFiles = serde_json::from_str(&line).map_err(|error| {
            let what = crate::record::message_without_position(&error);
            StageError::new(format!("{what}; a frame needs depth, fx, fy, cx, cy and depth_unit_m"))
        })?;
        let frame = files.load(&self.folder).map_err(|error| StageError::new(error.to_string()))?;
        Ok((files.frame.unwrap_or_else(|| stem(&files.depth)), frame))
    }
}

fn stem(path: &Path) -> String {
    path.file_stem().map_or_else(|| "frame".to_string(), |stem| stem.to_string_lossy().to_string())
}

/// Frames may come from a recording, so the pictures are always handed over as files of their own.
fn external_view(external: &ExternalDetector, frame: &RgbdFrame) -> Result<View, StageError> {
    let furniture = external.detect(|number| handed(external.pictures(), frame, number));
    let furniture = furniture.map_err(|error| StageError::new(error.to_string()))?;
    Ok(View { furniture, objects: Vec::new() })
}

/// A frame as a detector reads it.
#[derive(Serialize)]
struct Handed {
    /// To be repeated in the answer.
    number: u64,
    #[serde(flatten)]
    files: FrameFiles,
}

/// The line that hands over a frame; its pictures take the place of those of the frame before.
fn handed(folder: &Path, frame: &RgbdFrame, number: u64) -> Result<String, String> {
    let (rgb, depth) = (folder.join("rgb.png"), folder.join("depth.png"));
    let mut files = FrameFiles::of(frame, rgb.clone(), depth.clone());
    if frame.color.is_empty() {
        files.rgb = None;
    } else {
        write_file(&rgb, &frame.color_png(), true).map_err(|error| error.to_string())?;
    }
    write_file(&depth, &frame.depth_png(), true).map_err(|error| error.to_string())?;
    serde_json::to_string(&Handed { number, files }).map_err(|error| error.to_string())
}

impl Stage for Perceiver {
    fn run(&self, record: &mut Record) -> Result<Note, StageError> {
        let (name, frame) = self.frame_of(record)?;
        self.add(&name, &frame, record)
    }

    fn text(&self, record: &Record) -> Result<String, StageError> {
        let detections: Vec<Detection> = record.require_part("it is what `perceive` adds")?;
        let mut lines: Vec<String> = record.get::<String>("frame")?.into_iter().collect();
        lines.extend(detections.iter().map(text_line));
        Ok(lines.join("\n"))
    }
}

/// One piece on a line, for people.
pub fn text_line(d: &Detection) -> String {
    format!("  {:12} {:3.0} % at ({:.2}, {:.2}): {}", d.category, 100.0 * d.confidence, d.x, d.y, d.why)
}

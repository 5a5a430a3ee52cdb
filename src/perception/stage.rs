//! `perceive` as a stage: records that name frames in, detections out.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::answer::Answer;
use super::external::ExternalDetector;
use super::network::joined;
use super::{Detector, FrameFiles, ObjectSighting, Told, View, check, furniture_chance, overlay};
use crate::escape::for_file_name;
use crate::files::{Claims, write_file};
use crate::frame::RgbdFrame;
use crate::map::RoomMap;
use crate::record::{CameraPose, Detection, Note, PoseSource, Record, Rounded, Stage, StageError};

/// Finds furniture in frames, from files or from anywhere else.
#[derive(Clone, Debug, Default)]
pub struct Perceiver {
    /// Where relative paths begin.
    pub folder: PathBuf,
    /// What finds furniture.
    pub detector: Detector,
    /// A command that finds it too.
    pub external: Option<Arc<ExternalDetector>>,
    /// Whether it finds it instead.
    pub external_only: bool,
    /// The rooms, when they are known.
    pub map: Option<RoomMap>,
    /// What is known of the camera of frames that do not tell where it was.
    pub told: Told,
    /// What is less surely furniture than this is left out.
    pub least_confidence: f64,
    /// Where to draw what was found.
    pub overlay: Option<PathBuf>,
    /// Whether drawings may replace older ones.
    pub force: bool,
    /// Which drawings belong to which frame of this run.
    pub claims: Claims,
}

impl Perceiver {
    /// What a frame shows, from whatever source it comes; `name` is that of its drawing, `from` says how its pose is known.
    ///
    /// # Errors
    /// When the frame's numbers cannot be, a detector of one's own fails, or the drawing cannot be written.
    pub fn look(&self, name: &str, frame: &RgbdFrame, from: PoseSource, record: &Record) -> Result<View, StageError> {
        check(frame).map_err(|error| StageError::new(error.to_string()))?;
        let view = match &self.external {
            None => self.detector.detect(frame, self.map.as_ref()),
            Some(external) => self.joined(external, frame, record)?,
        };
        let sure = View { furniture: self.sure(view.furniture.clone()), ..view.clone() };
        self.draw(name, frame, &sure, from)?;
        Ok(view)
    }

    /// Without what is less surely furniture than is asked for.
    pub fn sure(&self, furniture: Vec<Detection>) -> Vec<Detection> {
        furniture.into_iter().filter(|piece| is_surely(piece, self.least_confidence)).collect()
    }

    /// Adds what a frame from a log shows to its record; `from` says how its pose is known.
    ///
    /// # Errors
    /// As for looking.
    pub fn see(&self, frame: &RgbdFrame, from: PoseSource, record: &mut Record) -> Result<Note, StageError> {
        let name = record.get::<String>("frame")?.or_else(|| record.id());
        self.add(name.as_deref().unwrap_or("frame"), frame, from, record)
    }

    /// What the forests and the command find together.
    fn joined(&self, external: &ExternalDetector, frame: &RgbdFrame, record: &Record) -> Result<View, StageError> {
        let answer = ask(external, frame, record)?;
        let map = self.map.as_ref();
        let own = if self.external_only { View::default() } else { self.detector.detect(frame, map) };
        Ok(View { furniture: joined(&self.detector, (frame, map), answer, own.furniture), ..own })
    }

    fn add(&self, name: &str, frame: &RgbdFrame, from: PoseSource, record: &mut Record) -> Result<Note, StageError> {
        let view = self.look(name, frame, from, record)?;
        record.put(&CameraPose::new(frame.world_from_camera, from));
        record.put(&self.sure(view.furniture));
        record.put(&view.objects.into_iter().map(rounded).collect::<Vec<_>>());
        Ok(Note::Done)
    }

    fn draw(&self, name: &str, frame: &RgbdFrame, view: &View, from: PoseSource) -> Result<(), StageError> {
        let Some(folder) = &self.overlay else { return Ok(()) };
        let written =
            std::fs::create_dir_all(folder).map_err(|error| StageError::new(format!("{}: {error}", folder.display())));
        written?;
        let path = folder.join(format!("{}.png", for_file_name(name)));
        self.claims.claim(&path, name).map_err(|error| StageError::new(error.to_string()))?;
        write_file(&path, &overlay(frame, view, &caption(frame, from)), self.force)
            .map_err(|error| StageError::new(error.to_string()))
    }

    /// The frame a record names.
    ///
    /// # Errors
    /// When the record names no frame, or its files are wrong, with the key.
    pub fn frame_of(&self, record: &Record) -> Result<(String, RgbdFrame, PoseSource), StageError> {
        let line = serde_json::to_string(record).map_err(|error| StageError::new(error.to_string()))?;
        let files: FrameFiles = serde_json::from_str(&line).map_err(|error| {
            let what = crate::record::message_without_position(&error);
            StageError::new(format!("{what}; a frame needs depth, fx, fy, cx, cy and depth_unit_m"))
        })?;
        let (frame, from) = files.load(&self.folder, self.told).map_err(|error| StageError::new(error.to_string()))?;
        Ok((files.frame.unwrap_or_else(|| stem(&files.depth)), frame, from))
    }
}

/// Whether it is at least so surely furniture; where no scores tell, its confidence has to.
fn is_surely(piece: &Detection, least: f64) -> bool {
    let chance = if piece.scores.is_empty() { piece.confidence } else { furniture_chance(piece) };
    chance >= least
}

fn rounded(object: ObjectSighting) -> ObjectSighting {
    let [x, y] = [object.x, object.y].map(|value| Rounded(value).value());
    ObjectSighting { x, y, ..object }
}

fn stem(path: &Path) -> String {
    path.file_stem().map_or_else(|| "frame".to_string(), |stem| stem.to_string_lossy().to_string())
}

/// Asks the command: the frame's own record, with the camera that was found.
///
/// Frames may come from a recording, so the pictures are always handed over as files of their own.
fn ask(external: &ExternalDetector, frame: &RgbdFrame, record: &Record) -> Result<Answer, StageError> {
    let answer = external.detect(|number| handed(external.pictures(), frame, record, number));
    answer.map_err(|error| StageError::new(error.to_string()))
}

/// The line that hands over a frame under a number, to be repeated in the answer; its pictures take the place of those
/// of the frame before.
fn handed(folder: &Path, frame: &RgbdFrame, record: &Record, number: u64) -> Result<String, String> {
    let failed = |error: &dyn std::fmt::Display| error.to_string();
    let (rgb, depth) = (folder.join("rgb.png"), folder.join("depth.png"));
    write_file(&depth, &frame.depth_png(), true).map_err(|error| failed(&error))?;
    let has_color = !frame.color.is_empty();
    if has_color {
        write_file(&rgb, &frame.color_png(), true).map_err(|error| failed(&error))?;
    }
    let handed = FrameFiles { rgb: has_color.then_some(rgb), ..FrameFiles::of(frame, depth.clone(), depth) };
    let handed = serde_json::to_value(&handed).map_err(|error| failed(&error))?;
    // What the frame's line says of its pictures is of other files; everything else it says is handed on.
    let mut line = record.without(&["rgb", "depth", "mask", "camera_height", "camera_tilt"]);
    line.set("number", &number);
    handed.as_object().into_iter().flatten().for_each(|(key, value)| line.set(key, value));
    serde_json::to_string(&line).map_err(|error| failed(&error))
}

impl Stage for Perceiver {
    fn run(&self, record: &mut Record) -> Result<Note, StageError> {
        let (name, frame, from) = self.frame_of(record)?;
        self.add(&name, &frame, from, record)
    }

    fn text(&self, record: &Record) -> Result<String, StageError> {
        let detections: Vec<Detection> = record.require_part("it is what `perceive` adds")?;
        let objects: Vec<ObjectSighting> = record.part()?.unwrap_or_default();
        let frame = record.get::<String>("frame")?.or_else(|| record.id()).unwrap_or_default();
        let small = |o: &ObjectSighting| {
            let name = if o.recognisable { o.name.clone() } else { format!("{}?", o.name) };
            format!("  {name:12} a small thing at ({:.2}, {:.2})", o.x, o.y)
        };
        let mut lines: Vec<String> = detections.iter().map(text_line).chain(objects.iter().map(small)).collect();
        if lines.is_empty() {
            lines.push("  nothing".to_string());
        }
        Ok(lines.into_iter().map(|line| format!("{frame}{line}")).collect::<Vec<_>>().join("\n"))
    }
}

/// Where the camera was, for people.
fn caption(frame: &RgbdFrame, from: PoseSource) -> String {
    let CameraPose { height, tilt, roll, .. } = CameraPose::new(frame.world_from_camera, from);
    let known = match from {
        PoseSource::Record => "as the record says",
        PoseSource::Transforms => "by the log's transforms",
        PoseSource::AssumedMount => "as usual on a robot",
        PoseSource::Floor => "by the floor",
        PoseSource::Gravity => "by the height told and what is upright",
        PoseSource::Told => "as told",
    };
    format!("camera {height:.2} m up, {tilt:.0} deg down, roll {roll:.0} deg, {known}")
}

/// One piece on a line, for people.
pub fn text_line(d: &Detection) -> String {
    format!("  {:12} {:3.0} % at ({:.2}, {:.2}): {}", d.category, 100.0 * d.confidence, d.x, d.y, d.why)
}

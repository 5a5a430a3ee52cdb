//! A watcher that writes the log of a trial.

use serde::Serialize;

use super::error::LogError;
use super::outputs::{Outputs, TruePiece};
use super::pace::Pace;
use super::shapes::ShownPiece;
use super::timed_frame::TimedFrame;
use super::trial_log::TrialLog;
use super::trial_sinks::Target;
use crate::behavior::{Furniture, Watcher, grid_of};
use crate::frame::{Camera, RgbdFrame};
use crate::geometry::{ClearanceGrid, Pose};
use crate::map::RoomMap;
use crate::perception::View;
use crate::record::{Chunk, Detection, Grounding, Part, Plan, Record, Token, Trial};
use crate::robot::{MobileBase, SonarReading};

/// The keys the stages add, in their order, under the stage's name.
const STAGES: [(&str, &[&str]); 4] = [
    ("chunk", &[Vec::<Token>::KEY, Vec::<Chunk>::KEY]),
    ("ground", &[Grounding::KEY]),
    ("plan", &[Plan::KEY]),
    ("drive", &[Trial::KEY]),
];

/// A look, as `perceive` tells it of a frame.
#[derive(Serialize)]
struct Seen<'v> {
    detections: &'v [Detection],
}

/// Where a log says with which options its trial was run.
pub const OPTIONS_TOPIC: &str = "/fetch/options";

/// What a log begins with.
pub struct About<'a> {
    /// The rooms.
    pub map: &'a RoomMap,
    /// What truly stands in them, where that is known.
    pub truth: &'a [TruePiece],
    /// The robot's camera.
    pub camera: Camera,
    /// Seed of everything random.
    pub seed: u64,
    /// How the trial is run, in words.
    pub settings: String,
    /// The record as each stage before wrote it.
    pub record: &'a Record<'a>,
}

/// Writes what the executive does, as it happens.
pub struct Recorder {
    log: TrialLog,
    pace: Option<Pace>,
}

impl Recorder {
    /// Begins the log of a trial of `about.record`; nothing where nobody wants a log.
    ///
    /// # Errors
    /// When the log cannot be written, or stands there already and nothing forces.
    pub fn begin(outputs: &Outputs, id: &str, about: &About) -> Result<Option<Self>, LogError> {
        let file = outputs.record.as_deref().map(|path| Outputs::named(path, id));
        let target = Target { file: file.as_deref(), force: outputs.force, live: outputs.live.as_deref() };
        if target.file.is_none() && target.live.is_none() {
            return Ok(None);
        }
        let said = [
            ("version", env!("CARGO_PKG_VERSION").to_string()),
            ("map", about.map.name.clone()),
            ("seed", about.seed.to_string()),
            ("settings", about.settings.clone()),
        ];
        let said = said.into_iter().map(|(name, value)| (name.to_string(), value)).collect();
        let mut log = TrialLog::create(&target, &about.camera, said)?;
        for (stage, line) in inputs(about.record) {
            log.record(0.0, stage, &line);
        }
        log.walls(&about.map.walls(), about.map.wall_height);
        log.grid(0.0, &grid_of(about.map));
        let pieces = about.truth.iter().map(|piece| ShownPiece {
            label: piece.id.clone(),
            corners: &piece.corners,
            height: piece.height,
        });
        log.truth(&pieces.collect::<Vec<_>>());
        Ok(Some(Self { log, pace: None }))
    }

    /// Holds the trial back to `times` the time of day from now on.
    pub fn keep_pace(&mut self, times: f64) {
        self.pace = Some(Pace::new(times));
    }

    /// Whether the log can no longer be written.
    pub fn has_failed(&self) -> bool {
        self.log.has_failed()
    }

    /// How the trial is run, as options of the command line, for a replay.
    pub fn options(&mut self, line: &str) {
        if !line.is_empty() {
            self.log.options(OPTIONS_TOPIC, line);
        }
    }

    /// Ends the log with the last picture and the record as `drive` writes it.
    ///
    /// # Errors
    /// When anything could not be written on the way.
    pub fn finish(mut self, duration_s: f64, picture: Vec<u8>, record: &str) -> Result<(), LogError> {
        let end = duration_s;
        self.log.picture(end, picture);
        self.log.record(end, "drive", record);
        self.log.finish(end)
    }
}

/// The record as the pipeline was given it, and as each stage wrote it, the input of `drive` byte for byte.
fn inputs(record: &Record) -> Vec<(&'static str, String)> {
    let added = |from: usize| STAGES[from..].iter().flat_map(|(_, keys)| keys.iter().copied()).collect::<Vec<_>>();
    let mut lines = Vec::new();
    for (i, stage) in ["input", "chunk", "ground"].into_iter().enumerate() {
        // A record's keys are strings, so it serializes.
        let line = serde_json::to_string(&record.without(&added(i))).unwrap_or_default();
        if i == 0 || STAGES[i - 1].1.iter().all(|key| record.raw(key).is_some()) {
            lines.push((stage, line));
        }
    }
    let line = record.line().trim();
    let own = || serde_json::to_string(record).unwrap_or_default();
    lines.push(("plan", if line.is_empty() { own() } else { line.to_string() }));
    lines
}

impl Watcher for Recorder {
    fn sensed(&mut self, base: &dyn MobileBase) {
        self.log.pose(base.time_s(), base.pose(), base.velocity());
        let heard = base.sonar().iter().filter(|reading| reading.range_m < base.body().sonar_range_m);
        let echoes: Vec<_> = heard.map(SonarReading::echo).collect();
        self.log.sonar(base.time_s(), &echoes);
        if let Some(pace) = &self.pace {
            pace.wait(base.time_s());
        }
    }

    fn frame(&mut self, time_s: f64, believed: Pose, frame: &RgbdFrame) {
        self.log.frame(&TimedFrame::at(time_s, Some(believed), frame.clone()));
    }

    fn seen(&mut self, time_s: f64, view: &View) {
        let seen = Seen { detections: &view.furniture };
        // Our own records always serialize.
        self.log.seen(time_s, &serde_json::to_string(&seen).unwrap_or_default());
    }

    fn grid(&mut self, time_s: f64, grid: &ClearanceGrid) {
        self.log.grid(time_s, grid);
    }

    fn said(&mut self, time_s: f64, text: &str) {
        self.log.said(time_s, text);
    }

    fn furniture(&mut self, time_s: f64, furniture: &[Furniture]) {
        let pieces: Vec<ShownPiece> = furniture
            .iter()
            .map(|f| ShownPiece { label: f.label(), corners: f.footprint().corners(), height: f.detection().height })
            .collect();
        self.log.believed(time_s, &pieces);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_stage_finds_its_input_as_it_was() {
        let line = r#"{"id":"1","text":"x","mine":1.0,"tokens":[],"chunks":[],"grounding":{},"plan":{}}"#;
        let record = Record::parse(line).expect("valid JSON");
        let lines = inputs(&record);
        assert_eq!(lines[0], ("input", r#"{"id":"1","text":"x","mine":1.0}"#.to_string()));
        assert_eq!(lines[1].1, r#"{"id":"1","text":"x","mine":1.0,"tokens":[],"chunks":[]}"#);
        assert_eq!(lines[3], ("plan", line.to_string()));
    }

    #[test]
    fn a_stage_that_was_left_out_has_no_message() {
        let record = Record::parse(r#"{"id":"1","plan":{}}"#).expect("valid JSON");
        let stages: Vec<_> = inputs(&record).into_iter().map(|(stage, _)| stage).collect();
        assert_eq!(stages, ["input", "plan"]);
    }
}

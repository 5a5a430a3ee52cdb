//! `drive` as a stage of the pipeline.

use super::missing::missing;
use super::{Home, TrialSettings, run, stream_of};
use crate::behavior::{Run, Several, Watcher, note_of, plan_of, row_of, shade_of, text_of};
use crate::frame::RgbdFrame;
use crate::record::{Note, Plan, Record, Row, Shade, Stage, StageError};
use crate::recording::{About, Outputs, Recorder, Told};

/// Runs the plan of each record in a home.
#[derive(Clone, Debug)]
pub struct Driver {
    /// Where.
    pub home: Home,
    /// How.
    pub settings: TrialSettings,
    /// What to leave beside the record.
    pub outputs: Outputs,
    /// Whether what the home does not have is looked for all the same.
    pub search_anyway: bool,
}

impl Driver {
    fn drive(&self, record: &mut Record, plan: &Plan, id: &str) -> Result<Note, StageError> {
        let failed = |error: &dyn std::fmt::Display| StageError::new(error.to_string());
        let name = record.file_name();
        self.outputs.prepare(&name, id).map_err(|error| failed(&error))?;
        let truth = self.home.pieces();
        let about = About {
            map: &self.home.map,
            truth: &truth,
            camera: self.home.camera(),
            seed: self.settings.seed,
            settings: format!("{:?}", self.settings),
            record,
        };
        let mut recorder = Recorder::begin(&self.outputs, &name, &about).map_err(|error| failed(&error))?;
        if let Some(recorder) = &mut recorder {
            recorder.options(&self.outputs.options);
            self.outputs.pace.into_iter().for_each(|times| recorder.keep_pace(times));
        }
        let (mut narrator, mut story) = (self.outputs.narrator(id, record), self.outputs.story());
        let mut audience = Several::default();
        recorder.iter_mut().for_each(|recorder| audience.0.push(recorder));
        narrator.iter_mut().for_each(|narrator| audience.0.push(narrator));
        story.iter_mut().for_each(|story| audience.0.push(story));
        let mut run = self.run_plan(plan, id, &mut audience);
        drop(audience);
        narrator.iter().for_each(|narrator| narrator.end(&run.trial));
        let wants_picture = recorder.is_some() || story.is_some() || self.outputs.picture.is_some();
        let picture = wants_picture.then(|| self.home.take_picture(run.final_pose));
        let png = picture.as_ref().map(RgbdFrame::color_png);
        let mut lost = self.outputs.leave((&self.home.map, &truth), &mut run, png.as_deref(), record, &name);
        record.put(&run.trial);
        let line = || serde_json::to_string(record).map_err(|error| failed(&error));
        if let Some(story) = story {
            let thumbnail = picture.as_ref().map(RgbdFrame::thumbnail_png);
            self.outputs.tell(Told { line: line()?, run: run.clone(), picture: thumbnail, story });
        }
        if let (Some(recorder), Some(png)) = (recorder, png) {
            let written = recorder.finish(run.trial.duration_s.0, png, &line()?);
            lost.extend(written.err().map(|error| error.to_string()));
        }
        Ok(note_of(&run.trial).and(lost))
    }

    /// Runs a plan, unless the home does not have what it looks for.
    fn run_plan(&self, plan: &Plan, id: &str, audience: &mut dyn Watcher) -> Run {
        let nowhere = if self.search_anyway { None } else { missing(&self.home, plan) };
        nowhere.unwrap_or_else(|| run(&self.home, plan, &self.settings, stream_of(id), audience))
    }
}

impl Stage for Driver {
    fn run(&self, record: &mut Record) -> Result<Note, StageError> {
        let plan = plan_of(record, &self.home.map)?;
        let id = record.id().unwrap_or_else(|| "record".to_string());
        self.drive(record, &plan, &id)
    }

    fn text(&self, record: &Record) -> Result<String, StageError> {
        text_of(record)
    }

    fn shade(&self, line: &str) -> Shade {
        shade_of(line)
    }

    fn row(&self, record: &Record) -> Option<Result<Row, StageError>> {
        Some(row_of(record))
    }

    fn has_rows(&self) -> bool {
        true
    }

    fn narrates(&self) -> bool {
        true
    }
}

//! `drive` as a stage of the pipeline.

use super::{Home, Settings, run, stream_of};
use crate::behavior::{Silent, Watcher, plan_of, text_of};
use crate::record::{Note, Plan, Record, Stage, StageError};
use crate::recording::{About, LogError, Outputs, Recorder};

/// Runs the plan of each record in a home.
#[derive(Clone, Debug)]
pub struct Driver {
    /// Where.
    pub home: Home,
    /// How.
    pub settings: Settings,
    /// What to leave beside the record.
    pub outputs: Outputs,
}

impl Driver {
    fn drive(&self, record: &mut Record, plan: &Plan, id: &str) -> Result<(), StageError> {
        let failed = |error: LogError| StageError::new(error.to_string());
        let truth = self.home.pieces();
        let about = About {
            map: &self.home.map,
            truth: &truth,
            camera: self.home.camera(),
            seed: self.settings.seed,
            settings: format!("{:?}", self.settings),
            record,
        };
        let mut recorder = Recorder::begin(&self.outputs, id, &about).map_err(failed)?;
        if let Some(recorder) = &mut recorder {
            recorder.options(&self.outputs.options);
            self.outputs.pace.into_iter().for_each(|times| recorder.keep_pace(times));
        }
        let watcher: &mut dyn Watcher = match &mut recorder {
            Some(recorder) => recorder,
            None => &mut Silent,
        };
        let mut run = run(&self.home, plan, &self.settings, stream_of(id), watcher);
        let wants_picture = recorder.is_some() || self.outputs.picture.is_some();
        let picture = wants_picture.then(|| self.home.take_picture(run.final_pose).color_png());
        self.outputs.leave((&self.home.map, &truth), &mut run, picture.as_deref(), record, id)?;
        record.put(&run.trial);
        let (Some(recorder), Some(picture)) = (recorder, picture) else { return Ok(()) };
        let line = serde_json::to_string(record).map_err(|error| StageError::new(error.to_string()))?;
        recorder.finish(run.trial.duration_s.0, picture, &line).map_err(failed)
    }
}

impl Stage for Driver {
    fn run(&self, record: &mut Record) -> Result<Note, StageError> {
        let plan = plan_of(record, &self.home.map)?;
        let id = record.id().unwrap_or_else(|| "record".to_string());
        self.drive(record, &plan, &id)?;
        Ok(Note::Done)
    }

    fn text(&self, record: &Record) -> Result<String, StageError> {
        text_of(record)
    }
}

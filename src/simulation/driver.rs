//! `drive` as a stage of the pipeline.

use super::{Home, Settings, run, stream_of};
use crate::behavior::{Silent, Watcher, plan_of, text_of};
use crate::record::{Note, Plan, Record, Stage, StageError};
use crate::recording::{About, Outputs, Recorder};

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
        let watcher: &mut dyn Watcher = match &mut recorder {
            Some(recorder) => recorder,
            None => &mut Silent,
        };
        let mut run = run(&self.home, plan, &self.settings, stream_of(id), watcher);
        let wants_picture = recorder.is_some() || self.outputs.picture.is_some();
        let picture = wants_picture.then(|| self.home.take_picture(run.final_pose).color_png());
        let mut lost = self.outputs.leave((&self.home.map, &truth), &mut run, picture.as_deref(), record, &name);
        record.put(&run.trial);
        if let (Some(recorder), Some(picture)) = (recorder, picture) {
            let line = serde_json::to_string(record).map_err(|error| failed(&error))?;
            lost.extend(recorder.finish(run.trial.duration_s.0, picture, &line).err().map(|error| error.to_string()));
        }
        Ok(Note::of(&lost))
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
}

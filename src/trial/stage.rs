//! `drive` as a stage of the pipeline.

use super::outputs::{Outputs, file_name};
use super::recorder::Recorder;
use super::{Home, Run, Settings, run, stream_of};
use crate::behavior::{Silent, Watcher};
use crate::files::{FileError, write_file};
use crate::record::{Note, Plan, Record, Stage, StageError, Trial};
use crate::recording::LogError;

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
        let mut recorder = Recorder::begin(&self.outputs, id, &self.home, &self.settings, record).map_err(failed)?;
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
        let picture = wants_picture.then(|| Outputs::take_picture(&self.home, &run).color_png());
        self.leave(&mut run, picture.as_deref(), record, id)?;
        record.set("trial", &run.trial);
        let (Some(recorder), Some(picture)) = (recorder, picture) else { return Ok(()) };
        let line = serde_json::to_string(record).map_err(|error| StageError::new(error.to_string()))?;
        recorder.finish(&run, picture, &line).map_err(failed)
    }

    /// Writes the plot and the picture, where they are wanted.
    fn leave(&self, run: &mut Run, png: Option<&[u8]>, record: &Record, id: &str) -> Result<(), StageError> {
        let failed = |error: FileError| StageError::new(error.to_string());
        if let Some(path) = &self.outputs.plot {
            let title: String = record.get("text")?.unwrap_or_default();
            let svg = Outputs::draw_plot(&self.home, run, &title);
            write_file(&Outputs::named(path, id), svg.as_bytes(), self.outputs.force).map_err(failed)?;
        }
        if let (Some(folder), Some(png)) = (&self.outputs.picture, png) {
            let name = format!("{}.png", file_name(id));
            std::fs::create_dir_all(folder).map_err(|e| StageError::new(format!("{}: {e}", folder.display())))?;
            write_file(&folder.join(&name), png, self.outputs.force).map_err(failed)?;
            run.trial.picture = Some(name);
        }
        Ok(())
    }
}

/// The plan of a record, made for this home.
pub(super) fn plan_of(record: &Record, home: &Home) -> Result<Plan, StageError> {
    let plan: Plan = record.require("plan", "pipe the record through `plan` first")?;
    if plan.map != home.map.name {
        let (plan, home) = (&plan.map, &home.map.name);
        let message = format!("`plan`: made for the map `{plan}`, the robot is in `{home}`; give both the same --map");
        return Err(StageError::new(message));
    }
    Ok(plan)
}

/// A trial for people.
pub(super) fn text_of(record: &Record) -> Result<String, StageError> {
    let trial: Trial = record.require("trial", "it is what `drive` adds")?;
    let mut lines: Vec<String> = record.get::<String>("text")?.into_iter().collect();
    for action in &trial.actions {
        let (start, end) = (action.start_s.0, action.end_s.0);
        lines.push(format!("{start:6.1}–{end:<6.1} {:7} {}", action.action, action.result));
        lines.extend(action.why.split("; ").filter(|why| !why.is_empty()).map(|why| format!("{:22} {why}", "")));
    }
    let outcome = format!("{:?}", trial.outcome).to_lowercase();
    let (metres, seconds) = (trial.distance_m.0, trial.duration_s.0);
    lines.push(format!("{outcome}: {} ({metres:.1} m, {seconds:.0} s, {} collisions)", trial.why, trial.collisions));
    Ok(lines.join("\n"))
}

impl Stage for Driver {
    fn run(&self, record: &mut Record) -> Result<Note, StageError> {
        let plan = plan_of(record, &self.home)?;
        let id = record.id().unwrap_or_else(|| "record".to_string());
        self.drive(record, &plan, &id)?;
        Ok(Note::Done)
    }

    fn text(&self, record: &Record) -> Result<String, StageError> {
        text_of(record)
    }
}

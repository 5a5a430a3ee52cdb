//! `perceive --fuse`: all frames of a scene make one record.

use rayon::prelude::*;
use spatial_fetch::cli::{
    self, Common, Diagnostic, Exit, Failure, Format, FrameInput, FrameItem, Line, Reporter, Source, open_output,
};
use spatial_fetch::escape::for_terminal;
use spatial_fetch::perception::{Perceiver, SceneRecord, SceneView, Scenes, scene_of};
use spatial_fetch::record::{Record, StageError};

/// Looks at every frame and writes one record a scene, in the order in which scenes first appear.
pub fn run(common: &Common, input: FrameInput, perceiver: &Perceiver) -> Result<Exit, Failure> {
    let mut gathering =
        Gathering { common, reporter: Reporter::new("perceive", common), scenes: Scenes::default(), exit: Exit::Done };
    match input {
        FrameInput::Lines(mut lines) => gathering.gather(&mut lines, &|line| look_at_line(perceiver, line))?,
        FrameInput::Logs(mut logs) => {
            gathering.gather(logs.as_mut(), &|item| look_at_item(perceiver, item).map(Some))?
        }
    }
    let sink = open_output(common)?;
    for scene in gathering.scenes.fused() {
        // Guesses of several views together may be none.
        let scene = SceneRecord { detections: perceiver.sure(scene.detections), ..scene };
        let text = match common.format {
            Format::Json | Format::Csv => {
                serde_json::to_string(&scene).map_err(|error| Failure::Failed(error.to_string()))?
            }
            Format::Text => for_terminal(&scene.text()).into_owned(),
        };
        sink.write(format!("{text}\n").as_bytes())?;
    }
    sink.finish()?;
    Ok(gathering.exit)
}

struct Gathering<'c> {
    common: &'c Common,
    reporter: Reporter,
    scenes: Scenes,
    exit: Exit,
}

impl Gathering<'_> {
    fn gather<T: Sync>(
        &mut self,
        source: &mut dyn Source<T>,
        look: &(dyn Fn(&T) -> Result<Option<SceneView>, Diagnostic> + Sync),
    ) -> Result<(), Failure> {
        loop {
            let batch = source.next_batch(256)?;
            for lost in source.lost() {
                self.reporter.warning(&lost);
                self.exit = Exit::Lost;
            }
            if batch.is_empty() {
                return Ok(());
            }
            let seen: Vec<Result<Option<SceneView>, Diagnostic>> = batch.par_iter().map(look).collect();
            for view in seen {
                match view {
                    Ok(view) => view.into_iter().for_each(|view| self.scenes.add(view)),
                    Err(error) => self.lose(&error)?,
                }
            }
        }
    }

    fn lose(&mut self, error: &Diagnostic) -> Result<(), Failure> {
        self.reporter.error(error);
        self.exit = Exit::Lost;
        let stop = "stopped at the first frame that failed; --keep-going goes on";
        if self.common.keep_going { Ok(()) } else { Err(Failure::Failed(stop.to_string())) }
    }
}

/// A blank line shows nothing.
fn look_at_line(perceiver: &Perceiver, line: &Line) -> Result<Option<SceneView>, Diagnostic> {
    let Some(record) = cli::record_of(line, super::INTAKE)? else { return Ok(None) };
    let view = || -> Result<SceneView, StageError> {
        let (name, frame, from) = perceiver.frame_of(&record)?;
        let view = perceiver.look(&name, &frame, from, &record)?;
        let said = record.get::<String>("scene")?;
        Ok(SceneView::new(said.unwrap_or_else(|| scene_of(&name).to_string()), name, &frame, view))
    };
    view().map(Some).map_err(|error| Diagnostic::at(line, error.offset.unwrap_or(0), record.id(), error.message))
}

/// A log is one scene.
fn look_at_item(perceiver: &Perceiver, item: &FrameItem) -> Result<SceneView, Diagnostic> {
    let (name, frame) = (item.ordinal.to_string(), &item.timed.frame);
    let mut record = Record::default();
    record.set("frame", &item.name());
    let view = perceiver.look(&name, frame, item.timed.pose_from, &record);
    let place = format!("{}: frame {name}", item.file);
    view.map(|view| SceneView::new(item.file.clone(), name, frame, view)).map_err(|error| Diagnostic {
        place,
        id: None,
        message: error.message,
    })
}

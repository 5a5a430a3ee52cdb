//! `perceive --fuse`: all frames of a scene make one record.

use rayon::prelude::*;
use spatial_fetch::cli::{
    Common, Diagnostic, Exit, Failure, Format, FrameInput, FrameItem, Line, Reporter, Source, open_output,
};
use spatial_fetch::perception::{Perceiver, SceneView, Scenes, scene_of};
use spatial_fetch::record::{Record, StageError};

type Seen = Vec<Result<SceneView, Diagnostic>>;

/// Looks at every frame and writes one record a scene, in the order in which scenes first appear.
pub fn run(common: &Common, perceiver: &Perceiver, input: FrameInput) -> Result<Exit, Failure> {
    let mut scenes = Scenes::default();
    let exit = match input {
        FrameInput::Lines(mut lines) => take_in(common, &mut lines, &mut scenes, |batch| {
            batch.par_iter().map(|line| look(perceiver, line)).collect()
        }),
        FrameInput::Logs(mut logs) => take_in(common, logs.as_mut(), &mut scenes, |batch| {
            batch.par_iter().map(|item| look_at(perceiver, item)).collect()
        }),
    }?;
    let sink = open_output(common)?;
    for scene in scenes.fused() {
        let text = match common.format {
            Format::Json => serde_json::to_string(&scene).map_err(|error| Failure::Failed(error.to_string()))?,
            Format::Text => scene.text(),
        };
        sink.write(format!("{text}\n").as_bytes())?;
    }
    sink.finish()?;
    Ok(exit)
}

fn take_in<T>(
    common: &Common,
    source: &mut dyn Source<T>,
    scenes: &mut Scenes,
    look: impl Fn(&[T]) -> Seen,
) -> Result<Exit, Failure> {
    let reporter = Reporter::new("perceive", common);
    let mut exit = Exit::Done;
    loop {
        let batch = source.next_batch(256)?;
        for lost in source.lost() {
            reporter.warning(&lost);
            exit = Exit::Lost;
        }
        if batch.is_empty() {
            return Ok(exit);
        }
        for view in look(&batch) {
            match view {
                Ok(view) => scenes.add(view),
                Err(error) => {
                    reporter.error(&error);
                    exit = Exit::Lost;
                    if !common.keep_going {
                        let what = "stopped at the first frame that failed; --keep-going goes on";
                        return Err(Failure::Failed(what.to_string()));
                    }
                }
            }
        }
    }
}

/// All frames of a log are one scene.
fn look_at(perceiver: &Perceiver, item: &FrameItem) -> Result<SceneView, Diagnostic> {
    let (name, frame) = (item.name(), &item.timed.frame);
    let view = perceiver.look(&name, frame);
    let view = view.map_err(|error| Diagnostic::at(&item.line(), 0, Some(name.clone()), error.message))?;
    Ok(SceneView::new(scene_of(&name).to_string(), name, frame, view))
}

fn look(perceiver: &Perceiver, line: &Line) -> Result<SceneView, Diagnostic> {
    let text =
        std::str::from_utf8(&line.bytes).map_err(|e| Diagnostic::at(line, e.valid_up_to(), None, "not UTF-8"))?;
    let record = Record::parse(text)
        .map_err(|e| Diagnostic::at(line, e.column().saturating_sub(1), None, format!("not a record: {e}")))?;
    let view = || -> Result<SceneView, StageError> {
        let (name, frame) = perceiver.frame_of(&record)?;
        let view = perceiver.look(&name, &frame)?;
        let said = record.get::<String>("scene")?;
        Ok(SceneView::new(said.unwrap_or_else(|| scene_of(&name).to_string()), name, &frame, view))
    };
    view().map_err(|error| Diagnostic::at(line, error.offset.unwrap_or(0), record.id(), error.message))
}

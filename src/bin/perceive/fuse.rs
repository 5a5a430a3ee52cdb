//! `perceive --fuse`: all frames of a scene make one record.

use rayon::prelude::*;
use spatial_fetch::cli::{Common, Diagnostic, Exit, Failure, Format, Inputs, Line, Reporter, Source, open_output};
use spatial_fetch::perception::{Perceiver, SceneView, Scenes, scene_of};
use spatial_fetch::record::{Record, StageError};

/// Looks at every frame and writes one record a scene, in the order in which scenes first appear.
pub fn run(common: &Common, perceiver: &Perceiver) -> Result<Exit, Failure> {
    let reporter = Reporter::new("perceive", common);
    let (mut inputs, mut scenes, mut exit) = (Inputs::new(&common.files), Scenes::default(), Exit::Done);
    loop {
        let lines = inputs.next_batch(256)?;
        if lines.is_empty() {
            break;
        }
        let seen: Vec<Result<SceneView, Diagnostic>> = lines.par_iter().map(|line| look(perceiver, line)).collect();
        for view in seen {
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

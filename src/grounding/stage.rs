//! `ground` as a stage of the pipeline.

use super::Grounder;
use super::table::table;
use crate::record::{Chunk, Grounding, Note, Record, Stage, StageError};

/// Adds `grounding` to records.
#[derive(Clone, Debug)]
pub struct GroundStage(pub Grounder);

impl Stage for GroundStage {
    fn run(&self, record: &mut Record) -> Result<Note, StageError> {
        let text: String = record.require("text", "a record needs the description under this key")?;
        let chunks: Vec<Chunk> = record.require("chunks", "pipe the record through `chunk` first")?;
        check_spans(&text, &chunks)?;
        record.set("grounding", &self.0.ground(&text, &chunks));
        Ok(Note::Done)
    }

    fn text(&self, record: &Record) -> Result<String, StageError> {
        let text: String = record.require("text", "a record needs the description under this key")?;
        let grounding: Grounding = record.require("grounding", "it is what `ground` adds")?;
        Ok(table(&text, &grounding))
    }
}

/// A tree made elsewhere may not fit its text.
fn check_spans(text: &str, chunks: &[Chunk]) -> Result<(), StageError> {
    let mut waiting: Vec<&Chunk> = chunks.iter().collect();
    while let Some(chunk) = waiting.pop() {
        if chunk.start > chunk.end || !text.is_char_boundary(chunk.start) || !text.is_char_boundary(chunk.end) {
            let (tag, start, end) = (chunk.tag.name(), chunk.start, chunk.end);
            return Err(StageError::new(format!(
                "`chunks`: {tag} from byte {start} to {end} does not fit `text`; offsets are bytes, ends exclusive"
            )));
        }
        waiting.extend(&chunk.chunks);
    }
    Ok(())
}

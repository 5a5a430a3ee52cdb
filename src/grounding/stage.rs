//! `ground` as a stage of the pipeline.

use super::table::table;
use super::{Grounder, answer};
use crate::record::{Chunk, Grounding, Note, Record, Stage, StageError, Token};

/// Adds `grounding` to records.
#[derive(Clone, Debug)]
pub struct GroundStage {
    /// How descriptions are grounded.
    pub grounder: Grounder,
    /// The reply to the question of an earlier run.
    pub answer: Option<String>,
}

impl Stage for GroundStage {
    fn run(&self, record: &mut Record) -> Result<Note, StageError> {
        let text: String = record.require("text", "a record needs the description under this key")?;
        let chunks: Vec<Chunk> = record.require_part("pipe the record through `chunk` first")?;
        check_spans(&text, &chunks)?;
        let wants = self.grounder.wants_tokens();
        let tokens: Vec<Token> = if wants { record.part()?.unwrap_or_default() } else { Vec::new() };
        let mut grounding = self.grounder.ground(&text, &tokens, &chunks);
        let reply = self.answer.as_ref();
        let unused = reply.filter(|reply| !answer(&mut grounding, reply, self.grounder.lexicon()));
        record.put(&grounding);
        Ok(unused.map_or(Note::Done, |reply| {
            Note::Lossy(format!("the answer \"{reply}\" names no room, side, furniture or object; say one of them"))
        }))
    }

    fn text(&self, record: &Record) -> Result<String, StageError> {
        let text: String = record.require("text", "a record needs the description under this key")?;
        let grounding: Grounding = record.require_part("it is what `ground` adds")?;
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

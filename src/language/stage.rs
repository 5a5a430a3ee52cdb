//! `chunk` as a stage of the pipeline.

use std::sync::Arc;

use super::{Lexicon, chunk_with, draw_tree};
use crate::limits::TEXT_BYTES;
use crate::record::{Chunk, Note, Record, Stage, StageError};

/// Adds `tokens` and `chunks` to records.
#[derive(Clone, Debug, Default)]
pub struct Chunker {
    /// The words it knows; the embedded lexicon when none is given.
    pub lexicon: Option<Arc<Lexicon>>,
    /// Names the rule behind each chunk.
    pub explain: bool,
}

impl Stage for Chunker {
    fn run(&self, record: &mut Record) -> Result<Note, StageError> {
        let text: String = record.require("text", "a record needs the description under this key")?;
        if text.len() as u64 > TEXT_BYTES.value {
            let found = text.len().to_string();
            return Err(StageError::new(format!("`text`: {}; part it into records", TEXT_BYTES.exceeded(&found))));
        }
        let (tokens, mut chunks) = chunk_with(&text, self.lexicon.as_deref().unwrap_or(Lexicon::embedded()));
        if !self.explain {
            chunks.iter_mut().for_each(forget_rules);
        }
        record.put(&tokens);
        record.put(&chunks);
        Ok(Note::Done)
    }

    fn text(&self, record: &Record) -> Result<String, StageError> {
        let text: String = record.require("text", "a record needs the description under this key")?;
        let chunks: Vec<Chunk> = record.require_part("it is what `chunk` adds")?;
        Ok(draw_tree(&text, &chunks))
    }
}

fn forget_rules(chunk: &mut Chunk) {
    chunk.rule = None;
    chunk.chunks.iter_mut().for_each(forget_rules);
}

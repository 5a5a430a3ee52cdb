//! What `evaluate` reads and writes.

use std::path::{Path, PathBuf};

use super::{Common, Exit, Failure, Format, Inputs, Source, open_output, read_file};
use crate::evaluation::{Gold, Scores, read_gold, text_tables};

/// Scores with the line that stands over them.
#[derive(Clone, Debug)]
pub struct Table {
    /// What was scored.
    pub title: String,
    /// The scores.
    pub scores: Scores,
}

/// The gold descriptions of a file; the shipped templates where none is named.
pub fn load_gold(path: Option<&Path>) -> Result<Vec<Gold>, Failure> {
    let (text, file) = match path {
        Some(path) => (read_file(path)?, path.display().to_string()),
        None => (include_str!("../../corpus/templates.jsonl").to_string(), "templates.jsonl".to_string()),
    };
    read_gold(&text, &file).map_err(|error| Failure::Failed(error.to_string()))
}

/// All lines of the inputs that are not blank.
pub fn read_lines(files: &[PathBuf]) -> Result<Vec<String>, Failure> {
    let mut inputs = Inputs::new(files);
    let mut lines = Vec::new();
    loop {
        let batch = inputs.next_batch(1024)?;
        if batch.is_empty() {
            return Ok(lines);
        }
        for line in batch {
            let text = String::from_utf8(line.bytes);
            let text = text.map_err(|_| Failure::Failed(format!("{}:{}: not UTF-8", line.file, line.number)))?;
            if !text.trim().is_empty() {
                lines.push(text);
            }
        }
    }
}

/// Writes scores as text or JSON; a record that was missing or doubled makes the run a lossy one.
pub fn write_scores(common: &Common, table: &Table) -> Result<Exit, Failure> {
    let text = match common.format {
        Format::Text => text_tables(&table.title, &table.scores),
        Format::Json => serde_json::to_string(&table.scores).map_err(|e| Failure::Failed(e.to_string()))?,
    };
    let sink = open_output(common)?;
    sink.write(format!("{text}\n").as_bytes())?;
    sink.finish()?;
    let lossless =
        table.scores.missing.is_empty() && table.scores.doubled.is_empty() && table.scores.unknown.is_empty();
    Ok(if lossless { Exit::Done } else { Exit::Lost })
}

//! What `evaluate` reads and writes.

use std::path::{Path, PathBuf};

use serde::Serialize;

use super::paint::painted;
use super::{Common, Exit, Failure, Format, Inputs, Source, open_output, read_file};
use crate::escape::for_terminal;
use crate::evaluation::robustness::{Robustness, robustness_tables};
use crate::evaluation::{Gold, Scores, csv_tables, read_gold, text_tables, with_texts};
use crate::record::{Record, Shade};

/// Scores with the line that stands over them.
#[derive(Clone, Debug, Serialize)]
pub struct Table {
    /// What was scored.
    pub title: String,
    /// The scores.
    pub scores: Scores,
}

/// The gold descriptions of a file; the shipped templates where none is named.
///
/// # Errors
/// When the file cannot be read or a line of it is no gold description.
pub fn load_gold(path: Option<&Path>) -> Result<Vec<Gold>, Failure> {
    let (text, file) = match path {
        Some(path) => (read_file(path)?, path.display().to_string()),
        None => (include_str!("../../corpus/templates.jsonl").to_string(), "templates.jsonl".to_string()),
    };
    read_gold(&text, &file).map_err(|error| Failure::Failed(error.to_string()))
}

/// The same, with the meanings of another file when one is named.
///
/// # Errors
/// When a file cannot be read, a line of it is no gold, or the two do not fit together.
pub fn load_gold_with(path: Option<&Path>, meanings: Option<&Path>) -> Result<Vec<Gold>, Failure> {
    let gold = load_gold(path)?;
    match meanings {
        Some(meanings) => Ok(with_texts(load_gold(Some(meanings))?, gold)),
        None => Ok(gold),
    }
}

/// Id and text of the description with that id, or of the first one.
///
/// # Errors
/// When the file cannot be read, or has no such description.
pub fn find_description(files: &[PathBuf], id: Option<&str>) -> Result<(String, String), Failure> {
    for (i, line) in read_lines(files)?.iter().enumerate() {
        let number = (i + 1).to_string();
        let (found, text) = if line.trim_start().starts_with('{') {
            let wrong = |error: &dyn std::fmt::Display| Failure::Failed(format!("record {number}: {error}"));
            let record = Record::parse(line).map_err(|error| wrong(&error))?;
            let text = record.require("text", "a record needs the description under this key");
            (record.id().unwrap_or_else(|| number.clone()), text.map_err(|error| wrong(&error))?)
        } else {
            (number, line.trim().to_string())
        };
        if id.is_none_or(|id| id == found) {
            return Ok((found, text));
        }
    }
    Err(Failure::Failed(match id {
        Some(id) => format!("no description has the id {id:?}"),
        None => "no description: pipe one in, or give --text".to_string(),
    }))
}

/// Writes a report as JSON, or as the text that `table` draws.
///
/// # Errors
/// When the output cannot be written.
pub fn write_report(common: &Common, report: &impl Serialize, table: impl FnOnce() -> String) -> Result<(), Failure> {
    let written = match common.format {
        Format::Text => {
            let shade = |number, _: &str| if number == 0 { Shade::Said } else { Shade::Plain };
            let (text, style) = (for_terminal(&table()).into_owned(), common.style());
            if style.color { painted(&text, shade) } else { text }
        }
        Format::Csv => {
            return Err(Failure::Usage("--format csv: this has no rows; json and text are written".to_string()));
        }
        Format::Json => serde_json::to_string(report).map_err(|e| Failure::Failed(e.to_string()))?,
    };
    write_text(common, &written)
}

/// Writes text, and a line's end after it, to where `--output` says.
///
/// # Errors
/// When the output cannot be written.
pub fn write_text(common: &Common, text: &str) -> Result<(), Failure> {
    let sink = open_output(common)?;
    sink.write(format!("{text}\n").as_bytes())?;
    sink.finish()
}

/// All lines of the inputs that are not blank.
///
/// # Errors
/// When an input cannot be read.
pub fn read_lines(files: &[PathBuf]) -> Result<Vec<String>, Failure> {
    let mut inputs = Inputs::new(files, false);
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
///
/// # Errors
/// When the output cannot be written.
pub fn write_scores(common: &Common, table: &Table) -> Result<Exit, Failure> {
    match common.format {
        Format::Csv => write_text(common, &csv_tables(&table.scores))?,
        _ => write_report(common, &table.scores, || text_tables(&table.title, &table.scores))?,
    }
    let lossless =
        table.scores.missing.is_empty() && table.scores.doubled.is_empty() && table.scores.unknown.is_empty();
    Ok(if lossless { Exit::Done } else { Exit::Lost })
}

/// Gold corpora by name: the files, or the shipped templates and speech where none is named.
///
/// # Errors
/// When a file cannot be read or a line of it is no gold description.
pub fn load_corpora(files: &[PathBuf]) -> Result<Vec<(String, Vec<Gold>)>, Failure> {
    const SHIPPED: [(&str, &str); 2] = [
        ("templates.jsonl", include_str!("../../corpus/templates.jsonl")),
        ("speech.jsonl", include_str!("../../corpus/speech.jsonl")),
    ];
    let read = |text: &str, file: &str| {
        let gold = read_gold(text, file).map_err(|error| Failure::Failed(error.to_string()))?;
        Ok((file.to_string(), gold))
    };
    match files {
        [] => SHIPPED.iter().map(|(file, text)| read(text, file)).collect(),
        files => files.iter().map(|path| read(&read_file(path)?, &path.display().to_string())).collect(),
    }
}

/// Writes what `evaluate robustness` added up; a world that could not be made makes the run a lossy one.
///
/// # Errors
/// When the output cannot be written.
pub fn write_robustness(common: &Common, robustness: &Robustness) -> Result<Exit, Failure> {
    write_report(common, robustness, || robustness_tables(robustness))?;
    let tallies = [&robustness.kept, &robustness.broken, &robustness.gold, &robustness.gold_from_text];
    let lossless = tallies.into_iter().flatten().all(|tally| tally.not_made.is_empty());
    Ok(if lossless { Exit::Done } else { Exit::Lost })
}

//! What a stage is: something that adds one key to a record.

use super::{FieldError, Record, Row};

/// One stage of the pipeline, as a filter runs it.
pub trait Stage: Sync {
    /// Reads what it needs from the record and adds its own key.
    fn run(&self, record: &mut Record) -> Result<Note, StageError>;

    /// The record for people, after [`Stage::run`]: `--format text`. Lines end in a newline, the last one not.
    fn text(&self, record: &Record) -> Result<String, StageError>;

    /// How a line of that text is shaded on a terminal.
    fn shade(&self, _line: &str) -> Shade {
        Shade::Plain
    }

    /// The record as a row of a table, after [`Stage::run`]: `--format csv`. Nothing of a stage that makes no tables.
    fn row(&self, _record: &Record) -> Option<Result<Row, StageError>> {
        None
    }

    /// Whether it makes rows.
    fn has_rows(&self) -> bool {
        false
    }

    /// Whether it tells on standard error itself what it does, as it does it, so that nothing need be told after it.
    fn narrates(&self) -> bool {
        false
    }
}

/// How a line of text for people is shaded, where there is colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shade {
    /// As it is.
    Plain,
    /// What a person said.
    Said,
    /// What was reached.
    Good,
    /// What went wrong.
    Bad,
    /// Reasons, for those who want them.
    Faint,
}

/// How a stage did on one record.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Note {
    /// All well.
    Done,
    /// Done, but something of the input was lost or skipped; says what.
    Lossy(String),
}

impl Note {
    /// The same, and what else was lost.
    pub fn and(self, mut lost: Vec<String>) -> Self {
        if let Self::Lossy(what) = self {
            lost.insert(0, what);
        }
        if lost.is_empty() { Self::Done } else { Self::Lossy(lost.join("; ")) }
    }
}

/// Why a stage could not do its work on one record.
#[derive(Debug, thiserror::Error)]
#[error("{message}")]
pub struct StageError {
    /// What was wrong, and what mends it.
    pub message: String,
    /// Bytes from the start of the line to the place.
    pub offset: Option<usize>,
}

impl StageError {
    /// An error about the record as a whole.
    pub fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), offset: None }
    }
}

impl From<FieldError> for StageError {
    fn from(error: FieldError) -> Self {
        Self { message: error.to_string(), offset: error.offset }
    }
}

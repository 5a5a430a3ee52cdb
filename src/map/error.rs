//! What can be wrong with a world file.

use std::path::Path;

use serde::Deserialize;

use crate::limits::WORLD_FILE_BYTES;

/// A world that cannot be used, and why.
#[derive(Debug, thiserror::Error)]
pub enum WorldError {
    /// The file cannot be read.
    #[error("{file}: {source}")]
    Unreadable {
        /// The file.
        file: String,
        /// What the system says.
        source: std::io::Error,
    },
    /// The file is not JSON, or not in the form of its schema.
    #[error("{file}:{line}:{column}: {message}")]
    Malformed {
        /// The file.
        file: String,
        /// 1-based.
        line: usize,
        /// 1-based, in bytes.
        column: usize,
        /// What is wrong.
        message: String,
    },
    /// The file is in a version that is not understood.
    #[error("{file}: version {found} of the format; this program reads version {known}")]
    Version {
        /// The file.
        file: String,
        /// The version it says.
        found: u32,
        /// The version understood.
        known: u32,
    },
    /// Something in the world cannot be.
    #[error("{file}: {item}: {message}")]
    Wrong {
        /// The file.
        file: String,
        /// The room, door, furniture or object.
        item: String,
        /// What is wrong with it, and what mends it.
        message: String,
    },
}

/// The text of a file.
pub(crate) fn read(path: &Path) -> Result<String, WorldError> {
    let file = path.display().to_string();
    WORLD_FILE_BYTES.read_text(path).map_err(|source| WorldError::Unreadable { file, source })
}

/// Parses a world file, naming the place of what is wrong.
pub(crate) fn parse<'t, T: Deserialize<'t>>(text: &'t str, file: &str) -> Result<T, WorldError> {
    parse_at(text, 0, text.len(), file)
}

/// Parses `length` bytes from `offset` on of a world file, naming the place in the whole file of what is wrong.
pub(crate) fn parse_at<'t, T: Deserialize<'t>>(
    text: &'t str,
    offset: usize,
    length: usize,
    file: &str,
) -> Result<T, WorldError> {
    let before = &text[..offset];
    serde_json::from_str(&text[offset..offset + length]).map_err(|error| {
        let into_line = before.len() - before.rfind('\n').map_or(0, |at| at + 1);
        WorldError::Malformed {
            file: file.to_string(),
            line: error.line() + before.matches('\n').count(),
            column: error.column() + if error.line() == 1 { into_line } else { 0 },
            message: crate::record::message_without_position(&error),
        }
    })
}

//! One line of input and where it came from.

use std::sync::Arc;

/// One line of input and where it came from.
#[derive(Clone, Debug)]
pub struct Line {
    /// File name, or `<stdin>`.
    pub file: Arc<str>,
    /// 1-based.
    pub number: usize,
    /// Counted over all files, 1-based: the id of a plain line.
    pub ordinal: usize,
    /// The bytes without the line's end.
    pub bytes: Vec<u8>,
    /// Whether the line's end was there; a last line without one may have been cut.
    pub terminated: bool,
}

//! Where a filter's work comes from: lines, records of a log, frames.

use super::{Diagnostic, Failure};

/// Gives out work in batches, and tells what was lost on the way.
pub trait Source<T> {
    /// The next pieces of work, at most `limit`: waits for the first, then takes what has already arrived.
    ///
    /// Empty at the end.
    fn next_batch(&mut self, limit: usize) -> Result<Vec<T>, Failure>;

    /// How many pieces of work there will be, where that can be known beforehand.
    fn total(&self) -> Option<u64> {
        None
    }

    /// What was lost or skipped since the last call.
    fn lost(&mut self) -> Vec<Diagnostic> {
        Vec::new()
    }
}

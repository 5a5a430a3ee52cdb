//! MCAP in and out.
//!
//! Spatial data as Foxglove's protobuf schemas, our own records as JSON, one
//! line one message, byte for byte. Times are the trial's own seconds from
//! zero, so that the same trial gives the same file.

mod read;
mod trial_log;

pub use read::{LogError, records};
pub use trial_log::{Piece, TrialLog};

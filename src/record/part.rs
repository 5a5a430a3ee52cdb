//! What a stage adds to a record, each under a key that its type alone names.

use super::{CameraPose, Chunk, Detection, Grounding, Hof, Plan, Token, Trial};

/// A value that stands in records under one key.
pub trait Part {
    /// The key.
    const KEY: &'static str;
}

/// Gives each type its key.
macro_rules! keys {
    ($($key:literal: $part:ty,)+) => {
        $(impl Part for $part {
            const KEY: &'static str = $key;
        })+
    };
}

keys! {
    "tokens": Vec<Token>,
    "chunks": Vec<Chunk>,
    "grounding": Grounding,
    "plan": Plan,
    "trial": Trial,
    "hof": Hof,
    "camera": CameraPose,
    "detections": Vec<Detection>,
}

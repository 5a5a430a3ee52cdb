//! Gold that says what a description means, without a tree: labelled by the rules of `docs/annotation.md`.
//!
//! Such a line need not hold the text; then it comes from another file by id.

use serde::Deserialize;

use super::gold::Gold;
use crate::record::{Direction, RoomSlot};

/// One line.
#[derive(Deserialize)]
pub(super) struct MeaningEntry {
    id: String,
    #[serde(default)]
    text: String,
    object: Option<String>,
    room: Option<RoomSlot>,
    target: Option<String>,
    pairs: Vec<(String, Direction)>,
    #[serde(default)]
    optional: Vec<(String, Direction)>,
    #[serde(default)]
    doubt: Option<String>,
}

impl MeaningEntry {
    pub fn into_gold(self) -> Gold {
        let room = self.room.unwrap_or_default();
        let mut pairs = self.pairs;
        pairs.sort();
        Gold {
            id: self.id,
            text: self.text,
            has_grounding: true,
            side: room.side,
            room: room.name,
            object: self.object,
            has_target: self.target.is_some(),
            target: self.target,
            pairs,
            optional: self.optional,
            side_in_doubt: self.doubt.as_deref() == Some("side"),
            ..Gold::default()
        }
    }
}

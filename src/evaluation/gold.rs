//! A gold description: what it says, and what it is labelled as.

use std::collections::BTreeSet;

use super::brackets::Bracket;
use crate::grounding::paper::Label;
use crate::record::{Chunk, Direction, Grounding, Tag, Token};

/// What a description is labelled as.
#[derive(Clone, Debug, Default)]
pub struct Gold {
    /// The record's id.
    pub id: String,
    /// The description.
    pub text: String,
    /// Labelled brackets over its words; empty when it has no tree.
    pub brackets: BTreeSet<Bracket>,
    /// The side that picks the room.
    pub side: Option<Direction>,
    /// The room's name.
    pub room: Option<String>,
    /// The object.
    pub object: Option<String>,
    /// Whether any target furniture is named.
    pub has_target: bool,
    /// The last target furniture named.
    pub target: Option<String>,
    /// References and directions, sorted.
    pub pairs: Vec<(String, Direction)>,
    /// Pairs that may be said or not.
    pub optional: Vec<(String, Direction)>,
    /// Whether the side is doubtful: then none is asked for.
    pub side_in_doubt: bool,
    /// Whose rules it was labelled by, and so how agreement is counted.
    pub rules: Rules,
    /// Words with parts of speech, where the corpus gives them.
    pub tokens: Vec<Token>,
    /// The tree; empty when there is none.
    pub chunks: Vec<Chunk>,
    /// A label for each chunk of the tree in pre-order; empty when there is none.
    pub labels: Vec<Label>,
    /// What it means, as the stages have it; nothing where it is not labelled.
    pub grounding: Option<Grounding>,
    /// Ids of the furniture that the words allow.
    pub expect: Vec<String>,
}

/// By whose rules descriptions were labelled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rules {
    /// `docs/annotation.md`.
    #[default]
    Guide,
    /// A label for each chunk, as the paper's authors gave them.
    Chunks,
}

/// A gold file that cannot be read.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{file}:{line}: {message}")]
pub struct GoldError {
    /// The file.
    pub file: String,
    /// 1-based.
    pub line: usize,
    /// What is wrong.
    pub message: String,
}

impl Gold {
    /// Whether it says what the description means, as a whole or chunk by chunk.
    pub fn is_labelled(&self) -> bool {
        self.grounding.is_some() || !self.labels.is_empty()
    }

    /// "where" when the description begins with the object, else "how".
    pub fn form(&self) -> &'static str {
        let first = self.brackets.iter().map(|(_, first, _)| *first).min();
        let begins = |tag: Tag| self.brackets.iter().any(|(t, f, _)| *t == tag && Some(*f) == first);
        if begins(Tag::Obtp) { "where" } else { "how" }
    }

    /// Which furniture it names: none, the table alone, or other furniture as well.
    pub fn names(&self) -> &'static str {
        let has = |tag: Tag| self.brackets.iter().any(|(t, _, _)| *t == tag);
        match (has(Tag::Furrp) || has(Tag::Obrp), has(Tag::Furtp)) {
            (true, _) => "other",
            (false, true) => "table only",
            (false, false) => "none",
        }
    }
}

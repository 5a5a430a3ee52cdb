//! Grounding chunk by chunk on gold trees.

use std::collections::BTreeMap;

use serde::Serialize;

use super::super::treebank::side_of_room;
use super::super::{Gold, Rate};
use crate::grounding::paper::Label;
use crate::grounding::{Grounder, Meaning};
use crate::record::Direction;

/// How often chunks, and all chunks of a description, get the meaning of their label.
#[derive(Clone, Debug, Default, Serialize)]
pub struct TreeRates {
    /// Chunks right.
    pub chunks: Rate,
    /// Descriptions with all chunks right: the paper's command rate.
    pub commands: Rate,
    /// Chunks right, by tag.
    pub by_tag: BTreeMap<&'static str, Rate>,
}

/// Whether each chunk of the tree has a label.
pub(super) fn is_labelled(gold: &Gold) -> bool {
    !gold.labels.is_empty() && count(&gold.chunks) == gold.labels.len()
}

fn count(chunks: &[crate::record::Chunk]) -> usize {
    chunks.iter().map(|chunk| 1 + count(&chunk.chunks)).sum()
}

pub(super) fn rates(grounder: &Grounder, gold: &[&Gold]) -> TreeRates {
    let mut rates = TreeRates::default();
    for gold in gold {
        let meanings = grounder.meanings(&gold.text, &gold.tokens, &gold.chunks);
        let mut all = true;
        for ((tag, meaning), label) in meanings.iter().zip(&gold.labels) {
            let right = agrees(label, meaning);
            all &= right;
            rates.chunks.count(right);
            rates.by_tag.entry(tag.name()).or_default().count(right);
        }
        rates.commands.count(all);
    }
    rates
}

/// Whether a meaning is that of the label. A room is asked for where the label has one, by side or by name; a
/// target counts as furniture, whatever its noun; of several pairs the first is labelled.
pub(super) fn agrees(label: &Label, meaning: &Meaning) -> bool {
    let expected = label.meaning(1.0, String::new());
    let side = |meaning: &Meaning| meaning.side.or_else(|| side_of_room(meaning.room.as_deref()));
    let room = expected.room.is_none() && expected.side.is_none()
        || side(&expected).is_some() && side(&expected) == side(meaning)
        || expected.room.is_some() && expected.room == meaning.room;
    let first = |meaning: &Meaning| -> Option<(String, Direction)> {
        meaning.pairs.first().map(|pair| (pair.reference.to_string(), pair.direction))
    };
    room && expected.object == meaning.object
        && expected.target.is_some() == meaning.target.is_some()
        && first(&expected) == first(meaning)
}

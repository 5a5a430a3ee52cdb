//! The model of the paper's method, learned from the project's own labelled trees.

use super::labelled::{LabelledChunk, parse_tree};
use crate::grounding::paper::{Example, Model};
use crate::grounding::{Meaning, chunk_words, meaning_of_label};

/// The model learned from the shipped templates.
pub fn shipped_model() -> Result<Model, String> {
    let corpus = include_str!("../../corpus/templates.jsonl");
    let mut examples = Vec::new();
    for line in corpus.lines() {
        let entry: serde_json::Value = serde_json::from_str(line).map_err(|error| error.to_string())?;
        let tree = parse_tree(entry["tree"].as_str().unwrap_or_default()).map_err(|error| error.to_string())?;
        let chunks: Vec<_> = tree.chunks.iter().map(LabelledChunk::to_chunk).collect();
        let words = chunk_words(&tree.text, &chunks);
        for (chunk, meaning) in words.iter().zip(meanings_of(&tree.chunks)) {
            let words = chunk.words.iter().map(|word| word.lower.clone()).collect();
            examples.push(Example { tag: chunk.tag, words, meaning });
        }
    }
    Ok(Model::train(examples, false))
}

/// The meanings the labels of a tree give its chunks, in pre-order.
pub(super) fn meanings_of(chunks: &[LabelledChunk]) -> Vec<Meaning> {
    let mut meanings = Vec::new();
    let mut waiting: Vec<&LabelledChunk> = chunks.iter().rev().collect();
    while let Some(chunk) = waiting.pop() {
        meanings.push(meaning_of_label(chunk.tag, chunk.label.as_deref()));
        waiting.extend(chunk.children.iter().rev());
    }
    meanings
}

//! The training file of the paper's method: the shipped templates, each chunk with its label.
//!
//! `corpus/training/descriptions.jsonl` is made from `corpus/templates.jsonl`
//! (`UPDATE=1 cargo test --lib training_file`), so that the one is written by
//! hand and the other never.

use serde_json::{Map, Value, json};

use super::labelled::{LabelledChunk, TreeError, parse_tree};
use crate::grounding::paper::Label;
use crate::record::Tag;

/// A training record: id, text, chunks, and a grounding for each chunk in pre-order.
///
/// # Errors
/// When the tree cannot be read.
pub fn training_record(id: &str, tree: &str) -> Result<Value, TreeError> {
    let tree = parse_tree(tree)?;
    let chunks: Vec<_> = tree.chunks.iter().map(LabelledChunk::to_chunk).collect();
    let groundings: Vec<Value> = in_order(&tree.chunks).into_iter().map(label).collect();
    Ok(json!({"id": id, "text": tree.text, "chunks": chunks, "groundings": groundings}))
}

/// The label of a chunk as the paper's method learns it; of several pairs the first.
pub(super) fn label_of(chunk: &LabelledChunk) -> Label {
    serde_json::from_value(label(chunk)).unwrap_or_default()
}

/// All chunks in pre-order.
pub(super) fn in_order(chunks: &[LabelledChunk]) -> Vec<&LabelledChunk> {
    let mut all = Vec::new();
    let mut waiting: Vec<&LabelledChunk> = chunks.iter().rev().collect();
    while let Some(chunk) = waiting.pop() {
        all.push(chunk);
        waiting.extend(chunk.children.iter().rev());
    }
    all
}

fn label(chunk: &LabelledChunk) -> Value {
    let mut label = Map::new();
    if let Some(text) = &chunk.label {
        match chunk.tag {
            Tag::Ormtp | Tag::Ormrp => label.insert("room".to_string(), json!(text)),
            Tag::Obtp => label.insert("object".to_string(), json!(text)),
            Tag::Furtp => label.insert("target".to_string(), json!(text)),
            _ => {
                let (reference, direction) =
                    text.split(',').next().and_then(|pair| pair.split_once('/')).unwrap_or((text, "side"));
                label.insert("reference".to_string(), json!(reference));
                label.insert("direction".to_string(), json!(direction))
            }
        };
    }
    Value::Object(label)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_training_file_is_made_from_the_templates() {
        let templates = include_str!("../../corpus/templates.jsonl");
        let made: String = templates
            .lines()
            .map(|line| {
                let entry: Value = serde_json::from_str(line).expect("JSON");
                let (id, tree) = (entry["id"].as_str().unwrap_or_default(), entry["tree"].as_str().unwrap_or_default());
                format!("{}\n", training_record(id, tree).expect("a tree"))
            })
            .collect();
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/corpus/training/descriptions.jsonl");
        if std::env::var_os("UPDATE").is_some() {
            std::fs::write(path, &made).expect("written");
        }
        let stored = std::fs::read_to_string(path).expect("readable");
        assert!(stored == made, "run UPDATE=1 cargo test --lib training_file");
    }
}

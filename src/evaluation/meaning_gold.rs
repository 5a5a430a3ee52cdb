//! Gold that says what a description means, without a tree: labelled by the rules of `docs/annotation.md`.
//!
//! Such a line need not hold the text; then it comes from another file by id.

use std::collections::HashMap;

use serde::Deserialize;

use super::gold::Gold;
use crate::grounding::Meaning;
use crate::record::{Direction, Grounding, Node, ObjectSlot, RoomSlot};

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
    nodes: Vec<MeaningNode>,
    #[serde(default)]
    optional: Vec<(String, Direction)>,
    #[serde(default)]
    doubt: Option<String>,
}

#[derive(Deserialize)]
struct MeaningNode {
    target: Option<String>,
    pairs: Vec<(String, Direction)>,
}

impl MeaningNode {
    fn into_node(self) -> Node {
        let pair = |(reference, direction): &(String, Direction)| Meaning::of_pair(reference, *direction, "").pairs;
        Node { target: self.target, pairs: self.pairs.iter().flat_map(pair).collect(), ..Node::default() }
    }
}

impl MeaningEntry {
    pub fn into_gold(self) -> Gold {
        let object = self.object.as_ref().map(|name| ObjectSlot { name: name.clone(), ..ObjectSlot::default() });
        let nodes = self.nodes.into_iter().map(MeaningNode::into_node).collect();
        let grounding = Grounding { room: self.room.clone(), object, nodes, ..Grounding::default() };
        let room = self.room.unwrap_or_default();
        let mut pairs = self.pairs;
        pairs.sort();
        Gold {
            id: self.id,
            text: self.text,
            side: room.side,
            room: room.name,
            object: self.object,
            has_target: self.target.is_some(),
            target: self.target,
            pairs,
            grounding: Some(grounding),
            optional: self.optional,
            side_in_doubt: self.doubt.as_deref() == Some("side"),
            ..Gold::default()
        }
    }
}

/// Gives each meaning the text and the tree of the description with its id; descriptions without a meaning go.
pub fn with_texts(meanings: Vec<Gold>, texts: Vec<Gold>) -> Vec<Gold> {
    let mut texts: HashMap<String, Gold> = texts.into_iter().map(|gold| (gold.id.clone(), gold)).collect();
    let joined = |meaning: Gold| {
        let Gold { text, brackets, chunks, tokens, .. } = texts.remove(&meaning.id)?;
        Some(Gold { text, brackets, chunks, tokens, ..meaning })
    };
    meanings.into_iter().filter_map(joined).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluation::read_gold;

    #[test]
    fn only_descriptions_with_a_meaning_are_kept() {
        let text = |id: &str| Gold { id: id.to_string(), text: format!("text {id}"), ..Gold::default() };
        let line = r#"{"id":"b","room":{"name":null,"side":"left"},"object":null,"target":"desk","pairs":[["wall","back"]],"nodes":[{"target":"desk","pairs":[["wall","back"]]}]}"#;
        let gold = with_texts(read_gold(line, "m.jsonl").expect("a meaning"), vec![text("a"), text("b")]);
        assert_eq!((gold.len(), gold[0].text.as_str(), gold[0].side), (1, "text b", Some(Direction::Left)));
        assert_eq!(gold[0].grounding.as_ref().map(|m| m.nodes[0].pairs.len()), Some(1));
    }
}

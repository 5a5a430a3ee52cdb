//! Gold meanings in a file of their own, as annotators write them: room, object, nodes with pairs.

use std::collections::HashMap;

use serde::Deserialize;

use super::{Gold, GoldError};
use crate::grounding::Meaning;
use crate::record::{Direction, Grounding, Node, ObjectSlot, RoomSlot};

#[derive(Deserialize)]
struct Entry {
    id: String,
    room: Option<RoomSlot>,
    object: Option<String>,
    nodes: Vec<EntryNode>,
}

#[derive(Deserialize)]
struct EntryNode {
    target: Option<String>,
    pairs: Vec<(String, Direction)>,
}

/// Gives each description its meaning from lines of `id`, `room`, `object`, `nodes` (with `pairs` as
/// `["couch", "back"]`), and keeps only the descriptions that have one.
pub fn add_meanings(gold: Vec<Gold>, text: &str, file: &str) -> Result<Vec<Gold>, GoldError> {
    let mut meanings = HashMap::new();
    for (i, line) in text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        let wrong = |error: serde_json::Error| GoldError {
            file: file.to_string(),
            line: i + 1,
            message: format!("no meaning ({error}); it needs id, room, object, and nodes with pairs"),
        };
        let entry: Entry = serde_json::from_str(line).map_err(wrong)?;
        meanings.insert(entry.id.clone(), entry);
    }
    Ok(gold.into_iter().filter_map(|gold| Some(with_meaning(meanings.remove(&gold.id)?, gold))).collect())
}

fn with_meaning(entry: Entry, gold: Gold) -> Gold {
    let nodes: Vec<Node> = entry.nodes.into_iter().map(node).collect();
    let mut pairs: Vec<_> =
        nodes.iter().flat_map(|node| &node.pairs).map(|pair| (pair.reference.clone(), pair.direction)).collect();
    pairs.sort();
    let room = entry.room.clone().unwrap_or_default();
    let object = entry.object.as_ref().map(|name| ObjectSlot { name: name.clone(), ..ObjectSlot::default() });
    Gold {
        has_grounding: true,
        side: room.side,
        room: room.name,
        object: entry.object,
        has_target: nodes.iter().any(|node| node.target.is_some()),
        pairs,
        grounding: Some(Grounding { room: entry.room, object, nodes, ..Grounding::default() }),
        ..gold
    }
}

fn node(entry: EntryNode) -> Node {
    let pair = |(reference, direction): &(String, Direction)| Meaning::of_pair(reference, *direction, "").pairs;
    Node { target: entry.target, pairs: entry.pairs.iter().flat_map(pair).collect(), ..Node::default() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_descriptions_with_a_meaning_are_kept() {
        let gold = |id: &str| Gold { id: id.to_string(), ..Gold::default() };
        let line = r#"{"id":"b","room":{"name":null,"side":"left"},"object":null,"nodes":[{"target":"desk","pairs":[["wall","back"]]}]}"#;
        let gold = add_meanings(vec![gold("a"), gold("b")], line, "m.jsonl").expect("meanings");
        assert_eq!((gold.len(), gold[0].id.as_str(), gold[0].side), (1, "b", Some(Direction::Left)));
        assert_eq!(gold[0].grounding.as_ref().map(|m| m.nodes[0].pairs.len()), Some(1));
    }

    #[test]
    fn a_bad_line_is_named() {
        let error = add_meanings(Vec::new(), "\n{}", "m.jsonl").expect_err("no meaning");
        assert!(error.to_string().starts_with("m.jsonl:2: no meaning"));
    }
}

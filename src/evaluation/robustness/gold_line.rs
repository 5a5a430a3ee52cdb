//! Gold groundings without trees, as readers label them: room, object, and nodes of reference–direction pairs.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde::de::DeserializeOwned;

use crate::evaluation::GoldError;
use crate::grounding::usual_pair;
use crate::record::{Direction, Grounding, Node, ObjectSlot, RoomSlot};

/// A description's gold grounding.
#[derive(Clone, Debug)]
pub struct GoldLine {
    /// The record's id.
    pub id: String,
    /// What it means.
    pub grounding: Grounding,
}

#[derive(Deserialize)]
struct Line {
    id: String,
    object: Option<String>,
    room: Option<RoomSlot>,
    nodes: Vec<LabelledNode>,
}

#[derive(Deserialize)]
struct LabelledNode {
    target: Option<String>,
    pairs: Vec<(String, Direction)>,
}

#[derive(Deserialize)]
struct Text {
    id: String,
    text: String,
}

/// Reads gold groundings, one JSON object a line; `file` is named in errors.
///
/// # Errors
/// When a line is no gold grounding, with the line.
pub fn read_gold_lines(text: &str, file: &str) -> Result<Vec<GoldLine>, GoldError> {
    let lines: Vec<Line> = read_lines(text, file, "id, object, room {name, side}, nodes [{target, pairs}]")?;
    Ok(lines.into_iter().map(|line| GoldLine { id: line.id.clone(), grounding: grounding_of(line) }).collect())
}

/// Reads descriptions by their ids.
///
/// # Errors
/// When a line is no description, with the line.
pub fn read_texts(text: &str, file: &str) -> Result<BTreeMap<String, String>, GoldError> {
    let lines: Vec<Text> = read_lines(text, file, "id and text")?;
    Ok(lines.into_iter().map(|line| (line.id, line.text)).collect())
}

fn read_lines<T: DeserializeOwned>(text: &str, file: &str, needs: &str) -> Result<Vec<T>, GoldError> {
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    lines
        .map(|(i, line)| {
            serde_json::from_str(line).map_err(|error| GoldError {
                file: file.to_string(),
                line: i + 1,
                message: format!("{error}; a line needs {needs}"),
            })
        })
        .collect()
}

fn grounding_of(line: Line) -> Grounding {
    let node = |node: LabelledNode| Node {
        target: node.target,
        pairs: node.pairs.into_iter().map(|(reference, direction)| usual_pair(&reference, direction)).collect(),
        ..Node::default()
    };
    let said = line.room.filter(|room| room.name.is_some() || room.side.is_some());
    Grounding {
        room: said,
        object: line.object.map(|name| ObjectSlot { name, ..ObjectSlot::default() }),
        nodes: line.nodes.into_iter().map(node).collect(),
        ..Grounding::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_becomes_a_grounding_and_a_bad_one_is_located() {
        let line = r#"{"id":"a","object":"mug","room":{"name":null,"side":"left"},"target":"table","pairs":[],"nodes":[{"target":"table","pairs":[["bed","side"]]}]}"#;
        let gold = read_gold_lines(line, "g.jsonl").expect("gold");
        assert_eq!(gold[0].grounding.nodes[0].pairs[0].direction, Direction::Side);
        let error = read_gold_lines(&format!("{line}\n{{}}"), "g.jsonl").expect_err("no gold").to_string();
        assert!(error.starts_with("g.jsonl:2: ") && error.contains("a line needs id"), "{error}");
    }
}

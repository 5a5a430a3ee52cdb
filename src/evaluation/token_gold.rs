//! Public treebanks of descriptions: words, chunks by token, and a grounding for each chunk in pre-order.

use serde::Deserialize;

use crate::grounding::paper::Label;
use crate::grounding::{Meaning, assemble, chunk_words};
use crate::record::{Chunk, Direction, Grounding, Tag};

/// One description.
#[derive(Deserialize)]
pub(super) struct TokenEntry {
    pub id: String,
    /// The tokens, joined by one space.
    pub text: String,
    pub chunks: Vec<TokenChunk>,
    #[serde(default)]
    pub groundings: Vec<TokenGrounding>,
}

#[derive(Deserialize)]
pub(super) struct TokenChunk {
    pub tag: String,
    /// First token.
    pub start: usize,
    /// One past the last token.
    pub end: usize,
}

#[derive(Deserialize)]
pub(super) struct TokenGrounding {
    #[serde(default)]
    pub tag: Option<String>,
    pub room: Option<String>,
    pub object: Option<String>,
    pub reference: Option<String>,
    pub direction: Option<String>,
    pub target: Option<String>,
}

impl TokenGrounding {
    /// Reference and direction, when there is a reference.
    pub(super) fn pair(&self) -> Option<(String, Direction)> {
        let reference = self.reference.as_ref()?.replace(' ', "_");
        // A reference without a direction is an empty cell of a move ahead.
        let direction = match self.direction.as_deref() {
            Some("back" | "behind") => Direction::Back,
            Some("left") => Direction::Left,
            Some("right") => Direction::Right,
            Some("center" | "central") => Direction::Central,
            Some("beside" | "side") => Direction::Side,
            Some("between") => Direction::Between,
            _ => Direction::Front,
        };
        Some((reference, direction))
    }

    fn meaning(&self) -> Meaning {
        let (reference, direction) = self.pair().unzip();
        let room = match self.room.as_deref() {
            Some("bed room") => Some("bedroom".to_string()),
            room => room.map(str::to_string),
        };
        let label = Label { room, object: self.object.clone(), reference, direction, target: self.target.clone() };
        label.meaning(1.0, "labelled".to_string())
    }
}

/// Slips of the pen in public treebanks are read as what was meant.
pub(super) fn tag_of(name: &str) -> Option<Tag> {
    let name = match name {
        "OBPT" => "OBTP",
        "FURTR" => "FURTP",
        "PERSP" => "PERS",
        "IRMTP" => "IRMRP",
        other => other,
    };
    Tag::from_name(name)
}

/// What the labels of the chunks come to, by the assembly that `ground` uses; nothing without labels.
pub(super) fn grounding_of_tokens(entry: &TokenEntry) -> Option<Grounding> {
    if entry.groundings.is_empty() {
        return None;
    }
    let mut ends: Vec<(usize, usize)> = Vec::new();
    for word in entry.text.split(' ') {
        let start = ends.last().map_or(0, |(_, end)| end + 1);
        ends.push((start, start + word.len()));
    }
    let mut labels = entry.groundings.iter().peekable();
    let mut meanings = Vec::new();
    let mut flat: Vec<Chunk> = Vec::new();
    for chunk in &entry.chunks {
        // Where labels and chunks do not line up, a label belongs to the next chunk of its tag.
        if entry.groundings.len() != entry.chunks.len() {
            while labels.next_if(|label| label.tag.as_deref() != Some(chunk.tag.as_str())).is_some() {}
        }
        let meaning = labels.next().map(TokenGrounding::meaning).unwrap_or_default();
        let (Some(tag), Some(first), Some(last)) =
            (tag_of(&chunk.tag), ends.get(chunk.start), chunk.end.checked_sub(1).and_then(|last| ends.get(last)))
        else {
            continue;
        };
        flat.push(Chunk { tag, start: first.0, end: last.1, rule: None, chunks: Vec::new() });
        meanings.push(meaning);
    }
    Some(assemble(&chunk_words(&entry.text, &nested(flat)), &meanings))
}

/// Chunks in pre-order, each put into the one whose span holds it.
fn nested(flat: Vec<Chunk>) -> Vec<Chunk> {
    let mut roots: Vec<Chunk> = Vec::new();
    let mut open: Vec<Chunk> = Vec::new();
    for chunk in flat {
        while open.last().is_some_and(|parent| parent.end <= chunk.start) {
            close(&mut open, &mut roots);
        }
        open.push(chunk);
    }
    while !open.is_empty() {
        close(&mut open, &mut roots);
    }
    roots
}

fn close(open: &mut Vec<Chunk>, roots: &mut Vec<Chunk>) {
    if let Some(chunk) = open.pop() {
        open.last_mut().map_or(roots, |parent| &mut parent.chunks).push(chunk);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_labels_of_a_treebank_come_to_room_nodes_and_object() {
        let entry: TokenEntry = serde_json::from_str(
            r#"{"id":"1","text":"the cup is in the room on the left on the table behind the sofa",
                "chunks":[{"tag":"OBTP","start":0,"end":15},{"tag":"ORMTP","start":3,"end":9},{"tag":"ORMRP","start":6,"end":9},
                          {"tag":"FURTP","start":9,"end":15},{"tag":"FURRP","start":12,"end":15}],
                "groundings":[{"tag":"OBTP","object":"cup"},{"tag":"ORMTP"},{"tag":"ORMRP","room":"bed room"},
                              {"tag":"FURTP","target":"table"},{"tag":"FURRP","reference":"couch","direction":"back"}]}"#,
        )
        .expect("an entry");
        let grounding = grounding_of_tokens(&entry).expect("labelled");
        assert_eq!(grounding.room.and_then(|room| room.name).as_deref(), Some("bedroom"));
        assert_eq!(grounding.object.map(|object| object.name).as_deref(), Some("cup"));
        assert_eq!(grounding.nodes.len(), 1);
        assert_eq!(grounding.nodes[0].target.as_deref(), Some("table"));
        assert_eq!(grounding.nodes[0].pairs[0].phrase(), "back of the couch");
    }
}

//! Gold from treebanks as JSON lines: chunks by token, and the authors' label of each chunk.

use serde::{Deserialize, Serialize};

use super::gold::{Gold, Rules};
use crate::grounding::paper::Label;
use crate::grounding::{Meaning, assemble, chunk_words};
use crate::record::{Chunk, Direction, Grounding, Tag, Token};

/// One line of a treebank.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct TokenEntry {
    pub id: String,
    pub text: String,
    #[serde(default)]
    pub tokens: Vec<(String, String)>,
    pub chunks: Vec<TokenChunk>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub groundings: Vec<TokenGrounding>,
}

/// A chunk over tokens, the last exclusive, in pre-order.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct TokenChunk {
    pub tag: String,
    pub start: usize,
    pub end: usize,
    #[serde(default)]
    pub depth: usize,
}

/// What a chunk was labelled as.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(super) struct TokenGrounding {
    pub tag: String,
    pub text: String,
    pub room: Option<String>,
    pub object: Option<String>,
    pub reference: Option<String>,
    pub direction: Option<String>,
    pub target: Option<String>,
}

impl TokenEntry {
    pub fn into_gold(self) -> Gold {
        let last =
            |pick: fn(&TokenGrounding) -> Option<&String>| self.groundings.iter().filter_map(pick).next_back().cloned();
        // These corpora name the room by its side in the apartment.
        let side = side_of_room(last(|g| g.room.as_ref()).as_deref());
        let mut pairs: Vec<_> = self.groundings.iter().filter_map(pair_of).collect();
        pairs.sort();
        let target = last(|g| g.target.as_ref()).map(|target| target.replace(' ', "_"));
        let tokens = self.tokens();
        let (chunks, grounding) = self.meant(&tokens);
        Gold {
            brackets: self.chunks.iter().filter_map(|c| Some((tag_of(&c.tag)?, c.start, c.end))).collect(),
            chunks,
            grounding,
            labels: self.groundings.iter().map(label_of).collect(),
            tokens,
            side,
            object: last(|g| g.object.as_ref()).map(|object| object.replace(' ', "_")),
            has_target: target.is_some(),
            target,
            pairs,
            rules: Rules::Chunks,
            id: self.id,
            text: self.text,
            ..Gold::default()
        }
    }

    /// The words where they stand in the text, which joins them by one space.
    fn tokens(&self) -> Vec<Token> {
        let mut start = 0;
        let token = |(i, text): (usize, &str)| {
            let pos = self.tokens.get(i).map(|(_, pos)| pos.clone()).unwrap_or_default();
            let token = Token { text: text.to_string(), pos, start, end: start + text.len() };
            start = token.end + 1;
            token
        };
        self.text.split(' ').enumerate().map(token).collect()
    }

    /// The tree, and what the labels of its chunks come to by the assembly that `ground` uses; nothing without labels.
    fn meant(&self, tokens: &[Token]) -> (Vec<Chunk>, Option<Grounding>) {
        let mut labels = self.groundings.iter().peekable();
        let mut meanings = Vec::new();
        let mut flat: Vec<Chunk> = Vec::new();
        for chunk in &self.chunks {
            // Where labels and chunks do not line up, a label belongs to the next chunk of its tag.
            if self.groundings.len() != self.chunks.len() {
                while labels.next_if(|label| label.tag != chunk.tag).is_some() {}
            }
            let meaning = labels.next().map(TokenGrounding::meaning).unwrap_or_default();
            let ends = (tokens.get(chunk.start), chunk.end.checked_sub(1).and_then(|last| tokens.get(last)));
            let (Some(tag), (Some(first), Some(last))) = (tag_of(&chunk.tag), ends) else { continue };
            flat.push(Chunk { tag, start: first.start, end: last.end, rule: None, chunks: Vec::new() });
            meanings.push(meaning);
        }
        let chunks = nested(flat);
        let grounding = (!self.groundings.is_empty()).then(|| assemble(&chunk_words(&self.text, &chunks), &meanings));
        (chunks, grounding)
    }
}

impl TokenGrounding {
    fn meaning(&self) -> Meaning {
        let mut label = label_of(self);
        if label.room.as_deref() == Some("bed room") {
            label.room = Some("bedroom".to_string());
        }
        // A reference without a direction is an empty cell of a move ahead.
        label.direction = label.direction.or(label.reference.as_ref().map(|_| Direction::Front));
        label.meaning(1.0, "labelled".to_string())
    }
}

/// The room that a side picks in the authors' apartment.
pub(super) fn side_of_room(name: Option<&str>) -> Option<Direction> {
    match name {
        Some("living room" | "living_room") => Some(Direction::Right),
        Some("bedroom" | "bed room") => Some(Direction::Left),
        _ => None,
    }
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

fn label_of(grounding: &TokenGrounding) -> Label {
    Label {
        room: grounding.room.clone(),
        object: grounding.object.clone(),
        direction: direction_of(grounding),
        reference: grounding.reference.clone(),
        target: grounding.target.clone(),
    }
}

fn pair_of(grounding: &TokenGrounding) -> Option<(String, Direction)> {
    Some((grounding.reference.as_ref()?.replace(' ', "_"), direction_of(grounding)?))
}

/// None where the cell is empty: such a label is no pair.
fn direction_of(grounding: &TokenGrounding) -> Option<Direction> {
    Some(match grounding.direction.as_deref()? {
        "front" => Direction::Front,
        "back" | "behind" => Direction::Back,
        "left" => Direction::Left,
        "right" => Direction::Right,
        "center" | "central" => Direction::Central,
        "beside" | "side" => Direction::Side,
        "between" => Direction::Between,
        _ => return None,
    })
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
        let grounding = entry.into_gold().grounding.expect("labelled");
        assert_eq!(grounding.room.and_then(|room| room.name).as_deref(), Some("bedroom"));
        assert_eq!(grounding.object.map(|object| object.name).as_deref(), Some("cup"));
        assert_eq!(grounding.nodes.len(), 1);
        assert_eq!(grounding.nodes[0].target.as_deref(), Some("table"));
        assert_eq!(grounding.nodes[0].pairs[0].phrase(), "back of the couch");
    }
}

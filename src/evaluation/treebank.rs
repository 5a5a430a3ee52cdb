//! Gold from treebanks as JSON lines: chunks by token, and the authors' label of each chunk.

use serde::{Deserialize, Serialize};

use super::gold::{Gold, Rules};
use crate::grounding::paper::Label;
use crate::record::{Chunk, Direction, Tag, Token};

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
        Gold {
            brackets: self.chunks.iter().filter_map(|c| Some((tag_of(&c.tag)?, c.start, c.end))).collect(),
            chunks: nested(&self.chunks, &tokens),
            labels: self.groundings.iter().map(label_of).collect(),
            tokens,
            has_grounding: !self.groundings.is_empty(),
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
        let mut at = 0;
        let token = |(text, pos): &(String, String)| {
            let start = at;
            at += text.len() + 1;
            Token { text: text.clone(), pos: pos.clone(), start, end: start + text.len() }
        };
        self.tokens.iter().map(token).collect()
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

/// The tree over bytes of chunks over tokens in pre-order; chunks that do not fit the tokens are left out.
fn nested(chunks: &[TokenChunk], tokens: &[Token]) -> Vec<Chunk> {
    let mut open: Vec<(usize, Chunk)> = Vec::new();
    let mut roots = Vec::new();
    fn close(open: &mut Vec<(usize, Chunk)>, roots: &mut Vec<Chunk>, depth: usize) {
        while open.last().is_some_and(|(known, _)| *known >= depth) {
            let Some((_, chunk)) = open.pop() else { return };
            open.last_mut().map_or(&mut *roots, |(_, parent)| &mut parent.chunks).push(chunk);
        }
    }
    for chunk in chunks {
        let ends = (tokens.get(chunk.start), chunk.end.checked_sub(1).and_then(|last| tokens.get(last)));
        let (Some(tag), (Some(first), Some(last))) = (tag_of(&chunk.tag), ends) else { continue };
        close(&mut open, &mut roots, chunk.depth);
        let made = Chunk { tag, start: first.start, end: last.end, rule: None, chunks: Vec::new() };
        open.push((chunk.depth, made));
    }
    close(&mut open, &mut roots, 0);
    roots
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

//! What `ground` adds: `grounding`.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Direction, Frame, Motion, Reference, Rounded, Tag};

/// What the robot understood: room, RDT nodes and object of the best reading.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Grounding {
    /// The room as said; null when nothing was said of it.
    pub room: Option<RoomSlot>,
    /// The object to find; null when none was named.
    pub object: Option<ObjectSlot>,
    /// Reference–direction–target nodes, in the order spoken.
    pub nodes: Vec<Node>,
    /// Further objects of the same errand.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub also: Vec<ObjectSlot>,
    /// Where the objects shall be brought or put; absent when nowhere.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub destination: Option<Destination>,
    /// What is ruled out.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub not: Vec<RuledOut>,
    /// Further errands, in the order said.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub then: Vec<Grounding>,
    /// Confidence in the best whole reading, 0 to 1.
    #[serde(default)]
    pub score: Rounded,
    /// Its lead over the next reading, 0 to 1.
    #[serde(default)]
    pub margin: Rounded,
    /// The next best whole readings.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub readings: Vec<Reading>,
    /// The one question that would settle an ambiguity.
    #[serde(default)]
    pub question: Option<String>,
    /// Content words that changed nothing.
    #[serde(default)]
    pub unused: Vec<TextSpan>,
    /// What the score was charged for, and how often: words left out, nouns nobody knows, corrections and the like.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub doubts: BTreeMap<String, f64>,
    /// What made the reading doubtful or changed it: a negation, a correction.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
    /// What is missing, when the record could not be grounded.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub problems: Vec<String>,
    /// Per chunk: what it was taken for and why.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub why: Vec<Why>,
}

/// Where objects shall be brought or put.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Destination {
    /// Who shall have them: `speaker`, or a name or description in lower_snake.
    pub recipient: Option<String>,
    /// The room.
    pub room: Option<String>,
    /// Noun of the furniture or container, in lower_snake.
    pub target: Option<String>,
}

impl Destination {
    /// Whether nothing was said of it.
    pub fn is_empty(&self) -> bool {
        self.recipient.is_none() && self.room.is_none() && self.target.is_none()
    }

    /// The goal in words: "to the counter in the kitchen", "back to the speaker".
    pub fn phrase(&self) -> String {
        let spoken = |name: &String| name.replace('_', " ");
        let mut parts: Vec<String> = Vec::new();
        match self.recipient.as_deref() {
            Some("speaker") => parts.push("back to the speaker".to_string()),
            Some(name) => parts.push(format!("to {}", name.replace('_', " "))),
            None => {}
        }
        parts.extend(self.target.as_ref().map(|target| format!("to the {}", spoken(target))));
        parts.extend(self.room.as_ref().map(|room| {
            if self.target.is_none() && self.recipient.is_none() {
                format!("to the {}", spoken(room))
            } else {
                format!("in the {}", spoken(room))
            }
        }));
        parts.join(" ")
    }
}

/// What `ground` doubted, for stages that come later: its warnings and its question.
///
/// # Errors
/// When the record's `grounding` is none.
pub fn doubts_of(record: &super::Record) -> Result<Vec<String>, super::FieldError> {
    let grounding: Option<Grounding> = record.get("grounding")?;
    Ok(grounding.map_or_else(Vec::new, |grounding| {
        let further = grounding.then.into_iter().flat_map(|next| next.warnings);
        grounding.warnings.into_iter().chain(further).chain(grounding.question).collect()
    }))
}

/// Something that is ruled out.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct RuledOut {
    /// A noun or the name of a room, in lower_snake.
    pub name: String,
}

/// A whole reading that lost to the best one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Reading {
    /// The room as said.
    pub room: Option<RoomSlot>,
    /// The object to find.
    pub object: Option<ObjectSlot>,
    /// Reference–direction–target nodes.
    pub nodes: Vec<Node>,
    /// Confidence, 0 to 1.
    pub score: Rounded,
    /// How it differs from the best reading.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub because: Option<String>,
}

/// The room: by name, by side, or both.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RoomSlot {
    /// `living_room`, `bedroom`, …, when said.
    pub name: Option<String>,
    /// The side that picks the room, when said.
    pub side: Option<Direction>,
    /// "The second door": which of several, counted from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ordinal: Option<u32>,
    /// Confidence, 0 to 1.
    #[serde(default)]
    pub score: Rounded,
}

/// The object to find.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ObjectSlot {
    /// Head noun in lower_snake.
    pub name: String,
    /// Colour, size and the like, as said.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub attributes: Vec<String>,
    /// Confidence, 0 to 1.
    #[serde(default)]
    pub score: Rounded,
}

/// One reference–direction–target node: a target furniture, or a step without one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Node {
    /// Noun of the target furniture in lower_snake; null for a step without one.
    pub target: Option<String>,
    /// Colour, size, shape and material of the target, as said.
    #[serde(default)]
    pub attributes: Vec<String>,
    /// "The second table": counted from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ordinal: Option<u32>,
    /// References and directions in the order spoken.
    pub pairs: Vec<Pair>,
    /// Confidence, 0 to 1.
    #[serde(default)]
    pub score: Rounded,
}

/// A reference and the direction from it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "PairAsWritten")]
#[schemars(!try_from)]
pub struct Pair {
    /// What the direction is told from.
    pub reference: Reference,
    /// Where, seen from the reference.
    pub direction: Direction,
    /// The axes in which the direction is read; the likeliest when there are several.
    pub frame: Frame,
    /// The second reference of `between`; without it, between several things of the first one's noun.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub and: Option<Reference>,
    /// How far, or until what.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub amount: Option<Amount>,
    /// "The second chair": counted from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ordinal: Option<u32>,
}

/// A pair as it stands in a record, before it is seen whether it can be meant.
#[derive(Deserialize)]
struct PairAsWritten {
    reference: Reference,
    direction: Direction,
    frame: Frame,
    #[serde(default)]
    and: Option<Reference>,
    #[serde(default)]
    amount: Option<Amount>,
    #[serde(default)]
    ordinal: Option<u32>,
}

impl TryFrom<PairAsWritten> for Pair {
    type Error = String;

    fn try_from(pair: PairAsWritten) -> Result<Self, String> {
        let PairAsWritten { reference, direction, frame, and, amount, ordinal } = pair;
        if reference == Reference::Move && Motion::from_direction(direction).is_none() {
            return Err(format!(
                "a move goes front, or turns left, right or back; `{}` is none of them",
                direction.name()
            ));
        }
        if direction == Direction::Between && and.is_none() && reference.thing().is_none() {
            return Err(format!("`between` needs two references: name the other beside `{reference}` in `and`"));
        }
        Ok(Self { reference, direction, frame, and, amount, ordinal })
    }
}

impl Pair {
    /// The pair in words: "back of the couch".
    pub fn phrase(&self) -> String {
        let reference = self.reference.words();
        match (self.direction, &self.and) {
            (Direction::Between, Some(and)) => format!("between the {reference} and the {}", and.words()),
            (Direction::Between, None) => format!("between the {reference}s"),
            (Direction::Side, _) => format!("next to the {reference}"),
            (Direction::Above, _) => format!("above the {reference}"),
            (Direction::Under, _) => format!("under the {reference}"),
            (Direction::Far, _) => format!("far from the {reference}"),
            (direction, _) => format!("{} of the {reference}", direction.name()),
        }
    }
}

/// How far a move goes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Amount {
    /// A share of the room's depth, 0 to 1.
    Fraction(f64),
    /// Metres.
    Meters(f64),
    /// Human steps of about 0.7 m.
    Steps(f64),
    /// A turn in degrees.
    Degrees(f64),
    /// Until something is reached: `wall`, `door`, `room`, or a noun.
    Until(Reference),
}

impl Amount {
    /// The amount in words: "until the wall".
    pub fn phrase(&self) -> String {
        match self {
            Self::Fraction(share) => format!("{:.0} % of the way", share * 100.0),
            Self::Meters(metres) => format!("{metres} m"),
            Self::Steps(steps) => format!("{steps} steps"),
            Self::Degrees(degrees) => format!("{degrees}°"),
            Self::Until(what) => format!("until the {}", what.words()),
        }
    }
}

/// A piece of the text.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TextSpan {
    /// The words.
    pub text: String,
    /// First byte in `text`.
    pub start: usize,
    /// One past the last byte in `text`.
    pub end: usize,
}

/// What one chunk was taken for, and why.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Why {
    /// First byte in `text`.
    pub start: usize,
    /// One past the last byte in `text`.
    pub end: usize,
    /// The chunk's kind.
    pub tag: Tag,
    /// The type the paper's step 1 gives: `target_room`, `inside_room_navigation`, `target_object`.
    #[serde(rename = "type", default, skip_serializing_if = "Option::is_none")]
    pub kind: Option<String>,
    /// Room, when the chunk names one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub room: Option<String>,
    /// Object, when the chunk names one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub object: Option<String>,
    /// Reference, when the chunk gives one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reference: Option<String>,
    /// Direction, when the chunk gives one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direction: Option<Direction>,
    /// Target furniture, when the chunk names one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub target: Option<String>,
    /// Confidence, 0 to 1.
    #[serde(default)]
    pub score: Rounded,
    /// In words: the rule or nearest example, every factor, the runner-up.
    pub because: String,
}

//! What `ground` adds: `grounding`.

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

//! What one chunk means.

use serde::{Deserialize, Serialize};

use crate::language::Lexicon;
use crate::record::{Amount, Direction, Frame, Pair, Reference, Tag};

/// What a chunk is about: step 1 of the published method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// The room to enter.
    TargetRoom,
    /// Places, moves, furniture.
    InsideRoomNavigation,
    /// The object to find.
    TargetObject,
}

impl Kind {
    /// The name as it stands in records.
    pub const fn name(self) -> &'static str {
        match self {
            Self::TargetRoom => "target_room",
            Self::InsideRoomNavigation => "inside_room_navigation",
            Self::TargetObject => "target_object",
        }
    }
}

/// The meaning of one chunk's own words, without those of the chunks inside it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Meaning {
    /// The type of step 1, where the method has one.
    pub kind: Option<Kind>,
    /// Room named.
    pub room: Option<String>,
    /// Side that picks the room.
    pub side: Option<Direction>,
    /// Object named.
    pub object: Option<String>,
    /// Whether the object came with "a": one among others, not the one asked for.
    pub indefinite: bool,
    /// Target furniture.
    pub target: Option<String>,
    /// Colour, size, shape.
    pub attributes: Vec<String>,
    /// "The second".
    pub ordinal: Option<u32>,
    /// References and directions, usually one.
    pub pairs: Vec<Pair>,
    /// "As you face it": the pair before is seen by someone who stands before the item and looks at it.
    pub facing: bool,
    /// How sure, 0 to 1.
    pub score: f64,
    /// In words, why.
    pub because: String,
}

/// A pair in its likeliest frame.
pub fn pair(reference: &str, direction: Direction) -> Pair {
    let reference = Reference::of(reference);
    Pair { frame: likeliest_frame(&reference), reference, direction, and: None, amount: None, ordinal: None }
}

/// The hearer and motions are read from the robot, what has a front of its own by that, all else as on entering.
fn likeliest_frame(reference: &Reference) -> Frame {
    match reference {
        Reference::Move | Reference::Robot => Frame::Robot,
        Reference::Thing(noun) if Lexicon::embedded().has_own_front(noun) => Frame::Intrinsic,
        _ => Frame::Viewer,
    }
}

/// The meaning a gold label gives a chunk: a side or a room, a noun, or `reference/direction`, several with commas.
pub fn meaning_of_label(tag: Tag, label: Option<&str>) -> Meaning {
    let mut meaning = Meaning { score: 1.0, because: "labelled".to_string(), ..Meaning::default() };
    let Some(label) = label else { return meaning };
    match tag {
        Tag::Ormtp | Tag::Ormrp => match direction_of(label) {
            Some(side) => meaning.side = Some(side),
            None => meaning.room = Some(label.to_string()),
        },
        Tag::Obtp => meaning.object = Some(label.to_string()),
        Tag::Furtp => meaning.target = Some(label.to_string()),
        _ => {
            let pairs = label.split(',').filter_map(|pair| pair.split_once('/'));
            meaning.pairs = pairs.filter_map(|(reference, name)| Some(pair(reference, direction_of(name)?))).collect();
        }
    }
    meaning
}

fn direction_of(name: &str) -> Option<Direction> {
    Direction::from_name(name)
}

impl Meaning {
    /// A meaning that is one pair.
    pub fn of_pair(reference: &str, direction: Direction, because: impl Into<String>) -> Self {
        Self { pairs: vec![pair(reference, direction)], score: 0.9, because: because.into(), ..Self::default() }
    }

    /// The same with an amount.
    pub fn with_amount(mut self, amount: Option<Amount>) -> Self {
        if let Some(pair) = self.pairs.first_mut() {
            pair.amount = amount;
        }
        self
    }
}

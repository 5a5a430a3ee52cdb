//! A phrase: a stretch of the text with what it means.

use super::noun_phrases::NounPhrase;
use super::relations::Relation;
use super::unit::Unit;
use super::word_class::{Class, Role};
use crate::record::{Amount, Direction};

/// What a phrase is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A move ahead, up to its stated end.
    Go,
    /// A change of heading.
    Turn,
    /// A room or a door to a room; `inner` is the words that pick it by side.
    Room,
    /// A room that is left or passed.
    Leave,
    /// A place relative to the hearer.
    Side,
    /// A part of the room, a wall, the door; `inner` is the move that leads there.
    Part,
    /// Furniture that holds the object or is gone to; `inner` is the move that leads there.
    Target,
    /// Furniture as landmark; `inner` is the move past it.
    Landmark,
    /// An object as landmark, or one that holds the object.
    ObjectMark,
    /// The head of a clause about the object.
    Object,
    /// Who shall have the object.
    Recipient,
    /// Whose view a direction is said from.
    Perspective,
    /// A self-correction.
    Correction,
    /// What a correction took back.
    Corrected,
    /// What follows is ruled out.
    Not,
    /// What was ruled out.
    RuledOut,
    /// The end of a sentence.
    Stop,
    /// Words that mean nothing here.
    Aside,
}

/// What a clause about an object does with it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Act {
    /// Nothing of the kind.
    #[default]
    None,
    /// Says where it is.
    State,
    /// "There is": brings in something.
    There,
    /// Find it.
    Find,
    /// Bring it.
    Fetch,
    /// Give it to somebody.
    Give,
    /// Put it somewhere.
    Put,
    /// Something else: open, clean.
    Other,
    /// "Look down".
    LookDown,
}

impl Act {
    /// Whether it moves the object to another place.
    pub fn delivers(self) -> bool {
        matches!(self, Self::Fetch | Self::Give | Self::Put)
    }

    /// Whether it asks for something to be done.
    pub fn is_request(self) -> bool {
        matches!(self, Self::Find | Self::Fetch | Self::Give | Self::Put | Self::Other)
    }
}

/// What a place is told from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum From {
    /// Nothing.
    #[default]
    Nothing,
    /// The robot's own motion.
    Move,
    /// The hearer.
    Robot,
    /// The room.
    Room,
    /// A wall.
    Wall,
    /// A door.
    Door,
    /// The furniture named before.
    It,
    /// The nouns of the phrase.
    Nouns,
}

/// Who shall have an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Recipient {
    /// Who speaks.
    Speaker,
    /// Whom the unit of that number names.
    Person(usize),
}

/// A stretch of units with what it means.
#[derive(Clone, Debug, PartialEq)]
pub struct Phrase {
    /// What it is about.
    pub kind: Kind,
    /// First unit.
    pub first: usize,
    /// One past the last unit.
    pub past: usize,
    /// A phrase inside it.
    pub inner: Option<(usize, usize)>,
    /// The pattern that made it.
    pub rule: &'static str,
    /// What the clause does with its object.
    pub act: Act,
    /// What a place is told from.
    pub from: From,
    /// The directions, one or two.
    pub directions: [Option<Direction>; 2],
    /// How its words relate to the nouns.
    pub relation: Option<Relation>,
    /// Its nouns.
    pub nouns: Vec<NounPhrase>,
    /// The left or right that picks a room.
    pub side: Option<Direction>,
    /// Who shall have the object.
    pub recipient: Option<Recipient>,
    /// How far, or until what.
    pub amount: Option<Amount>,
    /// It tells what the furniture before it holds.
    pub held: bool,
    /// It says when the room is entered: "as soon as you walk in".
    pub entering: bool,
}

impl Phrase {
    /// Whether a move leads there.
    pub fn is_reached(&self) -> bool {
        self.inner.is_some() && matches!(self.kind, Kind::Part | Kind::Target | Kind::Landmark | Kind::ObjectMark)
    }

    /// Whether the robot is told to move there itself: "go to the kitchen".
    pub fn is_moved(&self, units: &[Unit]) -> bool {
        let first = &units[self.first];
        first.has(Role::Motion) && !first.has(Role::Put) || first.has(Role::Enter) || first.has(Role::Turn)
    }

    /// The first noun.
    pub fn noun(&self) -> Option<&NounPhrase> {
        self.nouns.first()
    }
}

/// Furniture that a robot may be asked to carry: lamps and plants.
pub(super) fn can_be_carried(noun: &NounPhrase) -> bool {
    matches!(noun.class, Some(Class::Lamp | Class::Plant))
}

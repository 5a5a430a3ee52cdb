//! The kinds of things that the vocabulary tells apart, and what each is to the grammar.

use crate::language::Class;

/// What a noun of the vocabulary most likely names; see `corpus/vocabulary/classes.tsv`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum NounClass {
    TableLike,
    Seat,
    Couch,
    Bed,
    Storage,
    Lamp,
    Appliance,
    Screen,
    /// Furniture of no kind above.
    Furniture,
    Structure,
    Opening,
    Room,
    Container,
    Utensil,
    Food,
    Drink,
    Tool,
    Garment,
    Toy,
    Electronics,
    Stationery,
    Medicine,
    Plant,
    Animal,
    Person,
    BodyPart,
    /// Any other thing that is made.
    Artifact,
}

impl NounClass {
    /// The class of that name in `nouns.tsv`.
    pub(super) fn from_name(name: &str) -> Option<Self> {
        Some(match name {
            "table_like" => Self::TableLike,
            "seat" => Self::Seat,
            "couch" => Self::Couch,
            "bed" => Self::Bed,
            "storage" => Self::Storage,
            "lamp" => Self::Lamp,
            "appliance" => Self::Appliance,
            "screen" => Self::Screen,
            "furniture" => Self::Furniture,
            "structure" => Self::Structure,
            "opening" => Self::Opening,
            "room" => Self::Room,
            "container" => Self::Container,
            "utensil" => Self::Utensil,
            "food" => Self::Food,
            "drink" => Self::Drink,
            "tool" => Self::Tool,
            "garment" => Self::Garment,
            "toy" => Self::Toy,
            "electronics" => Self::Electronics,
            "stationery" => Self::Stationery,
            "medicine" => Self::Medicine,
            "plant" => Self::Plant,
            "animal" => Self::Animal,
            "person" => Self::Person,
            "body_part" => Self::BodyPart,
            "artifact" => Self::Artifact,
            _ => return None,
        })
    }

    /// What the grammar and the search make of it; nothing for people and parts of their bodies, which are neither
    /// landmarks nor things to fetch.
    pub fn class(self) -> Option<Class> {
        Some(match self {
            Self::TableLike => Class::TableLike,
            Self::Seat => Class::Seat,
            Self::Couch => Class::Couch,
            Self::Bed => Class::Bed,
            Self::Storage | Self::Furniture => Class::Storage,
            Self::Lamp => Class::Lamp,
            Self::Appliance => Class::Appliance,
            Self::Screen => Class::Screen,
            Self::Structure => Class::Structure,
            Self::Opening => Class::Opening,
            Self::Room => Class::Room,
            Self::Plant => Class::Plant,
            Self::Person | Self::BodyPart => return None,
            _ => Class::Object,
        })
    }

    /// Whether it can hold other things: "a bowl of soup" is a bowl.
    pub fn is_container(self) -> bool {
        matches!(self, Self::Container | Self::Utensil)
    }
}

//! What kinds of words the lexicon's files tell apart.

/// What kind of thing a noun names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Class {
    /// Table, desk, nightstand, counter: where people put small things.
    TableLike,
    /// Chair, stool, bench.
    Seat,
    /// Couch, sofa.
    Couch,
    /// Bed.
    Bed,
    /// Dresser, wardrobe, shelf, cabinet.
    Storage,
    /// Lamp.
    Lamp,
    /// Fridge, sink, fan.
    Appliance,
    /// Things with a screen that stand like furniture.
    Screen,
    /// Plants.
    Plant,
    /// Window, fireplace, stairs.
    Structure,
    /// The wall.
    Wall,
    /// Door, entrance.
    Opening,
    /// Rooms.
    Room,
    /// Corner.
    Part,
    /// Portable objects.
    Object,
}

impl Class {
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
            "plant" => Self::Plant,
            "structure" => Self::Structure,
            "wall" => Self::Wall,
            "opening" => Self::Opening,
            "room" => Self::Room,
            "part" => Self::Part,
            "object" => Self::Object,
            _ => return None,
        })
    }

    /// Whether it stands in a room and can be a landmark or hold things.
    pub fn is_furniture(self) -> bool {
        !matches!(self, Self::Wall | Self::Opening | Self::Room | Self::Part | Self::Object)
    }
}

/// How the grammar uses a word that is no noun.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum Role {
    Filler,
    Addressee,
    Conjunction,
    Determiner,
    Pronoun,
    Hearer,
    Copula,
    Modal,
    Has,
    Motion,
    Turn,
    Look,
    Reach,
    Find,
    Bring,
    Ahead,
    Side,
    SideWord,
    Part,
    Extent,
    Again,
    Until,
    Preposition,
    Adjective,
    Number,
    Ordinal,
    Step,
    FootUnit,
    MetreUnit,
    DegreeUnit,
    Correction,
    Doubt,
    Negation,
    There,
    Lying,
    Adverb,
    Generic,
}

impl Role {
    pub(super) fn from_name(name: &str) -> Option<Self> {
        Some(match name {
            "filler" => Self::Filler,
            "addressee" => Self::Addressee,
            "conjunction" => Self::Conjunction,
            "determiner" => Self::Determiner,
            "pronoun" => Self::Pronoun,
            "hearer" => Self::Hearer,
            "copula" => Self::Copula,
            "modal" => Self::Modal,
            "has" => Self::Has,
            "motion" => Self::Motion,
            "turn" => Self::Turn,
            "look" => Self::Look,
            "reach" => Self::Reach,
            "find" => Self::Find,
            "bring" => Self::Bring,
            "ahead" => Self::Ahead,
            "side" => Self::Side,
            "sideword" => Self::SideWord,
            "part" => Self::Part,
            "extent" => Self::Extent,
            "again" => Self::Again,
            "until" => Self::Until,
            "preposition" => Self::Preposition,
            "adjective" => Self::Adjective,
            "number" => Self::Number,
            "ordinal" => Self::Ordinal,
            "step" => Self::Step,
            "foot-unit" => Self::FootUnit,
            "metre-unit" => Self::MetreUnit,
            "degree-unit" => Self::DegreeUnit,
            "correction" => Self::Correction,
            "doubt" => Self::Doubt,
            "negation" => Self::Negation,
            "there" => Self::There,
            "lying" => Self::Lying,
            "adverb" => Self::Adverb,
            "generic" => Self::Generic,
            _ => return None,
        })
    }
}

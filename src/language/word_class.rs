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
    /// People and animals.
    Person,
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
            "person" => Self::Person,
            _ => return None,
        })
    }

    /// Whether it stands in a room and can be a landmark or hold things.
    pub fn is_furniture(self) -> bool {
        !matches!(self, Self::Wall | Self::Opening | Self::Room | Self::Part | Self::Object | Self::Person)
    }
}

/// How the grammar uses a word that is no noun; `corpus/grammar/README.md` says what each is for.
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
    Enter,
    Exit,
    Find,
    Bring,
    Give,
    Put,
    Act,
    Want,
    Ahead,
    Side,
    SideWord,
    Part,
    Near,
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
    Person,
    Container,
    Relative,
}

/// Every role with its name in the files.
const ROLES: [(&str, Role); 47] = [
    ("filler", Role::Filler),
    ("addressee", Role::Addressee),
    ("conjunction", Role::Conjunction),
    ("determiner", Role::Determiner),
    ("pronoun", Role::Pronoun),
    ("hearer", Role::Hearer),
    ("copula", Role::Copula),
    ("modal", Role::Modal),
    ("has", Role::Has),
    ("motion", Role::Motion),
    ("turn", Role::Turn),
    ("look", Role::Look),
    ("reach", Role::Reach),
    ("enter", Role::Enter),
    ("exit", Role::Exit),
    ("find", Role::Find),
    ("bring", Role::Bring),
    ("give", Role::Give),
    ("put", Role::Put),
    ("act", Role::Act),
    ("want", Role::Want),
    ("ahead", Role::Ahead),
    ("side", Role::Side),
    ("sideword", Role::SideWord),
    ("part", Role::Part),
    ("near", Role::Near),
    ("extent", Role::Extent),
    ("again", Role::Again),
    ("until", Role::Until),
    ("preposition", Role::Preposition),
    ("adjective", Role::Adjective),
    ("number", Role::Number),
    ("ordinal", Role::Ordinal),
    ("step", Role::Step),
    ("foot-unit", Role::FootUnit),
    ("metre-unit", Role::MetreUnit),
    ("degree-unit", Role::DegreeUnit),
    ("correction", Role::Correction),
    ("doubt", Role::Doubt),
    ("negation", Role::Negation),
    ("there", Role::There),
    ("lying", Role::Lying),
    ("adverb", Role::Adverb),
    ("generic", Role::Generic),
    ("person", Role::Person),
    ("container", Role::Container),
    ("relative", Role::Relative),
];

impl Role {
    pub(super) fn from_name(name: &str) -> Option<Self> {
        ROLES.iter().find(|(own, _)| *own == name).map(|(_, role)| *role)
    }
}

/// The roles a word may have: "left" is a side, "light" an adjective as well as a noun.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Roles(u64);

impl Roles {
    /// One role.
    pub const fn of(role: Role) -> Self {
        Self(1 << role as u64)
    }

    /// Both sets together.
    pub const fn with(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Whether the sets share a role.
    pub const fn meet(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }

    /// Whether the role is among them.
    pub const fn has(self, role: Role) -> bool {
        self.meet(Self::of(role))
    }

    /// Whether the role of that number is among them.
    pub const fn has_bit(self, bit: usize) -> bool {
        self.0 >> bit & 1 != 0
    }

    /// The numbers of the roles.
    pub fn bits(self) -> impl Iterator<Item = usize> {
        let mut left = self.0;
        std::iter::from_fn(move || {
            let bit = (left != 0).then(|| left.trailing_zeros() as usize)?;
            left &= left - 1;
            Some(bit)
        })
    }

    /// Whether there is none.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }
}

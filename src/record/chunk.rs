//! What `chunk` adds: `tokens` and `chunks`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A word of the text with its part of speech.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Token {
    /// The word as it stands in the text.
    pub text: String,
    /// Penn Treebank tag, or one of DIR, FUR, RM, STR, ON, IGN, WHO.
    pub pos: String,
    /// First byte in `text`.
    pub start: usize,
    /// One past the last byte in `text`.
    pub end: usize,
}

/// A phrase of the description: what kind, where, and the phrases inside it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Chunk {
    /// The kind of phrase.
    pub tag: Tag,
    /// First byte in `text`.
    pub start: usize,
    /// One past the last byte in `text`.
    pub end: usize,
    /// The rule that made it, when asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rule: Option<String>,
    /// The phrases inside, in the order spoken.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub chunks: Vec<Chunk>,
}

/// The nine kinds of phrase (Huo et al. 2014, section III; the last three occur in human speech only).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "UPPERCASE")]
pub enum Tag {
    /// Out of room, target: reach or name the target room.
    Ormtp,
    /// Out of room, reference: which room.
    Ormrp,
    /// Inside room, reference: a place or move inside the room.
    Irmrp,
    /// Furniture, target: the furniture that holds the object.
    Furtp,
    /// Furniture, reference: furniture as a landmark.
    Furrp,
    /// Object, target: the object to fetch.
    Obtp,
    /// Object, reference: an object as a landmark.
    Obrp,
    /// Whose view.
    Pers,
    /// Doubt or self-correction.
    Conf,
}

impl Tag {
    /// All nine, in the order of the table in `docs/annotation.md`.
    pub const ALL: [Self; 9] = [
        Self::Ormtp,
        Self::Ormrp,
        Self::Irmrp,
        Self::Furtp,
        Self::Furrp,
        Self::Obtp,
        Self::Obrp,
        Self::Pers,
        Self::Conf,
    ];

    /// The name as it stands in records and corpora.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ormtp => "ORMTP",
            Self::Ormrp => "ORMRP",
            Self::Irmrp => "IRMRP",
            Self::Furtp => "FURTP",
            Self::Furrp => "FURRP",
            Self::Obtp => "OBTP",
            Self::Obrp => "OBRP",
            Self::Pers => "PERS",
            Self::Conf => "CONF",
        }
    }

    /// The tag of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|tag| tag.name() == name)
    }
}

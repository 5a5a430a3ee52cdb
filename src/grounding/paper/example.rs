//! Labelled trees to learn from: records of a corpus with `chunks` and `groundings`.

use serde::{Deserialize, Serialize};

use crate::grounding::meaning::{Kind, Meaning, pair};
use crate::grounding::words::chunk_words_of;
use crate::language::tokens::tokenize;
use crate::language::{Lexicon, tag_words, units};
use crate::record::{Chunk, Direction, Record, Tag, Token};

/// What a chunk means, as a corpus labels it; all empty for a chunk that means nothing by itself.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(default)]
pub struct Label {
    /// Room: a name, or the side `left` or `right` that picks it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub room: Option<String>,
    /// Object to find.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub object: Option<String>,
    /// Reference of the pair.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reference: Option<String>,
    /// Direction of the pair.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction: Option<Direction>,
    /// Target furniture.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub target: Option<String>,
}

/// A chunk with its own words (without those of the chunks in it), its place in the tree and its label.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LabelledChunk {
    /// The kind of phrase.
    pub tag: Tag,
    /// Own words in lower case, each with its part of speech.
    pub words: Vec<(String, String)>,
    /// Tag of the chunk around it.
    pub parent: Option<Tag>,
    /// Tags of the chunks in it, sorted, each once.
    pub children: Vec<Tag>,
    /// What it means.
    #[serde(default)]
    pub label: Label,
}

/// A description whose chunks are labelled, in pre-order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LabelledTree {
    /// The chunks.
    pub chunks: Vec<LabelledChunk>,
}

/// Why a record cannot be learnt from.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct TrainingError(pub String);

impl Label {
    /// The type of step 1; by the tag where the label is empty.
    pub fn kind(&self, tag: Tag) -> Kind {
        if self.room.is_some() {
            return Kind::TargetRoom;
        }
        if self.object.is_some() {
            return Kind::TargetObject;
        }
        if self.reference.is_some() || self.direction.is_some() || self.target.is_some() {
            return Kind::InsideRoomNavigation;
        }
        match tag {
            Tag::Ormtp | Tag::Ormrp => Kind::TargetRoom,
            Tag::Obtp => Kind::TargetObject,
            _ => Kind::InsideRoomNavigation,
        }
    }

    /// The same as a meaning with its score and reason.
    pub fn meaning(&self, score: f64, because: String) -> Meaning {
        let side = match self.room.as_deref() {
            Some("left") => Some(Direction::Left),
            Some("right") => Some(Direction::Right),
            _ => None,
        };
        let room = self.room.as_ref().filter(|_| side.is_none()).map(|name| name.replace(' ', "_"));
        let pairs = match (&self.reference, self.direction) {
            (Some(reference), Some(direction)) => vec![pair(&reference.replace(' ', "_"), direction)],
            _ => Vec::new(),
        };
        let name = |noun: &Option<String>| noun.as_ref().map(|noun| noun.replace(' ', "_"));
        Meaning {
            room,
            side,
            object: name(&self.object),
            target: name(&self.target),
            pairs,
            score,
            because,
            ..Meaning::default()
        }
    }
}

impl LabelledTree {
    /// The tree over `text`, without labels; parts of speech from `tokens`, or by the lexicon where there are none.
    pub fn unlabelled(text: &str, tokens: &[Token], chunks: &[Chunk]) -> Self {
        let words = tokenize(text);
        let tagged;
        let tokens = if tokens.is_empty() {
            let lexicon = Lexicon::embedded();
            tagged = tag_words(&words, &units(&words, lexicon), lexicon);
            &tagged
        } else {
            tokens
        };
        let part_of_speech = |start: usize| {
            let at = tokens.partition_point(|token| token.end <= start);
            tokens.get(at).map_or("", |token| token.pos.as_str()).to_string()
        };
        let flat = chunk_words_of(&words, chunks);
        let labelled = flat.iter().map(|chunk| {
            let mut children: Vec<Tag> = chunk.children.iter().map(|&child| flat[child].tag).collect();
            children.sort_unstable();
            children.dedup();
            LabelledChunk {
                tag: chunk.tag,
                words: chunk.words.iter().map(|w| (w.lower.to_string(), part_of_speech(w.start))).collect(),
                parent: chunk.parent.map(|parent| flat[parent].tag),
                children,
                label: Label::default(),
            }
        });
        Self { chunks: labelled.collect() }
    }

    /// The tree of a record with `text`, `chunks` and, in pre-order, `groundings`.
    ///
    /// # Errors
    /// When a key is missing, is not what it should be, or chunks and groundings are not as many.
    pub fn from_record(record: &Record) -> Result<Self, TrainingError> {
        let wrong = |error: crate::record::FieldError| TrainingError(error.to_string());
        let text: String = record.require("text", "a labelled record needs the description").map_err(wrong)?;
        let chunks: Vec<Chunk> = record.require_part("a labelled record needs its tree").map_err(wrong)?;
        let labels: Vec<Label> =
            record.require("groundings", "a labelled record needs one label per chunk, in pre-order").map_err(wrong)?;
        let tokens: Vec<Token> = record.part().map_err(wrong)?.unwrap_or_default();
        let mut tree = Self::unlabelled(&text, &tokens, &chunks);
        if tree.chunks.len() != labels.len() {
            return Err(TrainingError(format!(
                "`groundings`: {} labels for {} chunks; give one per chunk, in pre-order",
                labels.len(),
                tree.chunks.len()
            )));
        }
        for (chunk, label) in tree.chunks.iter_mut().zip(labels) {
            chunk.label = label;
        }
        Ok(tree)
    }
}

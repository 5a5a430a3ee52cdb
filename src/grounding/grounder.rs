//! Grounds a chunk tree by either method.

use std::sync::Arc;

use super::composed::{meaning_of, settle_target};
use super::meaning::pair;
use super::paper::{LabelledTree, Model};
use super::readings;
use super::words::{ChunkWords, chunk_words_of};
use super::{Meaning, assemble};
use crate::language::tokens::{Word, tokenize};
use crate::language::{Class, Lexicon, Role, Unit, UnitKind, units};
use crate::record::{Chunk, Grounding, Reference, Tag, TextSpan, Token, Why};

/// How chunks get their meaning.
#[derive(Clone, Debug, Default)]
pub enum Method {
    /// From what the words mean.
    #[default]
    Composed,
    /// From the nearest labelled example, by the published equations.
    Paper(Arc<Model>),
}

/// Grounds descriptions.
#[derive(Clone, Debug)]
pub struct Grounder {
    method: Method,
    lexicon: Arc<Lexicon>,
    brief: bool,
}

impl Grounder {
    /// A grounder with the embedded lexicon; `brief` leaves out readings and reasons.
    pub fn new(method: Method, brief: bool) -> Self {
        Self::with_lexicon(method, brief, Arc::new(Lexicon::embedded().clone()))
    }

    /// A grounder with a lexicon of one's own.
    pub fn with_lexicon(method: Method, brief: bool, lexicon: Arc<Lexicon>) -> Self {
        Self { method, lexicon, brief }
    }

    /// The meaning of a chunk tree over `text`.
    ///
    /// `tokens` give the paper's method its parts of speech; they may be empty.
    pub fn ground(&self, text: &str, tokens: &[Token], chunks: &[Chunk]) -> Grounding {
        let words = tokenize(text);
        let tree = chunks;
        let chunks = chunk_words_of(&words, tree);
        let meanings = match &self.method {
            Method::Composed => self.composed(&words, &chunks),
            Method::Paper(model) => model.meanings(&LabelledTree::unlabelled(text, tokens, tree)),
        };
        let mut grounding = assemble(&chunks, &meanings);
        if matches!(self.method, Method::Composed) {
            settle_target(&mut grounding, &self.lexicon);
        }
        readings::score(&mut grounding);
        let units = units(&words, &self.lexicon);
        grounding.warnings = warnings(text, &units, &chunks);
        readings::rank(&mut grounding, &chunks, &meanings);
        if self.brief {
            grounding.readings.clear();
        } else {
            grounding.unused = unused(text, &words, &units, &chunks);
            grounding.why = chunks.iter().zip(&meanings).map(|(chunk, meaning)| why(chunk, meaning)).collect();
        }
        if grounding.room.is_none() && grounding.object.is_none() && grounding.nodes.is_empty() {
            grounding.score = 0.0.into();
            grounding.margin = 0.0.into();
            grounding.problems.push("no room, furniture, move or object was recognised in this text".to_string());
        }
        grounding
    }

    /// What each chunk of a tree means by itself, in pre-order.
    pub fn meanings(&self, text: &str, tokens: &[Token], chunks: &[Chunk]) -> Vec<(Tag, Meaning)> {
        let words = tokenize(text);
        let flat = chunk_words_of(&words, chunks);
        let meanings = match &self.method {
            Method::Composed => self.composed(&words, &flat),
            Method::Paper(model) => model.meanings(&LabelledTree::unlabelled(text, tokens, chunks)),
        };
        flat.iter().map(|chunk| chunk.tag).zip(meanings).collect()
    }

    fn composed(&self, words: &[Word], chunks: &[ChunkWords]) -> Vec<Meaning> {
        let meaning = |i: usize| meaning_of(&chunks[i], &self.lexicon, continues_move(i, words, chunks));
        let mut meanings: Vec<Meaning> = (0..chunks.len()).map(meaning).collect();
        resolve_it(chunks, &mut meanings, &self.lexicon);
        meanings
    }

    /// Whether the method looks at parts of speech.
    pub fn wants_tokens(&self) -> bool {
        matches!(self.method, Method::Paper(_))
    }

    /// The words it knows.
    pub fn lexicon(&self) -> &Lexicon {
        &self.lexicon
    }
}

/// "A couch, and behind it a table": what is behind it is behind the furniture named last, not behind the robot.
fn resolve_it(chunks: &[ChunkWords], meanings: &mut [Meaning], lexicon: &Lexicon) {
    let mut last: Option<String> = None;
    for (chunk, meaning) in chunks.iter().zip(meanings) {
        let it =
            chunk.words.windows(2).any(|two| matches!(two[0].lower.as_ref(), "behind" | "of") && two[1].lower == "it");
        if let Some(noun) =
            last.as_ref().filter(|_| it && meaning.pairs.iter().all(|pair| pair.reference == Reference::Robot))
        {
            meaning.pairs = meaning.pairs.iter().map(|of_it| pair(noun, of_it.direction)).collect();
            meaning.because.push_str(&format!("; \"it\" is the {}", noun.replace('_', " ")));
        }
        let furniture = |noun: &String| lexicon.class_of(noun).is_some_and(Class::is_furniture);
        let references = meaning.pairs.iter().filter_map(|pair| pair.reference.thing()).map(str::to_string);
        last = meaning.target.iter().cloned().chain(references).find(furniture).or(last);
    }
}

/// Whether a chunk outside all others follows a move or a turn with only "and", "then" between.
fn continues_move(index: usize, words: &[Word], chunks: &[ChunkWords]) -> bool {
    let chunk = &chunks[index];
    if chunk.tag != Tag::Irmrp || chunk.parent.is_some() || index == 0 {
        return false;
    }
    let Some(before) = chunks[..index].iter().rfind(|other| other.parent.is_none()) else { return false };
    let from = words.partition_point(|word| word.start < before.end);
    let past = words.partition_point(|word| word.start < chunk.start);
    let joins = |word: &Word| matches!(word.lower.as_ref(), "and" | "then" | "uh" | "um" | "so");
    let after = words.partition_point(|word| word.start < chunk.end);
    // "And to your left is a shelf" is no move.
    let told = words.get(after).is_some_and(|word| matches!(word.lower.as_ref(), "is" | "are" | "'s" | "there"));
    matches!(before.tag, Tag::Irmrp | Tag::Ormtp) && from < past && words[from..past].iter().all(joins) && !told
}

fn warnings(text: &str, units: &[Unit], chunks: &[ChunkWords]) -> Vec<String> {
    let mut warnings = Vec::new();
    if let Some(at) = units.iter().position(|unit| unit.role() == Some(Role::Negation)) {
        let noun = units[at..].iter().find(|unit| unit.class().is_some_and(Class::is_furniture));
        let about = noun.map_or(String::new(), |noun| format!(" (\"{} … {}\")", units[at].lower, noun.lower));
        warnings.push(format!("a negation was heard{about}; what it rules out is left out of the reading"));
    }
    let corrected = chunks.iter().filter(|chunk| chunk.tag == Tag::Conf);
    warnings.extend(corrected.map(|chunk| format!("\"{}\" was taken back", &text[chunk.start..chunk.end])));
    warnings
}

/// Content words in no chunk.
fn unused(text: &str, words: &[Word], units: &[Unit], chunks: &[ChunkWords]) -> Vec<TextSpan> {
    let mut covered = vec![false; words.len()];
    for chunk in chunks.iter().filter(|chunk| chunk.parent.is_none()) {
        let from = words.partition_point(|word| word.start < chunk.start);
        let past = words.partition_point(|word| word.end <= chunk.end);
        covered[from..past.max(from)].fill(true);
    }
    let content = |kind: &UnitKind| match kind {
        UnitKind::Noun(..) | UnitKind::Unknown => true,
        UnitKind::Word(role) => {
            matches!(role, Role::Side | Role::Turn | Role::Motion | Role::Adjective | Role::Part)
        }
        UnitKind::Stop => false,
    };
    let span = |unit: &Unit| {
        let (start, end) = (words[unit.first].start, words[unit.past - 1].end);
        TextSpan { text: text[start..end].to_string(), start, end }
    };
    units.iter().filter(|unit| content(&unit.kind) && !covered[unit.first]).map(span).collect()
}

fn why(chunk: &ChunkWords, meaning: &Meaning) -> Why {
    let pair = meaning.pairs.first();
    Why {
        start: chunk.start,
        end: chunk.end,
        tag: chunk.tag,
        kind: meaning.kind.map(|kind| kind.name().to_string()),
        room: meaning.room.clone().or_else(|| meaning.side.map(|side| side.name().to_string())),
        object: meaning.object.clone(),
        reference: pair.map(|pair| pair.reference.to_string()),
        direction: pair.map(|pair| pair.direction),
        target: meaning.target.clone(),
        score: meaning.score.into(),
        because: meaning.because.clone(),
    }
}

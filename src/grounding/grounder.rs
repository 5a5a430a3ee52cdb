//! Grounds a chunk tree by either method.

use std::sync::Arc;

use super::composed::meaning_of;
use super::doubts;
use super::meaning::pair;
use super::paper::{LabelledTree, Model};
use super::readings::{self, Instead};
use super::story::tell;
use super::words::{ChunkWords, chunk_words_of};
use super::{Meaning, assemble};
use crate::language::tokens::{Word, tokenize};
use crate::language::{Class, Lexicon, read, tree_of};
use crate::record::{Chunk, Grounding, ObjectSlot, Reference, Tag, Token, Why};

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
    /// A tree that the reader itself would make is read as a whole, with all that its phrases mean; a tree from
    /// elsewhere is taken as it is, chunk by chunk. `tokens` give the paper's method its parts of speech; they may be
    /// empty.
    pub fn ground(&self, text: &str, tokens: &[Token], chunks: &[Chunk]) -> Grounding {
        let words = tokenize(text);
        if matches!(self.method, Method::Composed) {
            let (reading, errands) = read(&words, &self.lexicon);
            if same_tree(&tree_of(&reading, &errands, &words), chunks) {
                let (mut grounding, object) = tell(&reading, &errands);
                doubts::add(&mut grounding, &reading, text, &words, self.brief);
                let instead = Instead { object, taken_back: doubts::taken_back(&reading) };
                return self.finish(grounding, &instead);
            }
        }
        self.ground_tree(text, &words, tokens, chunks)
    }

    fn ground_tree(&self, text: &str, words: &[Word], tokens: &[Token], tree: &[Chunk]) -> Grounding {
        let chunks = chunk_words_of(words, tree);
        let meanings = match &self.method {
            Method::Composed => self.composed(words, &chunks),
            Method::Paper(model) => model.meanings(&LabelledTree::unlabelled(text, tokens, tree)),
        };
        let mut grounding = assemble(&chunks, &meanings);
        readings::score(&mut grounding);
        let taken_back = chunks.iter().zip(&meanings).filter(|(chunk, _)| chunk.tag == Tag::Conf);
        let instead = Instead {
            object: other_object(&grounding, &chunks, &meanings),
            taken_back: taken_back.clone().find_map(|(_, meaning)| meaning.side),
        };
        let spoken = |chunk: &ChunkWords| format!("\"{}\" was taken back", &text[chunk.start..chunk.end]);
        grounding.warnings.extend(taken_back.map(|(chunk, _)| spoken(chunk)));
        if !self.brief {
            grounding.unused = doubts::outside(text, words, &chunks, &self.lexicon);
            grounding.why = chunks.iter().zip(&meanings).map(|(chunk, meaning)| why(chunk, meaning)).collect();
        }
        self.finish(grounding, &instead)
    }

    fn finish(&self, mut grounding: Grounding, instead: &Instead) -> Grounding {
        readings::rank(&mut grounding, instead);
        if self.brief {
            grounding.readings.clear();
        }
        if doubts::is_empty(&grounding) {
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
        let furniture = |noun: &&str| lexicon.class_of(noun).is_some_and(Class::is_furniture);
        let references = meaning.pairs.iter().filter_map(|pair| pair.reference.thing());
        last = meaning.target.as_deref().into_iter().chain(references).find(furniture).map(str::to_string).or(last);
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

/// Another object that some chunk names.
fn other_object(grounding: &Grounding, chunks: &[ChunkWords], meanings: &[Meaning]) -> Option<ObjectSlot> {
    let object = grounding.object.as_ref()?;
    let named = chunks.iter().zip(meanings).filter(|(chunk, _)| chunk.tag == Tag::Obtp);
    let (name, meaning) = named
        .filter_map(|(_, meaning)| Some((meaning.object.as_ref()?, meaning)))
        .find(|(name, meaning)| **name != object.name && !meaning.indefinite)?;
    Some(ObjectSlot { name: name.clone(), score: meaning.score.into(), ..ObjectSlot::default() })
}

/// Whether two trees have the same chunks; the rules behind them do not matter.
fn same_tree(one: &[Chunk], other: &[Chunk]) -> bool {
    one.len() == other.len()
        && one
            .iter()
            .zip(other)
            .all(|(a, b)| (a.tag, a.start, a.end) == (b.tag, b.start, b.end) && same_tree(&a.chunks, &b.chunks))
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

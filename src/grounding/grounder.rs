//! Grounds a chunk tree by either method.

use super::composed::meaning_of;
use super::paper::Model;
use super::words::{ChunkWords, chunk_words};
use super::{Meaning, assemble};
use crate::language::{Lexicon, Role, UnitKind, tokens::tokenize, units};
use crate::record::{Chunk, Grounding, TextSpan, Why};

/// How chunks get their meaning.
#[derive(Clone, Debug, Default)]
pub enum Method {
    /// From what the words mean.
    #[default]
    Composed,
    /// From the nearest labelled example, by the published equations.
    Paper(Box<Model>),
}

/// Grounds descriptions.
#[derive(Clone, Debug)]
pub struct Grounder {
    method: Method,
    lexicon: &'static Lexicon,
    brief: bool,
}

impl Grounder {
    /// A grounder; `brief` leaves out the reasons.
    pub fn new(method: Method, brief: bool) -> Self {
        Self { method, lexicon: Lexicon::embedded(), brief }
    }

    /// The meaning of a chunk tree over `text`.
    pub fn ground(&self, text: &str, chunks: &[Chunk]) -> Grounding {
        let chunks = chunk_words(text, chunks);
        let meanings: Vec<Meaning> = match &self.method {
            Method::Composed => chunks.iter().map(|chunk| meaning_of(chunk, self.lexicon)).collect(),
            Method::Paper(model) => model.meanings(&chunks, self.lexicon),
        };
        let mut grounding = assemble(&chunks, &meanings);
        let parts = grounding.nodes.iter().map(|node| node.score.0);
        let parts =
            parts.chain(grounding.room.iter().map(|r| r.score.0)).chain(grounding.object.iter().map(|o| o.score.0));
        grounding.score = parts.fold(1.0, |product: f64, score| product * score).into();
        grounding.warnings = self.warnings(text, &chunks);
        if !self.brief {
            grounding.unused = self.unused(text, &chunks);
            grounding.why = chunks.iter().zip(&meanings).map(|(chunk, meaning)| why(chunk, meaning)).collect();
        }
        if grounding.room.is_none() && grounding.object.is_none() && grounding.nodes.is_empty() {
            grounding.score = 0.0.into();
            grounding.problems.push("no room, furniture, move or object was recognised in this text".to_string());
        }
        grounding
    }

    fn warnings(&self, text: &str, chunks: &[ChunkWords]) -> Vec<String> {
        let words = tokenize(text);
        let negated = units(&words, self.lexicon).iter().any(|unit| unit.role() == Some(Role::Negation));
        let corrected = chunks.iter().find(|chunk| chunk.tag == crate::record::Tag::Conf);
        let mut warnings = Vec::new();
        if negated {
            warnings.push("a negation was heard and is not acted on".to_string());
        }
        if let Some(chunk) = corrected {
            warnings.push(format!("\"{}\" was taken back", &text[chunk.start..chunk.end]));
        }
        warnings
    }

    /// Content words in no chunk.
    fn unused(&self, text: &str, chunks: &[ChunkWords]) -> Vec<TextSpan> {
        let words = tokenize(text);
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
        let unused = units(&words, self.lexicon).into_iter().filter(|unit| content(&unit.kind) && !covered[unit.first]);
        let span = |unit: &crate::language::Unit| {
            let (start, end) = (words[unit.first].start, words[unit.past - 1].end);
            TextSpan { text: text[start..end].to_string(), start, end }
        };
        unused.map(|unit| span(&unit)).collect()
    }
}

fn why(chunk: &ChunkWords, meaning: &Meaning) -> Why {
    let pair = meaning.pairs.first();
    Why {
        start: chunk.start,
        end: chunk.end,
        tag: chunk.tag,
        kind: None,
        room: meaning.room.clone().or_else(|| meaning.side.map(|side| side.name().to_string())),
        object: meaning.object.clone(),
        reference: pair.map(|pair| pair.reference.clone()),
        direction: pair.map(|pair| pair.direction),
        target: meaning.target.clone(),
        score: meaning.score.into(),
        because: meaning.because.clone(),
    }
}

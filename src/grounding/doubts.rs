//! What makes a reading doubtful: words that changed nothing, words that nobody knows, repairs, exclusions.

use super::words::ChunkWords;
use crate::language::tokens::Word;
use crate::language::{Kind, Lexicon, Phrase, Reading, Role, Unit, units};
use crate::record::{Direction, Grounding, Tag, TextSpan, Why};

/// Warnings, unused words and, unless they are not wanted, the reasons.
pub fn add(grounding: &mut Grounding, reading: &Reading, text: &str, words: &[Word], brief: bool) {
    let doubts = super::confidence::score(grounding, reading);
    grounding.warnings = warnings(grounding, reading, text, words);
    if brief {
        return;
    }
    grounding.doubts = doubts;
    let left_out = left_out(reading);
    grounding.unused = left_out.iter().map(|&at| span(&reading.units[at], text, words)).collect();
    let phrases = reading.phrases.iter();
    grounding.why = phrases.filter_map(|phrase| why(phrase, reading, words)).collect();
}

/// Whether nothing was understood.
pub fn is_empty(grounding: &Grounding) -> bool {
    grounding.room.is_none()
        && grounding.object.is_none()
        && grounding.nodes.is_empty()
        && grounding.destination.is_none()
        && grounding.not.is_empty()
}

/// The side that was taken back.
pub fn taken_back(reading: &Reading) -> Option<Direction> {
    let corrected = reading.phrases.iter().filter(|phrase| phrase.kind == Kind::Corrected);
    corrected.filter_map(|phrase| phrase.side.or(phrase.directions[0])).next()
}

/// The units that say something and are in no phrase.
pub fn left_out(reading: &Reading) -> Vec<usize> {
    let mut inside = vec![false; reading.units.len()];
    for phrase in &reading.phrases {
        inside[phrase.first..phrase.past].fill(true);
    }
    (0..reading.units.len()).filter(|&at| !inside[at] && says_something(&reading.units[at])).collect()
}

/// Whether leaving a word out loses something.
pub fn says_something(unit: &Unit) -> bool {
    const CONTENT: [Role; 11] = [
        Role::Side,
        Role::Turn,
        Role::Motion,
        Role::Adjective,
        Role::Part,
        Role::Bring,
        Role::Give,
        Role::Put,
        Role::Act,
        Role::Find,
        Role::Near,
    ];
    !unit.stop && (unit.noun.is_some() || unit.is_unknown() || CONTENT.iter().any(|role| unit.has(*role)))
}

/// The content words of a text that stand in no chunk.
pub fn outside(text: &str, words: &[Word], chunks: &[ChunkWords], lexicon: &Lexicon) -> Vec<TextSpan> {
    let mut covered = vec![false; words.len()];
    for chunk in chunks.iter().filter(|chunk| chunk.parent.is_none()) {
        let from = words.partition_point(|word| word.start < chunk.start);
        let past = words.partition_point(|word| word.end <= chunk.end);
        covered[from..past.max(from)].fill(true);
    }
    let units = units(words, lexicon);
    let outside = units.iter().filter(|unit| !covered[unit.first] && says_something(unit));
    outside.map(|unit| span(unit, text, words)).collect()
}

fn span(unit: &Unit, text: &str, words: &[Word]) -> TextSpan {
    let (start, end) = (words[unit.first].start, words[unit.past - 1].end);
    TextSpan { text: text[start..end].to_string(), start, end }
}

fn warnings(grounding: &Grounding, reading: &Reading, text: &str, words: &[Word]) -> Vec<String> {
    let mut warnings = Vec::new();
    let said = |phrase: &Phrase| {
        let (first, last) = (&reading.units[phrase.first], &reading.units[phrase.past - 1]);
        &text[words[first.first].start..words[last.past - 1].end]
    };
    if reading.phrases.iter().any(|phrase| phrase.kind == Kind::RuledOut) {
        let names: Vec<String> = grounding.not.iter().map(|not| format!("`{}`", not.name)).collect();
        let about = if names.is_empty() { String::new() } else { format!(" about {}", names.join(", ")) };
        warnings.push(format!("a negation was heard{about}; what it rules out is left out of the reading"));
    }
    for phrase in reading.phrases.iter().filter(|phrase| phrase.kind == Kind::Corrected) {
        warnings.push(format!("\"{}\" was taken back", said(phrase)));
    }
    for unit in reading.units.iter().filter(|unit| unit.mended && unit.noun.is_some()) {
        let written = words[unit.first].text;
        warnings.push(format!("\"{written}\" was read as \"{}\"", unit.lower.replace('_', " ")));
    }
    let objects = grounding.object.iter().chain(&grounding.also);
    for object in objects.filter(|object| object.score.0 < 0.7) {
        warnings.push(format!("`{}` is no noun of the lexicon; `--lexicon` adds one", object.name));
    }
    warnings
}

fn why(phrase: &Phrase, reading: &Reading, words: &[Word]) -> Option<Why> {
    let tag = tag_of(phrase.kind)?;
    let (first, last) = (&reading.units[phrase.first], &reading.units[phrase.past - 1]);
    let name = phrase
        .noun()
        .filter(|noun| !noun.generic)
        .map(|noun| crate::language::name_of(noun, &reading.units, phrase.kind == Kind::Object));
    let pair = super::phrase_pairs::pairs_of(phrase, &reading.units, None).into_iter().next();
    Some(Why {
        start: words[first.first].start,
        end: words[last.past - 1].end,
        tag,
        kind: None,
        room: name
            .clone()
            .filter(|_| phrase.kind == Kind::Room)
            .or_else(|| phrase.side.map(|side| side.name().to_string())),
        object: name.clone().filter(|_| phrase.kind == Kind::Object),
        reference: pair.as_ref().map(|pair| pair.reference.to_string()),
        direction: pair.as_ref().map(|pair| pair.direction),
        target: name.filter(|_| phrase.kind == Kind::Target),
        score: if phrase.noun().is_none_or(|noun| noun.is_known() && !noun.inferred) { 0.95 } else { 0.6 }.into(),
        because: format!("fits `{}`", phrase.rule),
    })
}

fn tag_of(kind: Kind) -> Option<Tag> {
    Some(match kind {
        Kind::Go | Kind::Turn | Kind::Side | Kind::Part => Tag::Irmrp,
        Kind::Room => Tag::Ormtp,
        Kind::Target => Tag::Furtp,
        Kind::Landmark => Tag::Furrp,
        Kind::ObjectMark => Tag::Obrp,
        Kind::Object => Tag::Obtp,
        Kind::Perspective => Tag::Pers,
        Kind::Corrected | Kind::RuledOut => Tag::Conf,
        _ => return None,
    })
}

//! Finite-state patterns over units: what each stretch of the description is about.

use super::corrections::{continue_moves, rule_out, take_back_corrected};
use super::cursor::Cursor;
use super::units::Unit;
use super::word_class::Role;

/// What a phrase is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A move ahead, up to its stated end.
    Go,
    /// A change of heading.
    Turn,
    /// A room or a door to a room; `inner` is the words that pick it by side.
    Room,
    /// A place relative to the hearer.
    Side,
    /// A part of the room, a wall, the door.
    Part,
    /// Furniture that holds the object or is gone to; `inner` is the move that leads there.
    Target,
    /// Furniture as landmark; `inner` is the move past it.
    Landmark,
    /// An object as landmark.
    ObjectMark,
    /// The head of a clause about the object.
    Object,
    /// Whose view a direction is said from.
    Perspective,
    /// A self-correction.
    Correction,
    /// What a correction took back.
    Corrected,
    /// The end of a sentence.
    Stop,
}

/// A stretch of units with what it is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
}

impl Phrase {
    pub(super) fn new(kind: Kind, first: usize, past: usize, rule: &'static str) -> Self {
        Self { kind, first, past, inner: None, rule }
    }

    pub(super) fn with_inner(self, first: usize, past: usize) -> Self {
        Self { inner: (first < past).then_some((first, past)), ..self }
    }
}

/// The phrases of a text, in order, not overlapping.
pub fn find(units: &[Unit]) -> Vec<Phrase> {
    let cursor = Cursor::new(units);
    let mut phrases: Vec<Phrase> = Vec::new();
    let mut at = 0;
    while at < cursor.len() {
        match cursor.phrase_at(at) {
            Some(phrase) => {
                at = phrase.past.max(at + 1);
                phrases.push(phrase);
            }
            None => at += 1,
        }
    }
    take_back_corrected(&mut phrases);
    continue_moves(&mut phrases, &cursor);
    rule_out(&mut phrases, &cursor);
    phrases
}

impl Cursor<'_> {
    fn phrase_at(&self, at: usize) -> Option<Phrase> {
        if self.is_stop(at) {
            return Some(Phrase::new(Kind::Stop, at, at + 1, "stop"));
        }
        self.correction(at)
            .or_else(|| self.perspective(at))
            .or_else(|| self.object_clause(at))
            .or_else(|| self.motion(at))
            .or_else(|| self.turn(at))
            .or_else(|| self.room(at, at))
            .or_else(|| self.place(at))
            .or_else(|| self.furniture(at, at))
    }

    /// "As you face it", "when you are looking at the bed", "from your point of view".
    fn perspective(&self, at: usize) -> Option<Phrase> {
        if self.is(at, &["from"]) && self.role(at + 1) == Some(Role::Hearer) {
            let view = self.is(at + 2, &["view", "perspective", "side", "point"]);
            let of_view = usize::from(self.is(at + 3, &["of"])) * 2;
            return view.then(|| Phrase::new(Kind::Perspective, at, at + 3 + of_view, "whose view"));
        }
        let subject = self.is(at, &["as", "when", "if", "while"]) && self.role(at + 1) == Some(Role::Pronoun);
        let verb = self.skip(at + 2, &[Role::Copula]);
        if !subject || !self.is(verb, &["face", "facing", "look", "looking", "looked", "faces", "looks"]) {
            return None;
        }
        let object = verb + 1 + usize::from(self.is(verb + 1, &["at", "in", "toward", "towards"]));
        // "If you look to your left" is a turn.
        if self.is(object, &["to", "left", "right", "straight", "down"]) {
            return None;
        }
        let pronoun = usize::from(self.is(object, &["it", "them", "that"]));
        let past = self.noun_phrase(object, false).map_or(object + pronoun, |noun| noun.past);
        Some(Phrase::new(Kind::Perspective, at, past, "whose view"))
    }

    fn correction(&self, at: usize) -> Option<Phrase> {
        let past = self.skip(at, &[Role::Correction]);
        if self.is(at, &["let"]) && self.is(at + 1, &["'s", "me"]) && self.is(at + 2, &["see"]) {
            return Some(Phrase::new(Kind::Correction, at, at + 3, "thinking aloud"));
        }
        let pronoun = self.is(at, &["i"]) && self.is(at + 1, &["mean"]);
        match (pronoun, past > at) {
            (true, _) => Some(Phrase::new(Kind::Correction, at, at + 2, "self-correction")),
            (_, true) => Some(Phrase::new(Kind::Correction, at, past, "self-correction")),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::{Lexicon, tokens::tokenize, units};

    fn kinds(text: &str) -> Vec<Kind> {
        let words = tokenize(text);
        find(&units(&words, Lexicon::embedded())).into_iter().map(|phrase| phrase.kind).collect()
    }

    #[test]
    fn moves_turns_and_places() {
        assert_eq!(kinds("head forward then hang a left"), [Kind::Go, Kind::Turn]);
        assert_eq!(kinds("keep walking until you hit the wall then right again"), [Kind::Go, Kind::Turn]);
        assert_eq!(kinds("take three steps forward and make a ninety degree turn to the left"), [Kind::Go, Kind::Turn]);
    }

    #[test]
    fn rooms_and_the_side_that_picks_them() {
        assert_eq!(kinds("enter the second door on your left"), [Kind::Room]);
        assert_eq!(kinds("the mug is in the bedroom on the left hand side"), [Kind::Object, Kind::Room]);
    }

    #[test]
    fn furniture_as_target_and_as_landmark() {
        assert_eq!(kinds("on the small round table behind the couch"), [Kind::Target, Kind::Landmark]);
        assert_eq!(kinds("go past the bed to the desk"), [Kind::Landmark, Kind::Target]);
    }

    #[test]
    fn a_correction_takes_back_what_stands_before_it() {
        assert_eq!(kinds("turn left no sorry turn right"), [Kind::Corrected, Kind::Turn]);
    }
}

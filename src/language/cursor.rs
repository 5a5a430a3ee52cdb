//! Reading units by position: what stands there, and small patterns over them.

use std::sync::OnceLock;

use super::units::{Unit, UnitKind};
use super::word_class::{Class, Role};
use crate::record::Direction;

/// How a phrase relates something to furniture or an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// It holds the thing.
    On,
    /// It is gone to.
    To,
    /// It is a landmark.
    Landmark(Direction),
}

/// A noun phrase: from its first unit to one past its head.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NounPhrase {
    /// First unit.
    pub first: usize,
    /// The unit that is the noun.
    pub head: usize,
    /// One past the last unit.
    pub past: usize,
}

/// Most words before a noun: longer runs are no noun phrase.
const MOST_MODIFIERS: usize = 8;

/// Longest run of words of one kind that a pattern steps over: keeps reading linear in nonsense as well.
const LONGEST_RUN: usize = 24;

/// A position-wise reader of units; positions past the end answer as if empty.
#[derive(Clone, Copy)]
pub struct Cursor<'u> {
    units: &'u [Unit<'u>],
}

impl<'u> Cursor<'u> {
    pub(super) fn new(units: &'u [Unit<'u>]) -> Self {
        Self { units }
    }

    pub(super) fn len(&self) -> usize {
        self.units.len()
    }

    pub(super) fn role(&self, at: usize) -> Option<Role> {
        self.units.get(at).and_then(Unit::role)
    }

    pub(super) fn class(&self, at: usize) -> Option<Class> {
        self.units.get(at).and_then(Unit::class)
    }

    pub(super) fn lower(&self, at: usize) -> &'u str {
        self.units.get(at).map_or("", |unit| unit.lower.as_ref())
    }

    pub(super) fn is(&self, at: usize, words: &[&str]) -> bool {
        words.contains(&self.lower(at)) && at < self.units.len()
    }

    pub(super) fn is_stop(&self, at: usize) -> bool {
        self.units.get(at).is_some_and(|unit| unit.kind == UnitKind::Stop)
    }

    pub(super) fn is_unknown(&self, at: usize) -> bool {
        self.units.get(at).is_some_and(|unit| unit.kind == UnitKind::Unknown)
    }

    /// The first position from `at` on whose role is none of `roles`.
    pub(super) fn skip(&self, mut at: usize, roles: &[Role]) -> usize {
        let limit = at + LONGEST_RUN;
        while at < limit && self.role(at).is_some_and(|role| roles.contains(&role)) {
            at += 1;
        }
        at
    }

    /// A noun with what goes before it. `unknown` lets a word the lexicon lacks be the noun.
    pub(super) fn noun_phrase(&self, first: usize, unknown: bool) -> Option<NounPhrase> {
        let mut at = first;
        while at < first + MOST_MODIFIERS && self.is_modifier(at) {
            at += 1;
        }
        if self.class(at).is_none() {
            // "The object" names nothing, but is a noun.
            if unknown && self.role(at) == Some(Role::Generic) {
                return Some(NounPhrase { first, head: at, past: at + 1 });
            }
            let head = at.checked_sub(1).filter(|&head| unknown && head >= first && self.is_unknown(head))?;
            return Some(NounPhrase { first, head, past: at });
        }
        // "computer desk": an object's name before furniture only describes it.
        while self.class(at) == Some(Class::Object) && self.class(at + 1).is_some_and(Class::is_furniture) {
            at += 1;
        }
        Some(NounPhrase { first, head: at, past: at + 1 })
    }

    fn is_modifier(&self, at: usize) -> bool {
        const MODIFIERS: [Role; 5] = [Role::Determiner, Role::Hearer, Role::Adjective, Role::Ordinal, Role::Number];
        match self.role(at) {
            Some(role) if MODIFIERS.contains(&role) => true,
            Some(Role::Part | Role::Side) => {
                self.class(at + 1).is_some()
                    || self.role(at + 1) == Some(Role::Adjective)
                    || self.role(at + 1) == Some(Role::Side)
                    || self.is(at + 1, &["hand", "side"]) && self.class(at + 2).is_some()
            }
            Some(Role::Adverb) => self.is(at, &["very", "immediate"]),
            // "The left hand room".
            Some(Role::SideWord) => {
                self.is(at, &["hand", "side"])
                    && at > 0
                    && self.role(at - 1) == Some(Role::Side)
                    && self.class(at + 1).is_some()
            }
            Some(Role::There) => false,
            _ => self.is_unknown(at) || self.is(at, &["'s"]) && at > 0 && self.is_unknown(at - 1),
        }
    }

    /// The relation at a position and where its noun phrase begins.
    pub(super) fn relation(&self, at: usize) -> Option<(Relation, usize)> {
        relations().iter().find_map(|(pattern, relation)| Some((*relation, self.matches(at, pattern)?)))
    }

    fn matches(&self, mut at: usize, pattern: &[Slot]) -> Option<usize> {
        for slot in pattern {
            let fits = match slot.words[0] {
                "the" => matches!(self.role(at), Some(Role::Determiner | Role::Hearer)),
                _ => at < self.units.len() && slot.words.contains(&self.lower(at)),
            };
            if fits {
                at += 1;
            } else if !slot.optional {
                return None;
            }
        }
        Some(at)
    }
}

struct Slot {
    words: Vec<&'static str>,
    optional: bool,
}

fn relations() -> &'static [(Vec<Slot>, Relation)] {
    static RELATIONS: OnceLock<Vec<(Vec<Slot>, Relation)>> = OnceLock::new();
    RELATIONS.get_or_init(|| {
        let lines = include_str!("../../corpus/grammar/relations.tsv").lines();
        let lines = lines.filter(|line| !line.starts_with('#'));
        lines
            .filter_map(|line| line.split_once('\t'))
            .filter_map(|(words, reading)| Some((slots(words), reading_of(reading)?)))
            .collect()
    })
}

fn slots(words: &'static str) -> Vec<Slot> {
    let slot = |word: &'static str| {
        let bare = word.trim_end_matches('?');
        Slot { words: bare.split('|').collect(), optional: bare.len() < word.len() }
    };
    words.split(' ').map(slot).collect()
}

fn reading_of(name: &str) -> Option<Relation> {
    Some(match name {
        "on" => Relation::On,
        "to" => Relation::To,
        "front" => Relation::Landmark(Direction::Front),
        "back" => Relation::Landmark(Direction::Back),
        "left" => Relation::Landmark(Direction::Left),
        "right" => Relation::Landmark(Direction::Right),
        "central" => Relation::Landmark(Direction::Central),
        "side" => Relation::Landmark(Direction::Side),
        "between" => Relation::Landmark(Direction::Between),
        _ => return None,
    })
}

/// The relation a phrase's words begin with, for grounding.
pub fn leading_relation(units: &[Unit]) -> Option<Relation> {
    let cursor = Cursor::new(units);
    cursor.relation(cursor.skip(0, &[Role::Adverb])).map(|(relation, _)| relation)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::{Lexicon, tokens::tokenize, units};

    fn relation(text: &str) -> Option<Relation> {
        leading_relation(&units(&tokenize(text), Lexicon::embedded()))
    }

    #[test]
    fn every_line_of_the_grammar_is_read() {
        let lines = include_str!("../../corpus/grammar/relations.tsv").lines().filter(|line| !line.starts_with('#'));
        assert_eq!(lines.count(), relations().len());
    }

    #[test]
    fn longer_phrases_come_before_their_beginnings() {
        assert_eq!(relation("on the left side of the bed"), Some(Relation::Landmark(Direction::Left)));
        assert_eq!(relation("on top of the bed"), Some(Relation::On));
        assert_eq!(relation("at the foot of the bed"), Some(Relation::Landmark(Direction::Side)));
        assert_eq!(relation("in between two chairs"), Some(Relation::Landmark(Direction::Between)));
    }
}

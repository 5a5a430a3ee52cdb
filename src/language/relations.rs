//! Phrases that relate one thing to another: data in `corpus/grammar/relations.tsv`.

use std::collections::HashMap;

use super::unit::Unit;
use super::word_class::{Role, Roles};
use crate::record::Direction;

/// How a phrase relates something to furniture or an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// It holds the thing on top.
    On,
    /// It holds the thing inside.
    In,
    /// The thing is at it.
    At,
    /// The thing comes from it.
    From,
    /// It is gone to.
    To,
    /// It is a landmark.
    Landmark(Direction),
}

impl Relation {
    fn from_name(name: &str) -> Option<Self> {
        Some(match name {
            "on" => Self::On,
            "in" => Self::In,
            "at" => Self::At,
            "from" => Self::From,
            "to" => Self::To,
            _ => Self::Landmark(Direction::from_name(name)?),
        })
    }
}

#[derive(Clone, Debug)]
struct Slot {
    words: Vec<String>,
    roles: Roles,
    optional: bool,
}

/// All relations, in the order in which they are tried.
#[derive(Clone, Debug, Default)]
pub struct Relations {
    patterns: Vec<(Vec<Slot>, Relation)>,
    /// From the first word of a pattern to the patterns, in their order.
    by_first: HashMap<String, Vec<usize>>,
    /// How many patterns a user added: they go before the others.
    added: usize,
}

impl Relations {
    /// The relations this program ships.
    pub fn embedded() -> Self {
        let mut relations = Self::default();
        let lines = include_str!("../../corpus/grammar/relations.tsv").lines();
        for line in lines.filter(|line| !line.starts_with('#')) {
            if let Some((words, reading)) = line.split_once('\t') {
                // The file is embedded and tested; a broken line would only be left out.
                let _ = relations.push(words, reading);
            }
        }
        relations.index();
        relations
    }

    /// Adds a user's relation; it goes before the shipped ones.
    ///
    /// # Errors
    /// When the reading is none.
    pub fn add(&mut self, words: &str, reading: &str) -> Result<(), String> {
        self.push(words, reading)?;
        if let Some(own) = self.patterns.pop() {
            self.patterns.insert(self.added, own);
            self.added += 1;
        }
        self.index();
        Ok(())
    }

    fn push(&mut self, words: &str, reading: &str) -> Result<(), String> {
        let relation = Relation::from_name(reading.trim())
            .ok_or_else(|| format!("unknown reading `{reading}`; on, in, at, from, to or a direction"))?;
        let slots: Vec<Slot> = words.split_whitespace().map(slot).collect();
        if slots.iter().all(|slot| slot.optional) {
            return Err("a relation needs a word that may not be missing".to_string());
        }
        self.patterns.push((slots, relation));
        Ok(())
    }

    fn index(&mut self) {
        self.by_first.clear();
        for (at, (slots, _)) in self.patterns.iter().enumerate() {
            for slot in slots {
                for word in &slot.words {
                    let patterns = self.by_first.entry(word.clone()).or_default();
                    if patterns.last() != Some(&at) {
                        patterns.push(at);
                    }
                }
                if !slot.optional {
                    break;
                }
            }
        }
    }

    /// The relation that begins with the unit at a position, and where what it relates to begins.
    pub fn at(&self, units: &[Unit], at: usize) -> Option<(Relation, usize)> {
        let patterns = self.by_first.get(units.get(at)?.lower.as_ref())?;
        patterns.iter().find_map(|&index| {
            let (slots, relation) = &self.patterns[index];
            matches(units, at, slots).map(|past| (*relation, past))
        })
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.patterns.len()
    }
}

fn matches(units: &[Unit], mut at: usize, slots: &[Slot]) -> Option<usize> {
    let first = at;
    for slot in slots {
        let fits = units.get(at).is_some_and(|unit| {
            (at == first || !unit.pause)
                && (unit.roles.meet(slot.roles) || slot.words.iter().any(|word| *word == unit.lower))
        });
        if fits {
            at += 1;
        } else if !slot.optional {
            return None;
        }
    }
    Some(at)
}

fn slot(word: &str) -> Slot {
    let bare = word.trim_end_matches('?');
    let roles = match bare {
        "the" => Roles::of(Role::Determiner).with(Roles::of(Role::Hearer)),
        "ADV" => Roles::of(Role::Adverb),
        "ADJ" => Roles::of(Role::Adjective).with(Roles::of(Role::Side)).with(Roles::of(Role::Ordinal)),
        _ => Roles::default(),
    };
    let words = if roles.is_empty() { bare.split('|').map(str::to_string).collect() } else { Vec::new() };
    Slot { words, roles, optional: bare.len() < word.len() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::{Lexicon, tokens::tokenize, units};

    fn relation(text: &str) -> Option<Relation> {
        let words = tokenize(text);
        Relations::embedded().at(&units(&words, Lexicon::embedded()), 0).map(|(relation, _)| relation)
    }

    #[test]
    fn every_line_of_the_grammar_is_read() {
        let lines = include_str!("../../corpus/grammar/relations.tsv").lines().filter(|line| !line.starts_with('#'));
        assert_eq!(lines.count(), Relations::embedded().len());
    }

    #[test]
    fn longer_phrases_come_before_their_beginnings() {
        assert_eq!(relation("on the left side of the bed"), Some(Relation::Landmark(Direction::Left)));
        assert_eq!(relation("on top of the bed"), Some(Relation::On));
        assert_eq!(relation("at the foot of the bed"), Some(Relation::Landmark(Direction::Side)));
        assert_eq!(relation("in between two chairs"), Some(Relation::Landmark(Direction::Between)));
        assert_eq!(relation("farthest from the window"), Some(Relation::Landmark(Direction::Far)));
        assert_eq!(relation("in the top drawer of the desk"), Some(Relation::In));
    }
}

//! Parts of a room: "the back", "the far right corner", "the middle", "the other end".

use super::noun_phrases::side;
use super::unit::Unit;
use super::word_class::{Class, Role};
use crate::record::Direction;

/// A part of the room: one direction, or two for a corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Zone {
    /// The directions, in the order said.
    pub directions: [Option<Direction>; 2],
    /// One past its last unit.
    pub past: usize,
}

/// More words than this before or in a part of a room are no phrase.
const MOST_WORDS: usize = 6;

/// The part of a room that begins at a position; not one whose words go on to a noun ("the back table").
pub fn zone(units: &[Unit], first: usize) -> Option<Zone> {
    let words = Words { units, first };
    let start = words.lead();
    let said = words.said(start);
    let corner = words.unit(said.past).is_some_and(|unit| unit.class() == Some(Class::Part));
    let past = said.past + usize::from(corner);
    let names_a_part = corner || said.depth.is_some() && past > start;
    if !names_a_part || words.goes_on(past) || said.is_bare(&words, past, corner) {
        return None;
    }
    Some(Zone { directions: said.directions(corner), past })
}

/// The words from a position on, up to a pause.
struct Words<'u, 't> {
    units: &'u [Unit<'t>],
    first: usize,
}

impl<'t> Words<'_, 't> {
    fn unit(&self, at: usize) -> Option<&Unit<'t>> {
        self.units.get(at).filter(|unit| at == self.first || !unit.pause)
    }

    fn has(&self, at: usize, role: Role) -> bool {
        self.unit(at).is_some_and(|unit| unit.has(role))
    }

    fn is(&self, at: usize, words: &[&str]) -> bool {
        self.unit(at).is_some_and(|unit| words.contains(&unit.lower.as_ref()))
    }

    /// Past "all the way at your".
    fn lead(&self) -> usize {
        let leads = |at: usize| {
            self.has(at, Role::Determiner)
                || self.has(at, Role::Hearer)
                || self.has(at, Role::Adverb) && !self.has(at, Role::Part)
        };
        (self.first..self.first + MOST_WORDS).find(|&at| !leads(at)).unwrap_or(self.first + MOST_WORDS)
    }

    /// The words of direction from `start` on.
    fn said(&self, start: usize) -> Said {
        let mut said = Said { lateral: None, depth: None, far: false, head: false, past: start };
        while said.past < start + MOST_WORDS {
            let Some(here) = self.unit(said.past) else { break };
            match here.lower.as_ref() {
                "left" | "right" if here.has(Role::Side) => said.lateral = side(here),
                "far" | "further" | "farther" | "furthest" | "farthest" | "other" | "opposite" => {
                    said.far = true;
                    said.depth = said.depth.or(Some(Direction::Back));
                }
                "back" | "rear" => said.depth = Some(Direction::Back),
                "end" => {
                    said.depth = said.depth.or(Some(Direction::Back));
                    said.head = true;
                }
                "middle" | "center" | "centre" => said.depth = Some(Direction::Central),
                "front" => said.depth = Some(Direction::Front),
                "near" | "close" | "nearest" | "closest"
                    if self.is(said.past + 1, &["end", "side", "corner", "half", "part", "left", "right"]) =>
                {
                    said.depth = Some(Direction::Front);
                }
                "side" | "half" | "part" | "area" | "hand" if said.past > start => said.head = true,
                "very" | "most" => {}
                _ if here.has(Role::Adjective) && said.past > start => {}
                _ => break,
            }
            said.past += 1;
        }
        said
    }

    /// Whether the words go on to a noun, or to "there" that begins a clause of its own.
    fn goes_on(&self, at: usize) -> bool {
        let next = |is: &dyn Fn(&Unit) -> bool| self.units.get(at + 1).is_some_and(is);
        let noun = self.unit(at).is_some_and(|unit| {
            let leads_to_noun = unit.has(Role::Adjective) || unit.is_unknown();
            unit.noun.is_some() && at > self.first || leads_to_noun && next(&|next| next.noun.is_some() && !next.pause)
        });
        noun || self.is(at, &["there"]) && !next(&|next| next.has(Role::Copula) || next.has(Role::Modal))
    }
}

/// The words of a part of a room.
struct Said {
    lateral: Option<Direction>,
    depth: Option<Direction>,
    /// "Far", "other".
    far: bool,
    /// "End", "side", "half".
    head: bool,
    /// One past the last.
    past: usize,
}

impl Said {
    /// "The other" and "the near" are parts only with a noun of place; "the front" by itself is before the hearer.
    fn is_bare(&self, words: &Words, past: usize, corner: bool) -> bool {
        let only_far = self.far && !self.head && !corner && self.lateral.is_none();
        only_far && words.is(past - 1, &["other", "opposite", "further", "farther", "far"])
            || self.depth == Some(Direction::Front) && !self.head && !corner && !words.is(past, &["of"])
    }

    fn directions(&self, corner: bool) -> [Option<Direction>; 2] {
        match (self.lateral, self.depth, corner) {
            (None, None, _) => [Some(Direction::Side), None],
            (None, depth, _) => [depth, None],
            (lateral, None, _) => [lateral, None],
            // "The far right": the right one.
            (lateral, Some(Direction::Back), false) if self.far => [lateral, None],
            (lateral, depth, _) => [lateral, depth],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::{Lexicon, tokens::tokenize, units};

    fn directions(text: &str) -> Option<Vec<Direction>> {
        let words = tokenize(text);
        zone(&units(&words, Lexicon::embedded()), 0).map(|zone| zone.directions.into_iter().flatten().collect())
    }

    #[test]
    fn ends_corners_and_middles() {
        use Direction::{Back, Central, Front, Left, Right, Side};
        assert_eq!(directions("the far right corner"), Some(vec![Right, Back]));
        assert_eq!(directions("the back left corner of the room"), Some(vec![Left, Back]));
        assert_eq!(directions("the far right"), Some(vec![Right]));
        assert_eq!(directions("the other end"), Some(vec![Back]));
        assert_eq!(directions("the corner"), Some(vec![Side]));
        assert_eq!(directions("the near corner"), Some(vec![Front]));
        assert_eq!(directions("the middle of the room"), Some(vec![Central]));
        assert_eq!(directions(&"the ".repeat(1000)), None);
        assert_eq!([directions("the back table"), directions("the left"), directions("the other")], [None, None, None]);
    }
}

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

/// The part of a room that begins at a position; not one whose words go on to a noun ("the back table").
pub fn zone(units: &[Unit], first: usize) -> Option<Zone> {
    let unit = |at: usize| units.get(at).filter(|unit| at == first || !unit.pause);
    let has = |at: usize, role| unit(at).is_some_and(|unit| unit.has(role));
    let is = |at: usize, words: &[&str]| unit(at).is_some_and(|unit| words.contains(&unit.lower.as_ref()));
    let mut at = first;
    while has(at, Role::Determiner) || has(at, Role::Hearer) || has(at, Role::Adverb) && !has(at, Role::Part) {
        at += 1;
    }
    let start = at;
    let (mut lateral, mut depth, mut far, mut head) = (None, None, false, false);
    while at < start + 6 {
        let Some(here) = unit(at) else { break };
        let word = here.lower.as_ref();
        match word {
            "left" | "right" if here.has(Role::Side) => lateral = side(here),
            "far" | "further" | "farther" | "furthest" | "farthest" | "other" | "opposite" => {
                far = true;
                depth = depth.or(Some(Direction::Back));
            }
            "back" | "rear" => depth = Some(Direction::Back),
            "end" => {
                depth = depth.or(Some(Direction::Back));
                head = true;
            }
            "middle" | "center" | "centre" => depth = Some(Direction::Central),
            "front" => depth = Some(Direction::Front),
            "near" | "close" | "nearest" | "closest"
                if at + 1 < units.len()
                    && (is(at + 1, &["end", "side", "corner", "half", "part", "left", "right"])) =>
            {
                depth = Some(Direction::Front);
            }
            "side" | "half" | "part" | "area" | "hand" if at > start => head = true,
            "very" | "most" => {}
            _ if here.has(Role::Adjective) && at > start => {}
            _ => break,
        }
        at += 1;
    }
    let corner = unit(at).is_some_and(|unit| unit.class() == Some(Class::Part));
    at += usize::from(corner);
    let noun_follows = unit(at).is_some_and(|unit| unit.noun.is_some() && at > first)
        || unit(at).is_some_and(|unit| {
            (unit.has(Role::Adjective) || unit.is_unknown())
                && units.get(at + 1).is_some_and(|next| next.noun.is_some() && !next.pause)
        });
    if noun_follows
        || is(at, &["there"]) && !units.get(at + 1).is_some_and(|next| next.has(Role::Copula) || next.has(Role::Modal))
        || !corner && depth.is_none()
        || !corner && at == start
    {
        return None;
    }
    // "The other" and "the near" are parts only with a noun of place; "the front" by itself is before the hearer.
    let only_far = far && !head && !corner && lateral.is_none();
    if only_far && is(at - 1, &["other", "opposite", "further", "farther", "far"])
        || depth == Some(Direction::Front) && !head && !corner && !is(at, &["of"])
    {
        return None;
    }
    let directions = match (lateral, depth, corner) {
        (None, None, _) => [Some(Direction::Side), None],
        (None, depth, _) => [depth, None],
        (lateral, None, _) => [lateral, None],
        // "The far right": the right one.
        (lateral, Some(Direction::Back), false) if far => [lateral, None],
        (lateral, depth, _) => [lateral, depth],
    };
    Some(Zone { directions, past: at })
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
        assert_eq!([directions("the back table"), directions("the left"), directions("the other")], [None, None, None]);
    }
}

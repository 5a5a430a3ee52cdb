//! Where something was found, as a person would say it: the room, the furniture, and as few relations as tell the
//! piece from all others.
//!
//! The relations are tried as the robot would read them if it were told ([`super::search`]), by the same histograms
//! of forces. So what it says leads it, and whoever reads words alike, back to the same piece.

use super::Beliefs;
use super::relation::Place;
use super::search::{Wanted, rank};
use crate::geometry::Vec2;
use crate::grounding::usual_pair;
use crate::language::{Lexicon, Vocabulary};
use crate::planning::frames_to_try;
use crate::record::{Direction, SearchPair};

/// A piece is told from the others when it fits so many times better than the next.
const TELLING: f64 = 1.5;
/// Landmarks are not farther from the piece than this, metres.
const NEAR_M: f64 = 1.5;
/// The best sides, and the best landmarks, that are tried together.
const BEST_SIDES: usize = 3;
const BEST_LANDMARKS: usize = 4;

/// Parts of the room, in words and as they are read.
const SIDES: [(&str, &str, Direction); 6] = [
    ("on the left", "robot", Direction::Left),
    ("on the right", "robot", Direction::Right),
    ("at the back of the room", "room", Direction::Back),
    ("near the door", "door", Direction::Side),
    ("by the left wall", "wall", Direction::Left),
    ("by the right wall", "wall", Direction::Right),
];

/// What can be said of a landmark, the likeliest to be said first.
const RELATIONS: [(&str, Direction); 5] = [
    ("next to", Direction::Side),
    ("behind", Direction::Back),
    ("in front of", Direction::Front),
    ("to the left of", Direction::Left),
    ("to the right of", Direction::Right),
];

/// A relation, in words and as it is read.
#[derive(Clone)]
struct Clause {
    words: String,
    pair: SearchPair,
}

/// A piece among all others, seen from where the words are read.
struct Teller<'a> {
    beliefs: Beliefs,
    index: usize,
    place: Place<'a>,
    lexicon: &'a Lexicon,
}

/// "Your mug is in the bedroom, on the table on the right, next to the chair." Nothing where no furniture is known at
/// the place, metres, at which it was found.
pub(super) fn telling(
    beliefs: &Beliefs,
    found: Vec2,
    object: Option<&str>,
    room: &str,
    place: Place,
    lexicon: &Lexicon,
) -> Option<String> {
    let index = beliefs.under(found)?;
    let seen = beliefs.sighting(None).map(|sighting| sighting.name.as_str());
    let object = object.or(seen)?.replace('_', " ");
    let mut beliefs = beliefs.clone();
    beliefs.search_anew();
    let noun = beliefs.furniture[index].detection().category.clone();
    let teller = Teller { beliefs, index, place, lexicon };
    let words: Vec<String> = teller.clauses(&noun).into_iter().map(|clause| clause.words).collect();
    let (noun, room) = (noun.replace('_', " "), room.replace('_', " "));
    let place = format!("on the {noun} {}", words.join(", "));
    let is = Vocabulary::embedded().copula(&object);
    Some(format!("Your {object} {is} in the {room}, {}.", place.trim_end()))
}

impl Teller<'_> {
    /// As few clauses as tell the piece from all others; where none do, those that do it best.
    fn clauses(&self, noun: &str) -> Vec<Clause> {
        if self.margin(noun, &[]) >= TELLING {
            return Vec::new();
        }
        let sides = self.ordered(noun, self.sides());
        let landmarks = self.ordered(noun, self.landmarks());
        let best = landmarks.first().into_iter().chain(sides.first()).max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((alone, clause)) = best.cloned() else { return Vec::new() };
        if alone >= TELLING {
            return vec![clause];
        }
        let both = sides.iter().take(BEST_SIDES).flat_map(|(_, side)| {
            landmarks.iter().take(BEST_LANDMARKS).map(|(_, landmark)| vec![side.clone(), landmark.clone()])
        });
        let both = both.map(|clauses| (self.margin(noun, &clauses), clauses));
        let best = both.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(together, _)| *together > alone);
        best.map_or_else(|| vec![clause], |(_, clauses)| clauses)
    }

    /// Clauses with their margins, the most telling first; of equals the likeliest to be said.
    fn ordered(&self, noun: &str, clauses: Vec<Clause>) -> Vec<(f64, Clause)> {
        let margin = |clause: Clause| (self.margin(noun, std::slice::from_ref(&clause)), clause);
        let mut ordered: Vec<(f64, Clause)> = clauses.into_iter().map(margin).collect();
        ordered.sort_by(|a, b| b.0.total_cmp(&a.0));
        ordered
    }

    /// How many times better than the next piece this one fits; below 1 another fits better.
    fn margin(&self, noun: &str, clauses: &[Clause]) -> f64 {
        let pairs = clauses.iter().map(|clause| clause.pair.clone()).collect();
        let wanted = Wanted { target: Some(noun.to_string()), pairs, ..Wanted::default() };
        let ranked = rank(&self.beliefs, &wanted, self.place, self.lexicon);
        let inside = |index: usize| self.place.room.outline.contains(self.beliefs.furniture[index].centre());
        let score = |this: bool| {
            let fitting = ranked.iter().filter(|r| inside(r.index) && (r.index == self.index) == this);
            fitting.map(|r| r.score).fold(0.0, f64::max)
        };
        score(true) / score(false).max(1e-6)
    }

    fn sides(&self) -> Vec<Clause> {
        SIDES
            .iter()
            .map(|(words, reference, direction)| self.clause((*words).to_string(), reference, *direction))
            .collect()
    }

    /// Relations to the kinds of furniture that stand near.
    fn landmarks(&self) -> Vec<Clause> {
        let piece = &self.beliefs.furniture[self.index];
        let category = &piece.detection().category;
        // "The table next to the table" would be either.
        let near = self.beliefs.furniture.iter().filter(|other| other.detection().category != *category);
        let near = near.filter(|other| other.footprint().distance(piece.footprint()) < NEAR_M);
        let mut nouns: Vec<&str> = near.map(|other| other.detection().category.as_str()).collect();
        nouns.sort_unstable();
        nouns.dedup();
        let relations = |noun: &&str| {
            let spoken = noun.replace('_', " ");
            let noun = (*noun).to_string();
            RELATIONS.map(|(words, direction)| self.clause(format!("{words} the {spoken}"), &noun, direction))
        };
        nouns.iter().flat_map(relations).collect()
    }

    fn clause(&self, words: String, reference: &str, direction: Direction) -> Clause {
        let pair = usual_pair(reference, direction);
        Clause { words, pair: SearchPair { frames: frames_to_try(&pair, self.lexicon), pair } }
    }
}

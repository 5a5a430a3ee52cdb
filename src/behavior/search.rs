//! Which furniture the words mean: candidates ranked by how well they fit the reference–direction pairs.

use super::relation::{self, Place};
use super::{Beliefs, Furniture};
use crate::geometry::vec2;
use crate::language::{Class, Lexicon};
use crate::record::{Direction, Frame, SearchPair};

/// What a reading in the first, second, third … frame counts: the likeliest is believed most.
const FRAME_WEIGHTS: [f64; 4] = [1.0, 0.85, 0.75, 0.65];
/// What a pair counts whose reference has not been seen.
const UNSEEN: f64 = 0.5;
/// A pair that does not fit at all still leaves this: people err.
const FLOOR: f64 = 0.05;
/// An attribute that was said and not seen.
const ATTRIBUTE_MISSED: f64 = 0.85;
/// Nearness of a candidate halves its preference with every so many metres.
const NEAR_HALVES_M: f64 = 8.0;

/// What is searched.
#[derive(Clone, Debug, Default)]
pub struct Wanted {
    /// Noun of the target furniture; any table-like furniture when none was said.
    pub target: Option<String>,
    /// Colour, size, shape, as said.
    pub attributes: Vec<String>,
    /// "The second table", counted from 1 in the order of distance.
    pub ordinal: Option<u32>,
    /// The pairs, in the order spoken.
    pub pairs: Vec<SearchPair>,
    /// Only readings in each pair's first frame.
    pub one_frame: bool,
    /// By distance alone, whatever the heading.
    pub nearest_first: bool,
}

/// A candidate with its score and the reading behind it.
#[derive(Clone, Debug)]
pub struct Ranked {
    /// Index into the beliefs' furniture.
    pub index: usize,
    /// 0 to 1; comparable among the candidates of one search only.
    pub score: f64,
    /// The factors in words.
    pub reading: String,
}

/// A factor of the score and how it came about.
struct Factor {
    value: f64,
    reading: String,
}

/// The furniture not yet searched that could be meant, best first.
pub fn rank(beliefs: &Beliefs, wanted: &Wanted, place: Place, lexicon: &Lexicon) -> Vec<Ranked> {
    let candidates = candidates(beliefs, wanted.target.as_deref(), lexicon);
    let mut ranked: Vec<Ranked> = candidates
        .iter()
        .filter(|&&index| !beliefs.furniture[index].searched)
        .map(|&index| {
            let factors = factors(index, beliefs, wanted, place, &candidates, lexicon);
            let score = factors.iter().map(|factor| FLOOR + (1.0 - FLOOR) * factor.value).product();
            let readings: Vec<&str> = factors.iter().map(|f| f.reading.as_str()).filter(|r| !r.is_empty()).collect();
            Ranked { index, score, reading: readings.join(", ") }
        })
        .collect();
    ranked.sort_by(|a, b| b.score.total_cmp(&a.score).then(a.index.cmp(&b.index)));
    ranked
}

/// Furniture of the class the target's noun names: people call a nightstand a table, and a desk too.
fn candidates(beliefs: &Beliefs, target: Option<&str>, lexicon: &Lexicon) -> Vec<usize> {
    let class = target.and_then(|noun| lexicon.class_of(noun)).unwrap_or(Class::TableLike);
    (0..beliefs.furniture.len())
        .filter(|&i| {
            let category = beliefs.furniture[i].detection.category.as_str();
            lexicon.class_of(category) == Some(class) || Some(category) == target
        })
        .collect()
}

fn factors(
    index: usize,
    beliefs: &Beliefs,
    wanted: &Wanted,
    place: Place,
    candidates: &[usize],
    lexicon: &Lexicon,
) -> Vec<Factor> {
    let candidate = &beliefs.furniture[index];
    let mut factors: Vec<Factor> =
        wanted.pairs.iter().map(|pair| pair_factor(index, beliefs, pair, wanted.one_frame, place, lexicon)).collect();
    let by_robot = wanted.pairs.iter().any(|pair| pair.pair.reference == "robot");
    factors.push(nearness(candidate, place, by_robot || wanted.nearest_first));
    factors.extend(wanted.attributes.iter().map(|attribute| attribute_factor(candidate, attribute)));
    if let Some(ordinal) = wanted.ordinal {
        factors.push(ordinal_factor(index, beliefs, candidates, ordinal, place));
    }
    factors
}

/// Nearest to the robot's heading first, and nearer before farther.
fn nearness(candidate: &Furniture, place: Place, any_heading: bool) -> Factor {
    let bearing = place.arrived.bearing_to(candidate.centre());
    let near = 0.5_f64.powf(place.arrived.distance_to(candidate.centre()) / NEAR_HALVES_M);
    // A stated direction from the robot already says where to look.
    let ahead = if any_heading { 1.0 } else { 0.2 + 0.8 * (bearing / 2.0).cos().powi(2) };
    Factor { value: near * ahead, reading: format!("{:.0}° off the heading", bearing.to_degrees()) }
}

fn attribute_factor(candidate: &Furniture, attribute: &str) -> Factor {
    let seen = candidate.detection.attributes.iter().any(|a| a == attribute);
    let value = if seen { 1.0 } else { ATTRIBUTE_MISSED };
    Factor { value, reading: if seen { attribute.to_string() } else { String::new() } }
}

fn ordinal_factor(index: usize, beliefs: &Beliefs, candidates: &[usize], ordinal: u32, place: Place) -> Factor {
    let distance = |i: usize| place.arrived.distance_to(beliefs.furniture[i].centre());
    let nearer = candidates.iter().filter(|&&other| distance(other) < distance(index)).count();
    let value = if nearer + 1 == ordinal as usize { 1.0 } else { 0.3 };
    Factor { value, reading: format!("number {} by distance", nearer + 1) }
}

fn pair_factor(
    index: usize,
    beliefs: &Beliefs,
    pair: &SearchPair,
    one_frame: bool,
    place: Place,
    lexicon: &Lexicon,
) -> Factor {
    let candidate = &beliefs.furniture[index];
    let direction = pair.pair.direction;
    let value = match pair.pair.reference.as_str() {
        "robot" | "move" => relation::to_robot(candidate.centre(), direction, place),
        reference @ ("room" | "wall" | "door") => relation::to_room(reference, candidate, direction, place),
        noun => return furniture_factor(index, beliefs, noun, pair, one_frame, place, lexicon),
    };
    Factor { value, reading: format!("{} {value:.2}", pair.pair.phrase()) }
}

fn furniture_factor(
    index: usize,
    beliefs: &Beliefs,
    noun: &str,
    pair: &SearchPair,
    one_frame: bool,
    place: Place,
    lexicon: &Lexicon,
) -> Factor {
    let candidate = &beliefs.furniture[index];
    let references: Vec<&Furniture> =
        references(beliefs, noun, lexicon).into_iter().filter(|&i| i != index).map(|i| &beliefs.furniture[i]).collect();
    let phrase = pair.pair.phrase();
    if references.is_empty() {
        return object_factor(candidate, beliefs, noun, &phrase);
    }
    if pair.pair.direction == Direction::Between {
        let value = best_between(candidate, &references);
        return Factor { value, reading: format!("{phrase} {value:.2}") };
    }
    let frames: Vec<Frame> = if pair.frames.is_empty() { vec![pair.pair.frame] } else { pair.frames.clone() };
    let tried = if one_frame { 1 } else { frames.len() };
    let mut best = Factor { value: 0.0, reading: format!("{phrase} in no frame") };
    for (&frame, &weight) in frames.iter().zip(&FRAME_WEIGHTS).take(tried) {
        for reference in &references {
            let fit = relation::to_furniture(candidate, reference, pair.pair.direction, frame, place);
            let value = weight * fit.unwrap_or(0.0);
            if value > best.value + 1e-9 {
                best = Factor { value, reading: format!("{phrase} {value:.2} ({} frame)", frame.name()) };
            }
        }
    }
    best
}

/// Furniture that a noun can refer to: of that category, else of its class.
pub fn references(beliefs: &Beliefs, noun: &str, lexicon: &Lexicon) -> Vec<usize> {
    let all = 0..beliefs.furniture.len();
    let category = |i: usize| beliefs.furniture[i].detection.category.as_str();
    let exact: Vec<usize> = all.clone().filter(|&i| category(i) == noun).collect();
    if !exact.is_empty() {
        return exact;
    }
    let Some(class) = lexicon.class_of(noun).filter(|class| *class != Class::Object) else { return Vec::new() };
    all.filter(|&i| lexicon.class_of(category(i)) == Some(class)).collect()
}

/// An object as landmark: seen, it is near or not; unseen, it says nothing.
fn object_factor(candidate: &Furniture, beliefs: &Beliefs, noun: &str, phrase: &str) -> Factor {
    match beliefs.sighting(Some(noun)) {
        Some(seen) => {
            let value = if candidate.footprint.distance_to(vec2(seen.x, seen.y)) < 0.5 { 1.0 } else { 0.1 };
            Factor { value, reading: format!("{phrase} {value:.2}") }
        }
        None => Factor { value: UNSEEN, reading: format!("{phrase} not seen") },
    }
}

fn best_between(candidate: &Furniture, references: &[&Furniture]) -> f64 {
    let pairs = references
        .iter()
        .enumerate()
        .flat_map(|(i, first)| references[i + 1..].iter().map(move |second| (first, second)));
    let best = pairs.map(|(first, second)| relation::between(candidate, first, second)).fold(0.0, f64::max);
    // One of the two may be hidden; beside the other is then the best that can be seen.
    if references.len() == 1 { UNSEEN * beside(candidate, references[0]) } else { best }
}

fn beside(candidate: &Furniture, reference: &Furniture) -> f64 {
    0.5_f64.powf(candidate.footprint.distance(&reference.footprint))
}

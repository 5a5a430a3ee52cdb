//! Which furniture the words mean: candidates ranked by how well they fit the reference–direction pairs.
//!
//! The order in which furniture of a room is tried (`static_tier` goes by it; the options of the last
//! column leave the row out):
//!
//! | | what is tried | in which order | unless |
//! |---|---|---|---|
//! | first | the piece on which the object was recognised in passing: a *glance*, whatever the words prefer | – | `no_glance`, `blind` |
//! | 1 | what the target's noun may name | by score: the product over the pairs, the nearness, how sure the piece is what the noun names, the attributes, the ordinal | |
//! | 2 | all other table-like furniture | nearer and more ahead first | `no_fallback` |
//! | 3 | places where something like the object was glimpsed | those glimpsed most often first | `no_glance` |
//! | 4 | what shows itself from one lookout of the room after the other | as in 2 | `no_fallback` |
//! | 5 | 1 to 3 once more, from other sides and through narrower gaps | as before | |
//!
//! The first row is asked again before each piece of rows 1, 2, 4 and 5. A piece tried is not tried again before
//! row 5; of two with the same score the one seen first is tried first. What is in other rooms is tried after all of
//! this room.

use super::relation::{self, Place};
pub use super::wanted::Wanted;
use super::{Beliefs, Furniture};
use crate::geometry::vec2;
use crate::language::{Class, Lexicon};
use crate::record::{Direction, Frame, Reference, SearchPair};

/// What a reading in the first, second, third … frame counts: the likeliest is believed most.
///
/// A step is small against the difference between fitting (near 1) and not fitting (near 0), so a clear fit in a later
/// frame beats a poor one in the first; it only decides between frames that fit about alike.
const FRAME_WEIGHTS: [f64; 4] = [1.0, 0.85, 0.75, 0.65];
/// What a pair counts whose reference has not been seen: midway, since that speaks neither for nor against. All
/// candidates get the same, so it changes not their order but whether the best is thought plausible.
const UNSEEN: f64 = 0.5;
/// A pair that does not fit at all still leaves this: people err. One wrong pair then costs a factor of twenty, more
/// than nearness and attributes together can make good, and rules nothing out.
const FLOOR: f64 = 0.05;
/// An attribute that was said and not seen. Colours are told poorly in dim or tinted light: it may cost as much as
/// the second frame, no more.
const ATTRIBUTE_MISSED: f64 = 0.85;
/// A category that the looks at a piece speak for by less than this is not considered: with six classes, a guess has
/// one in six.
const DOUBTFUL: f64 = 0.2;
/// How likely what holds something small is a table, of what was not taken for one: even odds, as shelves and
/// counters hold small things too.
const HOLDING: f64 = 0.5;
/// From here on the category is not in doubt: what is left is the rest that votes of many looks never lose.
const SURE: f64 = 0.98;
/// A pair that the best candidate fits by less than this is not fulfilled, and is named as what went wrong. Well above
/// what a wrong direction leaves, well below what the right one gives in its least likely frame.
const UNFULFILLED: f64 = 0.2;
/// What a candidate behind the robot counts against one ahead. When nothing else was said the way the robot faces is
/// the best clue there is; beside pairs it only breaks ties, as much as one step of frames or two.
const SIDEWAYS_ALONE: f64 = 0.2;
const SIDEWAYS: f64 = 0.7;
/// Nearness of a candidate halves its preference with every so many metres: about as many as a room is long, so that
/// a metre more costs 8 % and outweighs no pair.
const NEAR_HALVES_M: f64 = 8.0;

/// A candidate with its score and the reading behind it.
#[derive(Clone, Debug)]
pub struct Ranked {
    /// Index into the beliefs' furniture.
    pub index: usize,
    /// 0 to 1; comparable among the candidates of one search only.
    pub score: f64,
    /// What the score would be if the robot were sure of what the piece is.
    pub at_best: f64,
    /// The factors in words.
    pub reading: String,
}

impl Ranked {
    /// Whether the robot is not sure what the piece is.
    pub fn is_doubtful(&self) -> bool {
        self.at_best > self.score
    }
}

/// A factor of the score and how it came about.
struct Factor {
    value: f64,
    reading: String,
}

/// The furniture not yet searched that could be meant, best first.
pub fn rank(beliefs: &Beliefs, wanted: &Wanted, place: Place, lexicon: &Lexicon) -> Vec<Ranked> {
    let mut candidates = candidates(beliefs, wanted.target.as_deref(), lexicon);
    candidates.retain(|&index| !is_ruled_out(&beliefs.furniture[index], &wanted.not, lexicon));
    candidates.retain(|&index| !beliefs.is_passed_over(&beliefs.furniture[index]));
    let mut ranked: Vec<Ranked> = candidates
        .iter()
        .filter(|&&index| !beliefs.furniture[index].searched)
        .map(|&index| {
            let factors = factors(index, beliefs, wanted, place, &candidates, lexicon);
            let counted = |value: f64| FLOOR + (1.0 - FLOOR) * value;
            let score: f64 = factors.iter().map(|factor| counted(factor.value)).product();
            let belief = belief_in_target(&beliefs.furniture[index], wanted.target.as_deref(), lexicon);
            let at_best = if belief < SURE { score / counted(belief) } else { score };
            let readings: Vec<&str> = factors.iter().map(|f| f.reading.as_str()).filter(|r| !r.is_empty()).collect();
            Ranked { index, score, at_best, reading: readings.join(", ") }
        })
        .collect();
    ranked.sort_by(|a, b| b.score.total_cmp(&a.score).then(a.index.cmp(&b.index)));
    ranked
}

/// Furniture of the class the target's noun names: people call a nightstand a table, and a desk too.
fn candidates(beliefs: &Beliefs, target: Option<&str>, lexicon: &Lexicon) -> Vec<usize> {
    (0..beliefs.furniture.len())
        .filter(|&i| belief_in_target(&beliefs.furniture[i], target, lexicon) >= DOUBTFUL)
        .collect()
}

/// Whether a piece is of a category that was ruled out, by its own name: "not the desk" leaves the nightstand.
fn is_ruled_out(furniture: &Furniture, not: &[String], lexicon: &Lexicon) -> bool {
    let same = |category: &str, noun: &String| category == noun || lexicon.canonical(noun) == Some(category);
    not.iter().any(|noun| furniture.belief(|category| same(category, noun)) > 0.5)
}

/// How sure the robot is that a piece is what the target's noun names.
fn belief_in_target(furniture: &Furniture, target: Option<&str>, lexicon: &Lexicon) -> f64 {
    let class = target.and_then(|noun| lexicon.class_of(noun)).unwrap_or(Class::TableLike);
    let belief = furniture.belief(|category| lexicon.class_of(category) == Some(class) || Some(category) == target);
    // A monitor on a table passes for a chair's back; seats hold nothing small.
    if furniture.holds && class == Class::TableLike { 1.0 - (1.0 - belief) * (1.0 - HOLDING) } else { belief }
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
    let by_robot = wanted.pairs.iter().any(|pair| pair.pair.reference == Reference::Robot);
    // A stated direction from the robot already says where to look.
    let sideways = if by_robot || wanted.nearest_first {
        1.0
    } else if wanted.pairs.is_empty() {
        SIDEWAYS_ALONE
    } else {
        SIDEWAYS
    };
    factors.push(nearness(candidate, place, sideways));
    let belief = belief_in_target(candidate, wanted.target.as_deref(), lexicon);
    if belief < SURE {
        factors.push(Factor { value: belief, reading: format!("{belief:.2} sure of what it is") });
    }
    factors.extend(wanted.attributes.iter().map(|attribute| attribute_factor(candidate, attribute)));
    if let Some(ordinal) = wanted.ordinal {
        factors.push(ordinal_factor(index, beliefs, candidates, ordinal, place));
    }
    factors
}

/// Nearest to the robot's heading first, and nearer before farther.
fn nearness(candidate: &Furniture, place: Place, sideways: f64) -> Factor {
    let bearing = place.arrived.bearing_to(candidate.centre());
    let near = 0.5_f64.powf(place.arrived.distance_to(candidate.centre()) / NEAR_HALVES_M);
    let ahead = sideways + (1.0 - sideways) * (bearing / 2.0).cos().powi(2);
    Factor { value: near * ahead, reading: format!("{:.0}° off the heading", bearing.to_degrees()) }
}

fn attribute_factor(candidate: &Furniture, attribute: &str) -> Factor {
    let seen = candidate.detection().attributes.iter().any(|a| a == attribute);
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
    let value = match &pair.pair.reference {
        Reference::Robot | Reference::Move => relation::to_robot(candidate.centre(), direction, place),
        Reference::Room => relation::to_room(candidate, direction, place),
        Reference::Wall => relation::to_wall(candidate, direction, place),
        Reference::Door => relation::to_door(candidate, place),
        Reference::Thing(noun) => return furniture_factor(index, beliefs, noun, pair, one_frame, place, lexicon),
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
    let others = references(beliefs, noun, lexicon).into_iter().filter(|&(i, _)| i != index);
    let references: Vec<(&Furniture, f64)> = others.map(|(i, belief)| (&beliefs.furniture[i], belief)).collect();
    let phrase = pair.pair.phrase();
    if references.is_empty() {
        return object_factor(candidate, beliefs, noun, &phrase);
    }
    if pair.pair.direction == Direction::Between {
        let references: Vec<&Furniture> = references.iter().map(|(reference, _)| *reference).collect();
        let value = best_between(candidate, &references);
        return Factor { value, reading: format!("{phrase} {value:.2}") };
    }
    let frames: Vec<Frame> = if pair.frames.is_empty() { vec![pair.pair.frame] } else { pair.frames.clone() };
    let tried = if one_frame { 1 } else { frames.len() };
    let mut fits: Vec<(Frame, f64)> = Vec::new();
    for (&frame, &weight) in frames.iter().zip(&FRAME_WEIGHTS).take(tried) {
        let fit = |(reference, belief): &(&Furniture, f64)| {
            belief * relation::to_furniture(candidate, reference, pair.pair.direction, frame, place).unwrap_or(0.0)
        };
        fits.push((frame, weight * references.iter().map(fit).fold(0.0, f64::max)));
    }
    // A stable sort: of frames that fit alike the likelier stays first.
    fits.sort_by(|a, b| b.1.total_cmp(&a.1));
    in_frames(&phrase, &fits)
}

/// The best frame's fit, and by how much it beat the next.
fn in_frames(phrase: &str, fits: &[(Frame, f64)]) -> Factor {
    let Some(&(frame, value)) = fits.first() else {
        return Factor { value: 0.0, reading: format!("{phrase} in no frame") };
    };
    let next = fits.get(1).map(|(frame, value)| format!(", {} {value:.2}", frame.name())).unwrap_or_default();
    Factor { value, reading: format!("{phrase} {value:.2} ({} frame{next})", frame.name()) }
}

/// Furniture that a noun can refer to: what may be of that category, else of its class, with how sure the robot is.
pub fn references(beliefs: &Beliefs, noun: &str, lexicon: &Lexicon) -> Vec<(usize, f64)> {
    let believed = |is: &dyn Fn(&str) -> bool| -> Vec<(usize, f64)> {
        let all = beliefs.furniture.iter().map(|furniture| furniture.belief(is)).enumerate();
        all.filter(|(_, belief)| *belief >= DOUBTFUL).collect()
    };
    let exact = believed(&|category| category == noun);
    if !exact.is_empty() {
        return exact;
    }
    let Some(class) = lexicon.class_of(noun).filter(|class| *class != Class::Object) else { return Vec::new() };
    believed(&|category| lexicon.class_of(category) == Some(class))
}

/// An object as landmark: seen, it is near or not; unseen, it says nothing.
fn object_factor(candidate: &Furniture, beliefs: &Beliefs, noun: &str, phrase: &str) -> Factor {
    match beliefs.sighting(Some(noun)) {
        Some(seen) => {
            let value = if candidate.footprint().distance_to(vec2(seen.x, seen.y)) < 0.5 { 1.0 } else { 0.1 };
            Factor { value, reading: format!("{phrase} {value:.2}") }
        }
        None => Factor { value: UNSEEN, reading: format!("{phrase} not seen") },
    }
}

/// At which pair a search in vain went wrong, and why; nothing when something fitted every pair.
pub fn blame(beliefs: &Beliefs, wanted: &Wanted, place: Place, lexicon: &Lexicon) -> Option<String> {
    let candidates = candidates(beliefs, wanted.target.as_deref(), lexicon);
    if candidates.is_empty() {
        let target = wanted.target.as_deref().unwrap_or("table").replace('_', " ");
        return Some(format!("no {target} was seen"));
    }
    let best = |pair: &SearchPair| {
        let fit = |&i: &usize| pair_factor(i, beliefs, pair, wanted.one_frame, place, lexicon).value;
        candidates.iter().map(fit).fold(0.0, f64::max)
    };
    let unseen = |noun: &str| {
        lexicon.class_of(noun).is_some_and(Class::is_furniture) && references(beliefs, noun, lexicon).is_empty()
    };
    wanted.pairs.iter().enumerate().find_map(|(i, pair)| {
        let phrase = pair.pair.phrase();
        if let Some(noun) = pair.pair.reference.thing().filter(|noun| unseen(noun)) {
            return Some(format!("at pair {}, {phrase}: no {} was seen", i + 1, noun.replace('_', " ")));
        }
        let best = best(pair);
        (best < UNFULFILLED)
            .then(|| format!("at pair {}, {phrase}: nothing seen stands there, the best fits {best:.2}", i + 1))
    })
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
    0.5_f64.powf(candidate.footprint().distance(reference.footprint()))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::behavior::motion::RoomFrame;
    use crate::geometry::{Polygon, Pose};
    use crate::perception::View;
    use crate::planning::frames_to_try;
    use crate::record::{Detection, Pair};

    /// Entered northward; the robot looks north from the middle.
    fn room() -> RoomFrame {
        let outline = Polygon::rectangle(Pose::new(0.0, 4.0, FRAC_PI_2), 8.0, 8.0);
        RoomFrame { outline, entry: Pose::new(0.0, 0.7, FRAC_PI_2) }
    }

    fn seen(pieces: &[(&str, f64, f64, Option<f64>)]) -> Beliefs {
        let mut beliefs = Beliefs::default();
        for &(category, x, y, yaw) in pieces {
            let corners = [(-0.3, -0.3), (0.3, -0.3), (0.3, 0.3), (-0.3, 0.3)];
            let detection = Detection {
                category: category.to_string(),
                confidence: 1.0,
                scores: Default::default(),
                x,
                y,
                yaw,
                length: 0.6,
                width: 0.6,
                height: 0.5,
                footprint: corners.map(|(dx, dy)| [x + dx, y + dy]).to_vec(),
                attributes: Vec::new(),
                why: String::new(),
            };
            beliefs.take_in(&View { furniture: vec![detection], objects: Vec::new() }, vec2(-9.0, -9.0));
        }
        beliefs
    }

    fn pair(reference: &str, direction: Direction, frame: Frame) -> SearchPair {
        let pair =
            Pair { reference: Reference::of(reference), direction, frame, and: None, amount: None, ordinal: None };
        SearchPair { frames: frames_to_try(&pair, Lexicon::embedded()), pair }
    }

    /// The pieces in the order in which they would be tried.
    fn order(beliefs: &Beliefs, pairs: Vec<SearchPair>) -> Vec<usize> {
        let wanted = Wanted { target: Some("table".to_string()), pairs, ..Wanted::default() };
        let (room, arrived) = (room(), Pose::new(0.0, 3.0, FRAC_PI_2));
        let ranked = rank(beliefs, &wanted, Place { room: &room, arrived }, Lexicon::embedded());
        ranked.iter().map(|ranked| ranked.index).collect()
    }

    #[test]
    fn on_the_right_looks_to_the_robots_right_as_it_arrived() {
        let beliefs = seen(&[("table", -1.5, 3.0, None), ("table", 2.5, 3.5, None)]);
        assert_eq!(order(&beliefs, vec![pair("robot", Direction::Right, Frame::Robot)])[0], 1);
        assert_eq!(order(&beliefs, vec![pair("robot", Direction::Left, Frame::Robot)])[0], 0);
    }

    #[test]
    fn with_nothing_said_the_table_nearest_to_the_heading_is_tried_first() {
        let beliefs = seen(&[("table", 0.3, 1.0, None), ("table", 0.3, 5.2, None)]);
        assert_eq!(order(&beliefs, Vec::new()), [1, 0]);
    }

    #[test]
    fn at_the_left_wall_is_the_one_beside_it_not_the_one_half_way() {
        let beliefs = seen(&[("table", -1.5, 4.5, None), ("table", -3.5, 3.0, None)]);
        assert_eq!(order(&beliefs, vec![pair("wall", Direction::Left, Frame::Viewer)])[0], 1);
    }

    #[test]
    fn a_relation_is_read_as_on_entering_first_and_by_the_items_own_front_next() {
        // The couch looks north, away from the door: what is before it is behind it as on entering.
        let beliefs =
            seen(&[("table", 1.0, 3.5, None), ("couch", 1.0, 5.0, Some(FRAC_PI_2)), ("table", 1.0, 6.5, None)]);
        let behind = pair("couch", Direction::Back, Frame::Viewer);
        assert_eq!(order(&beliefs, vec![behind.clone()]), [2, 0]);
        let only_front = seen(&[("table", 1.0, 3.5, None), ("couch", 1.0, 5.0, Some(FRAC_PI_2))]);
        let wanted = Wanted { pairs: vec![behind], ..Wanted::default() };
        let (room, arrived) = (room(), Pose::new(0.0, 3.0, FRAC_PI_2));
        let ranked = rank(&only_front, &wanted, Place { room: &room, arrived }, Lexicon::embedded());
        assert!(ranked[0].reading.contains("(intrinsic frame, facing"), "{}", ranked[0].reading);
    }

    #[test]
    fn a_search_in_vain_is_blamed_on_the_first_pair_that_nothing_fits() {
        let beliefs = seen(&[("table", -1.5, 3.0, None)]);
        let (room, arrived) = (room(), Pose::new(0.0, 3.0, FRAC_PI_2));
        let place = Place { room: &room, arrived };
        let because = |pairs| blame(&beliefs, &Wanted { pairs, ..Wanted::default() }, place, Lexicon::embedded());
        let left = pair("robot", Direction::Left, Frame::Robot);
        assert_eq!(because(vec![left.clone()]), None);
        let couch = because(vec![left, pair("couch", Direction::Back, Frame::Viewer)]);
        assert_eq!(couch.as_deref(), Some("at pair 2, back of the couch: no couch was seen"));
        let right = because(vec![pair("robot", Direction::Right, Frame::Robot)]).unwrap_or_default();
        assert!(right.starts_with("at pair 1, right of the robot: nothing seen stands there"), "{right}");
    }
}

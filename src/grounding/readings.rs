//! How sure the best reading is, what else could be meant, and the one question that settles it.

use crate::record::{Direction, Grounding, Node, ObjectSlot, Reading, RoomSlot};

/// What else could be meant.
#[derive(Clone, Debug, Default)]
pub struct Instead {
    /// Another object that was named.
    pub object: Option<ObjectSlot>,
    /// A side that was taken back.
    pub taken_back: Option<Direction>,
}

/// A smaller lead than this is worth a question.
const CLEAR_LEAD: f64 = 0.2;
/// What a reading loses when it takes the earlier of two pieces of furniture: people name the holder last.
const EARLIER_TARGET: f64 = 0.55;
/// What a reading loses when it takes the other of two objects.
const OTHER_OBJECT: f64 = 0.5;
/// What a reading loses when it takes back a correction.
const UNCORRECTED: f64 = 0.4;
/// What a reading with a room that nobody said is worth beside one that waits for it.
const GUESSED_SIDE: f64 = 0.9;

/// The parts of a reading stand and fall together more than independent ones would: the product of their scores is
/// too low by about its square root, measured on 150 spoken descriptions.
const DEPENDENCE: f64 = 0.5;

/// The confidence in the whole: the product of its parts', made up for their dependence.
pub fn score(grounding: &mut Grounding) {
    let nodes = grounding.nodes.iter().map(|node| node.score.0);
    let room = grounding.room.iter().map(|room| room.score.0);
    let object = grounding.object.iter().map(|object| object.score.0);
    grounding.score = nodes.chain(room).chain(object).product::<f64>().clamp(0.0, 1.0).powf(DEPENDENCE).into();
}

/// Fills in `readings`, `margin` and `question`.
pub fn rank(grounding: &mut Grounding, instead: &Instead) {
    let mut readings: Vec<(Reading, String)> = Vec::new();
    readings.extend(other_target(grounding));
    readings.extend(other_object(grounding, instead.object.as_ref()));
    readings.extend(uncorrected_room(grounding, instead.taken_back));
    readings.extend(either_room(grounding));
    readings.sort_by(|a, b| b.0.score.0.total_cmp(&a.0.score.0));
    let next = readings.first().map_or(0.0, |(reading, _)| reading.score.0);
    let margin = (grounding.score.0 - next).max(0.0);
    grounding.margin = margin.into();
    grounding.question = readings.first().filter(|_| margin < CLEAR_LEAD).map(|(_, question)| question.clone());
    if grounding.question.is_none()
        && grounding.object.is_none()
        && !names_target(grounding)
        && grounding.room.is_some()
    {
        grounding.question = Some("What shall I look for, and on which furniture is it?".to_string());
    }
    grounding.readings = readings.into_iter().map(|(reading, _)| reading).collect();
}

fn names_target(grounding: &Grounding) -> bool {
    grounding.nodes.iter().any(|node| node.target.is_some())
}

/// The best reading with a lower score, to be changed in one place.
fn variant(grounding: &Grounding, factor: f64, because: &str) -> Reading {
    Reading {
        room: grounding.room.clone(),
        object: grounding.object.clone(),
        nodes: grounding.nodes.clone(),
        score: (grounding.score.0 * factor).into(),
        because: Some(because.to_string()),
    }
}

fn spoken(noun: &str) -> String {
    noun.replace('_', " ")
}

fn other_target(grounding: &Grounding) -> Option<(Reading, String)> {
    let named: Vec<&Node> = grounding.nodes.iter().filter(|node| node.target.is_some()).collect();
    let (last, rest) = named.split_last()?;
    let earlier = rest.iter().rev().find(|node| node.target != last.target)?;
    let (one, other) = (spoken(last.target.as_deref()?), spoken(earlier.target.as_deref()?));
    let mut reading = variant(grounding, EARLIER_TARGET, &format!("the {other} holds it, not the {one}"));
    reading.nodes.retain(|node| node.target != last.target);
    Some((reading, format!("Is it on the {one} or on the {other}?")))
}

fn other_object(grounding: &Grounding, instead: Option<&ObjectSlot>) -> Option<(Reading, String)> {
    let object = grounding.object.as_ref()?;
    let other = instead.filter(|other| other.name != object.name)?;
    let (one, another) = (spoken(&object.name), spoken(&other.name));
    let mut reading = variant(grounding, OTHER_OBJECT, &format!("the {another} is meant, not the {one}"));
    reading.object = Some(other.clone());
    Some((reading, format!("Do you want the {one} or the {another}?")))
}

/// What was taken back could have been meant after all.
fn uncorrected_room(grounding: &Grounding, taken_back: Option<Direction>) -> Option<(Reading, String)> {
    let room = grounding.room.as_ref()?;
    let side = room.side?;
    let taken_back = taken_back.filter(|said| *said == side.mirrored() && *said != side)?;
    let because = format!("the room on the {} after all", taken_back.name());
    let mut reading = variant(grounding, UNCORRECTED, &because);
    reading.room = Some(RoomSlot { side: Some(taken_back), ..room.clone() });
    Some((reading, format!("The room on the {} or the one on the {}?", side.name(), taken_back.name())))
}

/// No room was said: as it stands, or in one of the rooms.
fn either_room(grounding: &Grounding) -> Vec<(Reading, String)> {
    if grounding.room.is_some() || grounding.nodes.is_empty() && grounding.object.is_none() {
        return Vec::new();
    }
    let on = |side: Direction| {
        let mut reading = variant(grounding, GUESSED_SIDE, &format!("the room on the {}", side.name()));
        reading.room = Some(RoomSlot { side: Some(side), score: 0.5.into(), ..RoomSlot::default() });
        (reading, "Which room: the one on the left or the one on the right?".to_string())
    };
    vec![on(Direction::Left), on(Direction::Right)]
}

//! Takes the reply to a question into a grounding.

use super::meaning::pair;
use crate::language::tokens::tokenize;
use crate::language::{Class, Lexicon, Role, Unit, units};
use crate::record::{Direction, Grounding, Node, ObjectSlot, RoomSlot};

/// Changes `grounding` by what `reply` says: "the left one", "on the desk", "the mug", "the bedroom", "the second".
///
/// A side settles the room when the question was about the room or no room is known; else it tells where the
/// target stands. True when the reply said anything that could be used.
pub fn answer(grounding: &mut Grounding, reply: &str, lexicon: &Lexicon) -> bool {
    let words = tokenize(reply);
    let units = units(&words, lexicon);
    let mut used = false;
    for unit in &units {
        used |= take(grounding, unit);
    }
    if used {
        grounding.question = None;
        grounding.readings.clear();
        grounding.margin = grounding.score;
        grounding.warnings.push(format!("the answer \"{reply}\" was taken into account"));
    }
    used
}

fn take(grounding: &mut Grounding, unit: &Unit) -> bool {
    if unit.has(Role::Side) {
        take_side(grounding, if unit.lower == "left" { Direction::Left } else { Direction::Right });
        return true;
    }
    if unit.has(Role::Ordinal) {
        return take_ordinal(grounding, &unit.lower);
    }
    let Some(noun) = unit.noun.filter(|noun| !noun.inferred) else { return false };
    match noun.class {
        Class::Room if noun.name == "room" => return false,
        Class::Room => room(grounding).name = Some(noun.name.to_string()),
        Class::Object => {
            grounding.object =
                Some(ObjectSlot { name: noun.name.to_string(), score: 0.97.into(), ..ObjectSlot::default() });
        }
        class if class.is_furniture() => settle_target(grounding, noun.name),
        _ => return false,
    }
    true
}

fn room(grounding: &mut Grounding) -> &mut RoomSlot {
    grounding.room.get_or_insert_with(|| RoomSlot { score: 0.95.into(), ..RoomSlot::default() })
}

fn take_side(grounding: &mut Grounding, side: Direction) {
    let about_room = grounding.question.as_ref().is_some_and(|question| question.to_lowercase().contains("room"));
    match grounding.nodes.iter_mut().rev().find(|node| node.target.is_some()) {
        Some(node) if !about_room && grounding.room.is_some() => node.pairs.push(pair("robot", side)),
        _ => room(grounding).side = Some(side),
    }
}

/// Of several targets the one named is kept; a new one takes the place of the last.
fn settle_target(grounding: &mut Grounding, name: &str) {
    let same = |node: &Node| node.target.as_deref() == Some(name);
    if grounding.nodes.iter().any(same) {
        grounding.nodes.retain(|node| node.target.is_none() || same(node));
        return;
    }
    match grounding.nodes.iter_mut().rev().find(|node| node.target.is_some()) {
        Some(node) => node.target = Some(name.to_string()),
        None => grounding.nodes.push(Node { target: Some(name.to_string()), score: 0.95.into(), ..Node::default() }),
    }
}

fn take_ordinal(grounding: &mut Grounding, word: &str) -> bool {
    let ordinal = ["first", "second", "third", "fourth"].iter().position(|name| *name == word);
    let node = grounding.nodes.iter_mut().rev().find(|node| node.target.is_some());
    match (ordinal, node) {
        (Some(ordinal), Some(node)) => {
            node.ordinal = Some(ordinal as u32 + 1);
            true
        }
        _ => false,
    }
}

//! Which words pick the room.
//!
//! The first left or right said picks it, unless a correction follows or a
//! room or door is named with a later one (`docs/annotation.md`). A side
//! beside furniture is a place, and after a room that is named outright a
//! turn is a turn inside it.

use super::phrase::{From, Kind, Phrase};
use super::unit::Unit;
use super::word_class::{Class, Role};
use crate::record::Direction;

/// The phrases that pick the room.
#[derive(Clone, Debug, PartialEq)]
pub struct RoomPick {
    /// The phrase that says which.
    pub first: usize,
    /// The last phrase that still belongs to it: "… into the room".
    pub last: usize,
    /// Phrases elsewhere that say the same again.
    pub restated: Vec<usize>,
    /// Doors passed or reached before the room is picked: they make nothing.
    pub on_the_way: Vec<usize>,
}

impl RoomPick {
    /// Whether a phrase is part of the pick.
    pub fn covers(&self, index: usize) -> bool {
        (self.first..=self.last).contains(&index)
    }
}

/// Whether a phrase before the room only leads to it.
pub fn is_lead(phrase: &Phrase) -> bool {
    matches!(phrase.kind, Kind::Go | Kind::Turn)
}

/// The phrases that pick the room; none when nothing said does.
pub fn pick(phrases: &[Phrase], units: &[Unit]) -> Option<RoomPick> {
    let reader = Reader { phrases, units };
    let first = reader.first()?;
    let last = reader.last_of(first);
    let restated = reader.restated(first, last);
    let on_the_way = (0..reader.first_thing(first)).filter(|&i| reader.is_on_the_way(i)).collect();
    Some(RoomPick { first, last, restated, on_the_way })
}

struct Reader<'p> {
    phrases: &'p [Phrase],
    units: &'p [Unit<'p>],
}

impl Reader<'_> {
    fn kind(&self, at: usize) -> Option<Kind> {
        self.phrases.get(at).map(|phrase| phrase.kind)
    }

    /// Left or right, of a turn, a place beside the hearer, or a room with its side.
    fn side(&self, at: usize) -> Option<Direction> {
        let phrase = self.phrases.get(at)?;
        let lateral = |direction: &Direction| matches!(direction, Direction::Left | Direction::Right);
        match phrase.kind {
            Kind::Turn | Kind::Side => phrase.directions[0].filter(lateral),
            Kind::Room => phrase.side,
            _ => None,
        }
    }

    /// The first phrase of the pick.
    fn first(&self) -> Option<usize> {
        let all = 0..self.phrases.len();
        let entered = all.clone().find(|&i| self.shows_inside(i)).unwrap_or(self.phrases.len());
        // "In the middle of the room on the left": the side is the room's, wherever it is said.
        let of_room = |i: usize| {
            i > 0
                && self.kind(i) == Some(Kind::Side)
                && self.kind(i - 1) == Some(Kind::Part)
                && self.phrases[i - 1].past == self.phrases[i].first
                && self.phrases[i - 1].noun().is_some_and(|noun| noun.class == Some(Class::Room))
                && self.units[self.phrases[i - 1].first..self.phrases[i - 1].past].iter().any(|unit| unit.lower == "of")
                && self.side(i).is_some()
        };
        if let Some(own) = all.clone().find(|&i| of_room(i)) {
            return Some(own);
        }
        let picks = |i: &usize| {
            self.side(*i).is_some()
                && !self.is_beside_furniture(*i)
                && (*i < entered || self.kind(*i) == Some(Kind::Room))
        };
        let mut sided = all.clone().filter(picks);
        let rooms = all.clone().filter(|&i| self.kind(i) == Some(Kind::Room));
        let rooms = rooms.clone().find(|&i| !self.is_passage(i)).or(rooms.clone().next());
        let Some(first) = sided.next() else { return rooms.or_else(|| self.lone_side(entered)) };
        let named = rooms.filter(|&room| {
            room < first && !self.is_passage(room) && self.is_named(room) && !self.is_sided_by_next(room)
        });
        // "It's in the bedroom so go right": the room is only mentioned, and the turn leads to it.
        let leads = named.is_some_and(|room| {
            self.kind(first) == Some(Kind::Turn)
                && !self.phrases[room].is_moved(self.units)
                && !(room..first).any(|i| self.is_inside(i))
                && self.phrases[first].past < self.units.len()
        });
        if named.is_some() && !leads {
            return named;
        }
        let inside = (first..self.phrases.len()).find(|&i| self.is_inside(i)).unwrap_or(self.phrases.len());
        let corrected = (0..inside).find(|&i| self.kind(i) == Some(Kind::Corrected));
        if let Some(again) = corrected.and_then(|at| (at..inside).find(|&i| self.enters(i))) {
            return Some(again);
        }
        if self.kind(first) == Some(Kind::Room) || self.enters(first) {
            return Some(first);
        }
        let later = (first + 1..inside).find(|&i| self.kind(i) == Some(Kind::Room) && self.side(i).is_some());
        let later = later.or_else(|| (first + 1..inside).find(|&i| self.side(i).is_some() && self.enters(i)));
        Some(later.unwrap_or(first))
    }

    /// "On the table to the right", and no room said: the side picks it, unless furniture itself is asked for.
    fn lone_side(&self, entered: usize) -> Option<usize> {
        let asked = self
            .phrases
            .iter()
            .any(|phrase| phrase.kind == Kind::Target && phrase.relation.is_none() && !phrase.is_reached());
        let side = (0..entered).find(|&i| self.kind(i) == Some(Kind::Side) && self.side(i).is_some());
        side.filter(|_| !asked)
    }

    /// What shows that the robot is in the room already: it turns round, faces something, or has reached furniture.
    fn shows_inside(&self, at: usize) -> bool {
        let phrase = &self.phrases[at];
        match phrase.kind {
            Kind::Turn => {
                phrase.directions[0] == Some(Direction::Back)
                    && self.units[phrase.first..phrase.past]
                        .iter()
                        .any(|unit| matches!(unit.lower.as_ref(), "around" | "round"))
            }
            Kind::Perspective => phrase.from == From::Nouns,
            Kind::Target | Kind::Landmark => phrase.is_reached(),
            _ => false,
        }
    }

    /// A turn right before "into the room".
    fn enters(&self, at: usize) -> bool {
        self.side(at).is_some() && self.kind(at + 1) == Some(Kind::Room) && self.side(at + 1).is_none()
    }

    /// Furniture, landmarks and parts of a room are inside it.
    fn is_inside(&self, at: usize) -> bool {
        matches!(self.kind(at), Some(Kind::Target | Kind::Landmark | Kind::Part | Kind::ObjectMark))
    }

    /// "On the table to the right": a side said of furniture is a place.
    fn is_beside_furniture(&self, at: usize) -> bool {
        let furniture = |kind| matches!(kind, Some(Kind::Target | Kind::Landmark | Kind::ObjectMark));
        let after =
            self.phrases[..at].iter().rposition(|p| matches!(p.kind, Kind::Target | Kind::Landmark | Kind::Stop));
        self.kind(at) == Some(Kind::Side) && after.is_some_and(|i| furniture(self.kind(i)))
    }

    /// "The bedroom", not "the room" or "the door".
    fn is_named(&self, at: usize) -> bool {
        let phrase = &self.phrases[at];
        self.units[phrase.first..phrase.past]
            .iter()
            .filter_map(|unit| unit.noun)
            .any(|noun| noun.class == Class::Room && noun.name != "room")
    }

    /// A hallway or a crossing on the way.
    fn is_passage(&self, at: usize) -> bool {
        let phrase = &self.phrases[at];
        phrase.noun().is_some_and(|noun| {
            let name = &self.units[noun.head].lower;
            name.contains("hall") || matches!(name.as_ref(), "corridor" | "intersection" | "junction")
        })
    }

    /// "In the living room … on the right", the side right after the room.
    fn is_sided_by_next(&self, room: usize) -> bool {
        self.kind(room + 1) == Some(Kind::Side)
            && self.side(room + 1).is_some()
            && self.phrases[room].past == self.phrases[room + 1].first
    }

    /// Rooms that follow belong to the pick, and so does the door at which to turn.
    fn last_of(&self, first: usize) -> usize {
        let mut last = first;
        while let Some(next) = self.phrases.get(last + 1) {
            let room = next.kind == Kind::Room && self.side(last + 1).is_none_or(|side| Some(side) == self.side(first));
            let door = next.kind == Kind::Part
                && matches!(self.kind(first), Some(Kind::Turn | Kind::Side))
                && self.phrases[last].past == next.first
                && self.is_door(next);
            let own_side = last == first
                && self.kind(first) == Some(Kind::Room)
                && self.is_sided_by_next(first)
                && self.side(first).is_none();
            if !(room || door || own_side) {
                break;
            }
            last += 1;
        }
        last
    }

    /// The first furniture or object before `past`: what follows it is not on the way to the room.
    fn first_thing(&self, past: usize) -> usize {
        let thing = |kind| matches!(kind, Kind::Target | Kind::Landmark | Kind::ObjectMark | Kind::Object);
        self.phrases[..past].iter().position(|phrase| thing(phrase.kind)).unwrap_or(past)
    }

    /// A door that is passed, and "straight ahead (and take a left)".
    fn is_on_the_way(&self, at: usize) -> bool {
        let phrase = &self.phrases[at];
        match phrase.kind {
            Kind::Part => self.is_door(phrase),
            Kind::Side => self.units[phrase.first].has(Role::Ahead) && self.side(at).is_none(),
            _ => false,
        }
    }

    fn is_door(&self, phrase: &Phrase) -> bool {
        let units = &self.units[phrase.first..phrase.past];
        units.iter().any(|unit| unit.class() == Some(Class::Opening))
    }

    /// The room's side said again: before the pick, or with "into the room" after it.
    fn restated(&self, first: usize, last: usize) -> Vec<usize> {
        let Some(side) = self.side(last).or_else(|| self.side(first)) else { return Vec::new() };
        let same = |&i: &usize| self.side(i) == Some(side);
        let before = (0..first).filter(|&i| self.kind(i) == Some(Kind::Side));
        let after = (last + 1..self.phrases.len()).filter(|&i| self.kind(i) == Some(Kind::Room) || self.enters(i));
        before.chain(after).filter(same).collect()
    }
}

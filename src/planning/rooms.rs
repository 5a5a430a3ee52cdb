//! Which room was meant: by name, by synonym, by side as seen from the start pose.

use crate::map::RoomMap;
use crate::record::{Direction, RoomSlot};

/// The room to enter, the rooms to try after it, and what did not fit.
#[derive(Debug, Default, PartialEq)]
pub struct RoomChoice {
    /// The room meant, when one is.
    pub room: Option<String>,
    /// Rooms to try when the object is not there, or when none was said, in order.
    pub candidates: Vec<String>,
    /// What did not fit the map, and what the map has.
    pub problem: Option<String>,
    /// Whether the problem leaves nothing to do.
    pub fatal: bool,
}

/// Resolves what was said of the room on this map.
///
/// Where name and side disagree the side decides, and the named room is tried
/// next: people who visit a home for the first time err in the name of a room
/// far oftener than in left and right.
pub fn choose_room(said: Option<&RoomSlot>, map: &RoomMap) -> RoomChoice {
    let Some(said) = said else { return any_room(map) };
    let named = match &said.name {
        None => Vec::new(),
        Some(name) => match map.rooms_called(name) {
            rooms if rooms.is_empty() && said.side.is_none() => return unknown_room(name, map),
            rooms => rooms,
        },
    };
    let beside = said.side.map(|side| map.rooms_on(side)).unwrap_or_default();
    let both: Vec<String> = named.iter().filter(|room| beside.contains(room)).cloned().collect();
    match (said.side, &said.name) {
        (Some(side), _) if beside.is_empty() && named.is_empty() => no_room_there(side, map),
        (Some(side), Some(name)) if both.is_empty() && !beside.is_empty() => RoomChoice {
            room: Some(beside[0].clone()),
            candidates: [&beside[1..], &named].concat(),
            problem: Some(disagreement(name, side, &named, &beside[0])),
            fatal: false,
        },
        (Some(_), _) if !both.is_empty() => pick(both, said.ordinal),
        (Some(_), _) if !beside.is_empty() => pick(beside, said.ordinal),
        _ if named.is_empty() => any_room(map),
        _ => pick(named, said.ordinal),
    }
}

fn pick(rooms: Vec<String>, ordinal: Option<u32>) -> RoomChoice {
    let at = ordinal.map_or(0, |n| n.max(1) as usize - 1).min(rooms.len().saturating_sub(1));
    let mut rest = rooms;
    let room = rest.remove(at);
    RoomChoice { room: Some(room), candidates: rest, ..RoomChoice::default() }
}

fn any_room(map: &RoomMap) -> RoomChoice {
    let mut candidates = map.rooms_by_distance();
    if candidates.len() == 1 {
        return RoomChoice { room: candidates.pop(), ..RoomChoice::default() };
    }
    RoomChoice { candidates, ..RoomChoice::default() }
}

fn unknown_room(name: &str, map: &RoomMap) -> RoomChoice {
    let problem = format!("the map `{}` has no room called `{name}`; it has {}", map.name, names(map));
    RoomChoice { problem: Some(problem), fatal: true, ..RoomChoice::default() }
}

fn no_room_there(side: Direction, map: &RoomMap) -> RoomChoice {
    let places: Vec<String> = map
        .rooms_by_distance()
        .iter()
        .filter_map(|room| map.side_of(room).map(|side| format!("{room} ({})", side.name())))
        .collect();
    let problem = format!("the map `{}` has no room on the {}; it has {}", map.name, side.name(), places.join(", "));
    RoomChoice { problem: Some(problem), fatal: true, ..RoomChoice::default() }
}

fn disagreement(name: &str, side: Direction, named: &[String], chosen: &str) -> String {
    let side = side.name();
    if named.is_empty() {
        format!("the map has no room called `{name}`; going to the room on the {side}, `{chosen}`")
    } else {
        format!("`{name}` is not on the {side}; going to the room on the {side}, `{chosen}`, first")
    }
}

/// The rooms of a map, for people.
pub fn names(map: &RoomMap) -> String {
    map.rooms.iter().map(|room| format!("`{}`", room.name)).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn choose(name: Option<&str>, side: Option<Direction>) -> RoomChoice {
        let said = RoomSlot { name: name.map(str::to_string), side, ..RoomSlot::default() };
        choose_room(Some(&said), &RoomMap::apartment())
    }

    #[test]
    fn a_side_alone_picks_the_room() {
        assert_eq!(choose(None, Some(Direction::Right)).room.as_deref(), Some("living_room"));
        assert_eq!(choose(None, Some(Direction::Left)).room.as_deref(), Some("bedroom"));
    }

    #[test]
    fn a_name_alone_picks_the_room() {
        assert_eq!(choose(Some("bedroom"), None).room.as_deref(), Some("bedroom"));
    }

    #[test]
    fn the_side_decides_where_name_and_side_disagree_and_the_named_room_is_next() {
        let choice = choose(Some("bedroom"), Some(Direction::Right));
        assert_eq!(choice.room.as_deref(), Some("living_room"));
        assert_eq!(choice.candidates, ["bedroom"]);
        assert!(choice.problem.is_some() && !choice.fatal);
    }

    #[test]
    fn an_unknown_room_is_a_problem_that_lists_what_the_map_has() {
        let choice = choose(Some("kitchen"), None);
        let problem = choice.problem.unwrap_or_default();
        assert!(choice.fatal && problem.contains("`kitchen`") && problem.contains("`living_room`"), "{problem}");
    }

    #[test]
    fn with_nothing_said_every_room_but_the_start_is_a_candidate() {
        let choice = choose_room(None, &RoomMap::apartment());
        assert_eq!(choice.room, None);
        assert_eq!(choice.candidates.len(), 2);
    }
}

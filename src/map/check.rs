//! Room maps that cannot be.

use super::checker::{Checker, TOLERANCE_M, nearest_name};
use super::error::WorldError;
use super::room_map::{Door, RoomMap};
use crate::geometry::{Polygon, Vec2, distance_to_segment, segments_touch, vec2};

/// Checks a room map.
pub(super) fn check_map(map: &RoomMap, file: &str) -> Result<(), WorldError> {
    let checker = Checker { file };
    checker.version(map.version)?;
    checker.unique("room", map.rooms.iter().map(|room| room.name.as_str()))?;
    checker.unique("door", map.doors.iter().map(|door| door.id.as_str()))?;
    let tall = map.wall_height.is_finite() && map.wall_height > 0.0;
    checker.require(tall, "wall_height", || "must be more than 0 m; 2.5 is usual".to_string())?;
    checker.require(!map.rooms.is_empty(), "rooms", || "a map needs at least one room".to_string())?;
    for room in &map.rooms {
        check_outline(&checker, &format!("room `{}`", room.name), &room.outline)?;
    }
    check_overlaps(&checker, map)?;
    let finite = map.inner_walls.iter().flatten().flatten().all(|v| v.is_finite());
    checker.require(finite, "inner_walls", || "an end is not a number".to_string())?;
    for door in &map.doors {
        check_door(&checker, map, door)?;
    }
    let start = map.start.position();
    checker
        .require(map.start.heading.is_finite(), "start", || "the heading must be a number of radians".to_string())?;
    checker.require(map.room_at(start).is_some(), "start", || {
        format!("({}, {}) lies in no room; move it into one, a hallway for example", start.x, start.y)
    })
}

fn check_outline(checker: &Checker, item: &str, outline: &[[f64; 2]]) -> Result<(), WorldError> {
    checker.require(outline.len() >= 3, item, || "an outline needs at least three corners".to_string())?;
    checker
        .require(outline.iter().flatten().all(|v| v.is_finite()), item, || "a corner is not a number".to_string())?;
    let polygon = Polygon::new(outline.iter().map(|&[x, y]| vec2(x, y)).collect());
    checker.require(polygon.area() > 0.1, item, || {
        "the outline has next to no area; corners are [x, y] in metres, in order round the room".to_string()
    })?;
    let edges: Vec<(Vec2, Vec2)> = polygon.edges().collect();
    let n = edges.len();
    for i in 0..n {
        for j in i + 2..n {
            let neighbours = i == 0 && j == n - 1;
            let crossing = !neighbours && segments_touch(edges[i].0, edges[i].1, edges[j].0, edges[j].1);
            checker.require(!crossing, item, || {
                format!("walls {} and {} of the outline cross; give its corners in order round the room", i + 1, j + 1)
            })?;
        }
    }
    Ok(())
}

fn check_overlaps(checker: &Checker, map: &RoomMap) -> Result<(), WorldError> {
    for (i, a) in map.rooms.iter().enumerate() {
        for b in &map.rooms[i + 1..] {
            let (p, q) = (a.polygon(), b.polygon());
            if let Some(at) = shared_point(&p, &q).or_else(|| shared_point(&q, &p)) {
                let message = format!(
                    "overlaps room `{}` at ({:.2}, {:.2}); move their outlines until they share a wall at most",
                    b.name, at.x, at.y
                );
                return Err(checker.wrong(format!("room `{}`", a.name), message));
            }
        }
    }
    Ok(())
}

/// A point of `p`'s outline that lies inside `q`, or a point inside both.
fn shared_point(p: &Polygon, q: &Polygon) -> Option<Vec2> {
    const STEP_M: f64 = 0.05;
    const GRID: usize = 12;
    let deep = |point: &Vec2| {
        q.contains(*point) && q.edges().all(|(a, b)| distance_to_segment(*point, a, b) > 2.0 * TOLERANCE_M)
    };
    let on_outline = p.edges().flat_map(|(a, b)| {
        let steps = ((b - a).norm() / STEP_M).ceil().max(1.0) as usize;
        (0..steps).map(move |i| a + (b - a) * (i as f64 / steps as f64))
    });
    let (low, high) = p.bounds();
    let across = |k: usize| (k as f64 + 0.5) / GRID as f64;
    let within = (0..GRID * GRID)
        .map(|k| low + (high - low).component_mul(&vec2(across(k % GRID), across(k / GRID))))
        .filter(|point| p.contains(*point));
    on_outline.chain(within).find(deep)
}

fn check_door(checker: &Checker, map: &RoomMap, door: &Door) -> Result<(), WorldError> {
    let item = format!("door `{}`", door.id);
    let numbers = door.at.iter().chain([&door.width]).all(|v| v.is_finite());
    checker
        .require(numbers && door.width > 0.0, &item, || "`at` needs two numbers, `width` one above 0 m".to_string())?;
    for name in &door.between {
        let Some(room) = map.room(name) else {
            let names: Vec<&str> = map.rooms.iter().map(|room| room.name.as_str()).collect();
            let meant =
                nearest_name(name, names.iter().copied()).map_or(String::new(), |n| format!("; did you mean `{n}`?"));
            let message =
                format!("leads to `{name}`, which is no room of the map{meant} (it has {})", names.join(", "));
            return Err(checker.wrong(&item, message));
        };
        checker.require(map.door_is_in_wall(door, room), &item, || {
            format!("does not lie in a wall of `{name}`; move it onto the wall, its whole width within one edge")
        })?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map_error(change: impl FnOnce(&mut RoomMap)) -> String {
        let mut map = RoomMap::apartment();
        change(&mut map);
        check_map(&map, "home.json").expect_err("a wrong map").to_string()
    }

    #[test]
    fn a_door_that_is_in_no_wall_is_named() {
        let error = map_error(|map| map.doors[1].at = [2.63, -2.0]);
        assert!(error.starts_with("home.json: door `bedroom_door`: does not lie in a wall"), "{error}");
    }

    #[test]
    fn rooms_that_overlap_are_named() {
        let error = map_error(|map| map.rooms[1].outline[0] = [1.57, 0.0]);
        assert!(error.contains("room `hallway`: overlaps room `living_room`"), "{error}");
    }

    #[test]
    fn a_start_outside_every_room_is_refused() {
        assert!(map_error(|map| map.start.x = 50.0).contains("start: (50, 0) lies in no room"));
    }

    #[test]
    fn rooms_that_overlap_by_a_hand_are_found() {
        let error = map_error(|map| map.rooms[1].outline[0] = [1.57, 1.2]);
        assert!(error.contains("overlaps room `living_room` at ("), "{error}");
    }

    #[test]
    fn a_door_to_a_room_misspelt_says_which_was_meant() {
        let error = map_error(|map| map.doors[0].between[1] = "livingroom".to_string());
        assert!(error.contains("`livingroom`, which is no room of the map; did you mean `living_room`?"), "{error}");
    }
}

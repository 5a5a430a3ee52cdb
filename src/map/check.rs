//! Room maps that cannot be.

use super::checker::{Checker, TOLERANCE_M, nearest_name};
use super::error::WorldError;
use super::room_map::{Door, Room, RoomMap};
use crate::geometry::{Polygon, Vec2, distance_to_segment, segments_touch, vec2};
use crate::limits::{
    HOME_COORDINATE_M, HOME_CORNERS, HOME_DOORS, HOME_EXTENT_M, HOME_INNER_WALLS, HOME_ROOMS, WALL_HEIGHT_M,
};

/// Checks a room map.
pub(super) fn check_map(map: &RoomMap, file: &str) -> Result<(), WorldError> {
    let checker = Checker { file };
    checker.version(map.version)?;
    check_counts(&checker, map)?;
    checker.unique("room", map.rooms.iter().map(|room| room.name.as_str()))?;
    checker.unique("door", map.doors.iter().map(|door| door.id.as_str()))?;
    let tall = map.wall_height > 0.0 && map.wall_height <= WALL_HEIGHT_M.value as f64;
    checker.require(tall, "wall_height", || {
        format!("{} must be more than 0 m and at most {}; 2.5 is usual", map.wall_height, WALL_HEIGHT_M.value)
    })?;
    checker.require(!map.rooms.is_empty(), "rooms", || "a map needs at least one room".to_string())?;
    check_extent(&checker, map)?;
    for room in &map.rooms {
        check_outline(&checker, &format!("room `{}`", room.name), &room.outline)?;
    }
    check_overlaps(&checker, map)?;
    for door in &map.doors {
        check_door(&checker, map, door)?;
    }
    let start = map.start.position();
    checker
        .require(map.start.heading.abs() <= 1e3, "start", || "the heading must be a number of radians".to_string())?;
    checker.require(map.room_at(start).is_some(), "start", || {
        format!("({}, {}) lies in no room; move it into one, a hallway for example", start.x, start.y)
    })
}

/// Before anything is compared with anything.
fn check_counts(checker: &Checker, map: &RoomMap) -> Result<(), WorldError> {
    let corners = map.rooms.iter().map(|room| room.outline.len()).sum();
    let counts = [
        ("rooms", HOME_ROOMS, map.rooms.len()),
        ("doors", HOME_DOORS, map.doors.len()),
        ("rooms", HOME_CORNERS, corners),
        ("inner_walls", HOME_INNER_WALLS, map.inner_walls.len()),
    ];
    counts.into_iter().try_for_each(|(item, limit, found)| checker.within(limit, item, found))
}

/// Before memory is taken for its floor: a home is so many metres long, and not so many millimetres.
fn check_extent(checker: &Checker, map: &RoomMap) -> Result<(), WorldError> {
    let far = HOME_COORDINATE_M.value as f64;
    let corners = map.rooms.iter().flat_map(|room| room.outline.iter().map(move |corner| (room, corner)));
    for (room, corner) in corners.clone() {
        checker.require(corner.iter().all(|v| v.abs() <= far), &format!("room `{}`", room.name), || {
            format!("the corner ({}, {}) must be two numbers of metres, none beyond {far}", corner[0], corner[1])
        })?;
    }
    let walls = map.inner_walls.iter().flatten();
    checker.require(walls.clone().flatten().all(|v| v.abs() <= far), "inner_walls", || {
        format!("an end is not two numbers of metres, none beyond {far}")
    })?;
    let start = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY));
    let all = corners.map(|(_, corner)| corner).chain(walls).map(|&[x, y]| vec2(x, y));
    let (low, high) = all.fold(start, |(low, high), c| (low.inf(&c), high.sup(&c)));
    let size = high - low;
    checker.require(size.max() <= HOME_EXTENT_M.value as f64, "rooms", || {
        let unit = match size.max() {
            // What is a home of the usual size then.
            m if (3_000.0..=200_000.0).contains(&m) => "; are these millimetres? Divide them by 1000",
            m if m < 3_000.0 => "; are these centimetres or feet?",
            _ => "",
        };
        let most = HOME_EXTENT_M.value;
        format!("the home measures {:.0} × {:.0} m, more than the {most} m that are taken{unit}", size.x, size.y)
    })
}

fn check_outline(checker: &Checker, item: &str, outline: &[[f64; 2]]) -> Result<(), WorldError> {
    checker.require(outline.len() >= 3, item, || "an outline needs at least three corners".to_string())?;
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
    let polygons: Vec<Polygon> = map.rooms.iter().map(Room::polygon).collect();
    let boxes: Vec<(Vec2, Vec2)> = polygons.iter().map(Polygon::bounds).collect();
    // Rooms side by side share an edge of their boxes, and no more.
    let near = |i: usize, j: usize| {
        let shared = boxes[i].1.inf(&boxes[j].1) - boxes[i].0.sup(&boxes[j].0);
        shared.min() > TOLERANCE_M
    };
    for (i, a) in map.rooms.iter().enumerate() {
        for (j, b) in map.rooms.iter().enumerate().skip(i + 1).filter(|&(j, _)| near(i, j)) {
            let (p, q) = (&polygons[i], &polygons[j]);
            if let Some(at) = shared_point(p, q).or_else(|| shared_point(q, p)) {
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
    let (near, far) = q.bounds();
    let deep = |point: &Vec2| {
        *point >= near
            && *point <= far
            && q.contains(*point)
            && q.edges().all(|(a, b)| distance_to_segment(*point, a, b) > 2.0 * TOLERANCE_M)
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
    let far = HOME_COORDINATE_M.value as f64;
    let numbers = door.at.iter().chain([&door.width]).all(|v| v.abs() <= far);
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

    fn scaled(factor: f64) -> impl FnOnce(&mut RoomMap) {
        move |map| {
            map.rooms.iter_mut().flat_map(|room| &mut room.outline).flatten().for_each(|v| *v *= factor);
            map.doors.iter_mut().for_each(|door| door.at = door.at.map(|v| v * factor));
            (map.start.x, map.start.y) = (map.start.x * factor, map.start.y * factor);
        }
    }

    #[test]
    fn a_home_in_millimetres_is_asked_about_before_memory_is_taken_for_it() {
        let error = map_error(scaled(1000.0));
        assert!(error.contains("rooms: the home measures ") && error.contains("are these millimetres?"), "{error}");
        assert!(map_error(scaled(100.0)).contains("are these centimetres or feet?"));
        assert!(map_error(scaled(1e8)).contains("none beyond 100000"));
        assert!(map_error(scaled(1e307)).contains("none beyond 100000"));
    }

    #[test]
    fn a_home_has_so_many_rooms_corners_and_walls() {
        let many = |map: &mut RoomMap| map.inner_walls = vec![[[0.0, 0.0], [1.0, 0.0]]; 20_001];
        assert!(map_error(many).contains("inner_walls: 20001 inner walls are more than the 20000"));
        let rooms = |map: &mut RoomMap| map.rooms = vec![map.rooms[0].clone(); 201];
        assert!(map_error(rooms).contains("rooms: 201 rooms are more than the 200"));
    }

    #[test]
    fn walls_of_millimetres_are_refused() {
        assert!(
            map_error(|map| map.wall_height = 2500.0).contains("wall_height: 2500 must be more than 0 m and at most")
        );
        assert!(map_error(|map| map.wall_height = f64::NAN).contains("wall_height"));
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

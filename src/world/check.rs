//! Refuses a world that cannot be, naming the item and what mends it.

use std::collections::BTreeSet;

use super::error::WorldError;
use super::map::VERSION;
use super::{CATEGORIES, Item, RoomMap, Scene};
use crate::geometry::{Polygon, Vec2, segments_touch, vec2};

/// Furniture may come this near to a wall's line or stand this deep in another's outline: files are written by hand.
const TOLERANCE_M: f64 = 0.005;

struct Checker<'a> {
    file: &'a str,
}

impl Checker<'_> {
    fn wrong(&self, item: impl Into<String>, message: impl Into<String>) -> WorldError {
        WorldError::Wrong { file: self.file.to_string(), item: item.into(), message: message.into() }
    }

    fn require(&self, good: bool, item: &str, message: impl FnOnce() -> String) -> Result<(), WorldError> {
        if good { Ok(()) } else { Err(self.wrong(item, message())) }
    }

    fn version(&self, found: u32) -> Result<(), WorldError> {
        if found == VERSION {
            return Ok(());
        }
        Err(WorldError::Version { file: self.file.to_string(), found, known: VERSION })
    }

    fn unique<'i>(&self, kind: &str, ids: impl Iterator<Item = &'i str>) -> Result<(), WorldError> {
        let mut seen = BTreeSet::new();
        for id in ids {
            self.require(seen.insert(id), &format!("{kind} `{id}`"), || {
                "stands twice; give each its own name".to_string()
            })?;
        }
        Ok(())
    }
}

/// Checks a room map.
pub(super) fn check_map(map: &RoomMap, file: &str) -> Result<(), WorldError> {
    let checker = Checker { file };
    checker.version(map.version)?;
    checker.unique("room", map.rooms.iter().map(|room| room.name.as_str()))?;
    checker.unique("door", map.doors.iter().map(|door| door.id.as_str()))?;
    checker.require(map.wall_height > 0.0, "wall_height", || "must be more than 0 m".to_string())?;
    for room in &map.rooms {
        check_outline(&checker, &format!("room `{}`", room.name), &room.outline)?;
    }
    check_overlaps(&checker, map)?;
    for door in &map.doors {
        check_door(&checker, map, door)?;
    }
    let start = map.start.position();
    checker.require(map.room_at(start).is_some(), "start", || format!("({}, {}) lies in no room", start.x, start.y))
}

fn check_outline(checker: &Checker, item: &str, outline: &[[f64; 2]]) -> Result<(), WorldError> {
    checker.require(outline.len() >= 3, item, || "an outline needs at least three corners".to_string())?;
    checker
        .require(outline.iter().flatten().all(|v| v.is_finite()), item, || "a corner is not a number".to_string())?;
    let polygon = Polygon::new(outline.iter().map(|&[x, y]| vec2(x, y)).collect());
    checker.require(polygon.area() > 0.1, item, || "the outline has next to no area".to_string())?;
    let edges: Vec<(Vec2, Vec2)> = polygon.edges().collect();
    let n = edges.len();
    for i in 0..n {
        for j in i + 2..n {
            let neighbours = i == 0 && j == n - 1;
            let crossing = !neighbours && segments_touch(edges[i].0, edges[i].1, edges[j].0, edges[j].1);
            checker.require(!crossing, item, || format!("walls {} and {} of the outline cross", i + 1, j + 1))?;
        }
    }
    Ok(())
}

fn check_overlaps(checker: &Checker, map: &RoomMap) -> Result<(), WorldError> {
    for (i, a) in map.rooms.iter().enumerate() {
        for b in &map.rooms[i + 1..] {
            let (pa, pb) = (a.polygon(), b.polygon());
            let inside = |p: &Polygon, q: &Polygon| {
                let (low, high) = p.bounds();
                let steps = 24;
                (0..steps * steps).any(|k| {
                    let (u, v) = ((k % steps) as f64 + 0.5, (k / steps) as f64 + 0.5);
                    let point = low + vec2((high.x - low.x) * u / steps as f64, (high.y - low.y) * v / steps as f64);
                    p.contains(point) && q.contains(point)
                })
            };
            let overlap = inside(&pa, &pb) || inside(&pb, &pa);
            checker.require(!overlap, &format!("room `{}`", a.name), || format!("overlaps room `{}`", b.name))?;
        }
    }
    Ok(())
}

fn check_door(checker: &Checker, map: &RoomMap, door: &super::Door) -> Result<(), WorldError> {
    let item = format!("door `{}`", door.id);
    let numbers = door.at.iter().chain([&door.width]).all(|v| v.is_finite());
    checker.require(numbers && door.width > 0.0, &item, || "needs a place and a width above 0 m".to_string())?;
    for name in &door.between {
        let room = map.room(name);
        let Some(room) = room else {
            return Err(checker.wrong(&item, format!("leads to `{name}`, which is no room of the map")));
        };
        checker.require(map.door_is_in_wall(door, room), &item, || {
            format!("does not lie in a wall of `{name}`; move it onto the wall, its whole width within one edge")
        })?;
    }
    Ok(())
}

/// Checks a scene against its room map.
pub fn check(scene: &Scene, map: &RoomMap, file: &str) -> Result<(), WorldError> {
    let checker = Checker { file };
    checker.version(scene.version)?;
    checker.require(scene.map == map.name, "map", || {
        format!("the scene is for the map `{}`, the map given is `{}`", scene.map, map.name)
    })?;
    checker.unique("furniture", scene.furniture.iter().map(|item| item.id.as_str()))?;
    checker.unique("object", scene.objects.iter().map(|object| object.id.as_str()))?;
    for item in &scene.furniture {
        check_item(&checker, map, item)?;
    }
    check_places(&checker, scene)?;
    for object in &scene.objects {
        check_object(&checker, scene, object)?;
    }
    Ok(())
}

fn check_item(checker: &Checker, map: &RoomMap, item: &Item) -> Result<(), WorldError> {
    let name = format!("furniture `{}`", item.id);
    let known = CATEGORIES.iter().any(|category| category.name == item.category);
    checker.require(known, &name, || {
        let names: Vec<&str> = CATEGORIES.iter().map(|category| category.name).collect();
        format!("unknown category `{}`; known are {}", item.category, names.join(", "))
    })?;
    let size = item.size();
    let sizes = [size.length, size.width, size.height];
    checker
        .require(sizes.iter().all(|v| v.is_finite() && *v > 0.0), &name, || "sizes must be above 0 m".to_string())?;
    let numbers = [item.x, item.y, item.yaw_deg].iter().all(|v| v.is_finite());
    checker.require(numbers, &name, || "x, y and yaw_deg must be numbers".to_string())?;
    let footprint = item.footprint();
    let room = map.room_at(vec2(item.x, item.y));
    let Some(room) = room else {
        return Err(checker.wrong(&name, format!("({}, {}) lies in no room", item.x, item.y)));
    };
    let outside = footprint.corners().iter().find(|&&corner| room.polygon().distance_to(corner) > TOLERANCE_M);
    checker.require(outside.is_none(), &name, || {
        format!("reaches into a wall of `{}`; move it further into the room", room.name)
    })?;
    let in_doorway = map.doors.iter().find(|door| footprint.distance_to(door.middle()) < door.width / 2.0);
    checker.require(in_doorway.is_none(), &name, || {
        format!("stands in the door `{}`", in_doorway.map_or("", |door| door.id.as_str()))
    })?;
    let start = map.start.position();
    checker.require(footprint.distance_to(start) > 0.37, &name, || "stands where the robot starts".to_string())
}

fn check_places(checker: &Checker, scene: &Scene) -> Result<(), WorldError> {
    let outlines: Vec<Polygon> = scene.furniture.iter().map(Item::footprint).collect();
    for (i, a) in scene.furniture.iter().enumerate() {
        for (j, b) in scene.furniture.iter().enumerate().skip(i + 1) {
            // A chair may be pushed under a table; no two pieces share a middle.
            let tucked = [a, b].iter().any(|item| item.category == "chair" || item.category == "stool");
            let clash = if tucked {
                outlines[i].contains(vec2(b.x, b.y)) || outlines[j].contains(vec2(a.x, a.y))
            } else {
                outlines[i].touches(&outlines[j])
            };
            checker
                .require(!clash, &format!("furniture `{}`", b.id), || format!("stands in the place of `{}`", a.id))?;
        }
    }
    Ok(())
}

fn check_object(checker: &Checker, scene: &Scene, object: &super::PlacedObject) -> Result<(), WorldError> {
    let name = format!("object `{}`", object.id);
    let Some(holder) = scene.item(&object.on) else {
        return Err(checker.wrong(&name, format!("lies on `{}`, which is no furniture of the scene", object.on)));
    };
    let numbers = [object.forward, object.left, object.yaw_deg].iter().all(|v| v.is_finite());
    checker.require(numbers, &name, || "forward, left and yaw_deg must be numbers".to_string())?;
    let on_top = holder.footprint().contains(object.pose_on(holder).position());
    checker.require(on_top, &name, || format!("lies beside `{}`, not on it", object.on))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene_error(change: impl FnOnce(&mut Scene)) -> String {
        let mut scene = Scene::apartment();
        change(&mut scene);
        check(&scene, &RoomMap::apartment(), "home.json").expect_err("a wrong scene").to_string()
    }

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
    fn furniture_outside_every_room_or_in_a_wall_is_named() {
        assert!(
            scene_error(|s| s.furniture[0].x = 40.0).contains("furniture `round-table-1`: (40, 2) lies in no room")
        );
        let error = scene_error(|s| s.furniture[0].x = 7.1);
        assert!(error.contains("furniture `round-table-1`: reaches into a wall of `living_room`"), "{error}");
    }

    #[test]
    fn two_items_in_one_place_are_named() {
        let error = scene_error(|s| (s.furniture[2].x, s.furniture[2].y) = (4.5, 3.0));
        assert!(error.contains("furniture `coffee-table-1`: stands in the place of `couch-1`"), "{error}");
    }

    #[test]
    fn an_unknown_category_lists_the_known_ones() {
        let error = scene_error(|s| s.furniture[0].category = "throne".to_string());
        assert!(error.contains("unknown category `throne`; known are table, "), "{error}");
    }

    #[test]
    fn not_a_number_and_no_size_are_refused() {
        assert!(scene_error(|s| s.furniture[0].x = f64::NAN).contains("must be numbers"));
        assert!(scene_error(|s| s.furniture[0].length = Some(-1.0)).contains("sizes must be above 0 m"));
    }

    #[test]
    fn furniture_in_a_doorway_is_refused() {
        let error = scene_error(|s| (s.furniture[0].x, s.furniture[0].y) = (2.63, 1.7));
        assert!(error.contains("stands in the door `living_room_door`"), "{error}");
    }

    #[test]
    fn an_object_on_nothing_or_beside_its_table_is_named() {
        assert!(
            scene_error(|s| s.objects[0].on = "shelf-9".to_string()).contains("object `fork-1`: lies on `shelf-9`")
        );
        assert!(scene_error(|s| s.objects[0].forward = 3.0).contains("object `fork-1`: lies beside"));
    }

    #[test]
    fn another_version_is_refused_with_the_one_that_is_read() {
        assert!(scene_error(|s| s.version = 7).contains("version 7 of the format; this program reads version 1"));
    }
}

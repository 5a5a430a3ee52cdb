//! The room map: rooms, walls, doors and the start – all that `plan` and a real robot ever load.

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::geometry::{Polygon, Pose, Vec2, angle_between, distance_to_segment, vec2, wrap_angle};
use crate::record::Direction;

/// The version of the format this program reads and writes.
pub const FORMAT_VERSION: u32 = 1;
/// How far inside the door a room is entered, metres.
const ENTRY_M: f64 = 0.72;
/// How near a wall's line a door must lie, metres.
const IN_WALL_M: f64 = 0.02;

/// Rooms, doors and the start pose. World frame in metres, x east, y north.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RoomMap {
    /// Version of this format: 1.
    pub version: u32,
    /// Name of the home.
    pub name: String,
    /// Height of the walls, metres.
    #[serde(default = "usual_wall_height")]
    pub wall_height: f64,
    /// Where a trial begins.
    pub start: Pose,
    /// The rooms; the first is where the robot starts unless the start pose says otherwise.
    pub rooms: Vec<Room>,
    /// The doors between them.
    pub doors: Vec<Door>,
    /// Further walls inside the rooms, from end to end: partitions, columns.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub inner_walls: Vec<[[f64; 2]; 2]>,
}

/// A room.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Room {
    /// Name in lower_snake: `living_room`.
    pub name: String,
    /// Other names people use for it.
    #[serde(default)]
    pub synonyms: Vec<String>,
    /// A hallway is passed through, never searched.
    #[serde(default)]
    pub passage: bool,
    /// Corners of the outline, metres, in order.
    pub outline: Vec<[f64; 2]>,
}

/// A door in the wall between two rooms.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Door {
    /// Name of the door.
    pub id: String,
    /// The two rooms.
    pub between: [String; 2],
    /// Its middle, metres.
    pub at: [f64; 2],
    /// Metres.
    pub width: f64,
}

fn usual_wall_height() -> f64 {
    2.5
}

impl Room {
    /// The outline.
    pub fn polygon(&self) -> Polygon {
        Polygon::new(self.outline.iter().map(|&[x, y]| vec2(x, y)).collect())
    }

    fn answers_to(&self, name: &str) -> bool {
        self.name == name || self.synonyms.iter().any(|synonym| synonym == name)
    }
}

impl Door {
    /// Its middle, metres.
    pub fn middle(&self) -> Vec2 {
        vec2(self.at[0], self.at[1])
    }
}

impl RoomMap {
    /// The room of that very name.
    pub fn room(&self, name: &str) -> Option<&Room> {
        self.rooms.iter().find(|room| room.name == name)
    }

    /// The room that holds a point.
    pub fn room_at(&self, point: Vec2) -> Option<&Room> {
        self.rooms.iter().find(|room| room.polygon().contains(point))
    }

    /// Names of the rooms that answer to `name`, nearest along the way first.
    pub fn rooms_called(&self, name: &str) -> Vec<String> {
        self.in_order().into_iter().filter(|room| room.answers_to(name)).map(|room| room.name.clone()).collect()
    }

    /// Names of the rooms on that side of the way from the start, in the order passed.
    pub fn rooms_on(&self, side: Direction) -> Vec<String> {
        self.rooms_by_distance().into_iter().filter(|room| self.side_of(room) == Some(side)).collect()
    }

    /// Names of all rooms worth searching, in the order their doors are passed from the start.
    pub fn rooms_by_distance(&self) -> Vec<String> {
        self.in_order().into_iter().filter(|room| !room.passage).map(|room| room.name.clone()).collect()
    }

    fn in_order(&self) -> Vec<&Room> {
        let distance =
            |room: &Room| self.door_into(&room.name).map_or(0.0, |door| self.start.distance_to(door.middle()));
        let mut rooms: Vec<&Room> = self.rooms.iter().collect();
        rooms.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
        rooms
    }

    /// On which hand a room lies as the robot goes from the start to its door.
    ///
    /// Left and right as it passes the door; front when the door is straight ahead.
    pub fn side_of(&self, room: &str) -> Option<Direction> {
        let entry = self.entry_pose(room)?;
        let turn = wrap_angle(entry.heading - self.start.heading);
        Some(match turn.to_degrees() {
            t if t.abs() <= 45.0 => Direction::Front,
            t if t.abs() >= 135.0 => Direction::Back,
            t if t > 0.0 => Direction::Left,
            _ => Direction::Right,
        })
    }

    /// Just inside a room's door, heading straight in; nothing for a room without a door on the way from the start.
    pub fn entry_pose(&self, room: &str) -> Option<Pose> {
        let polygon = self.room(room)?.polygon();
        let door = self.door_into(room)?;
        let middle = door.middle();
        let (a, b) = polygon
            .edges()
            .min_by(|e, f| distance_to_segment(middle, e.0, e.1).total_cmp(&distance_to_segment(middle, f.0, f.1)))?;
        // The outline runs counter-clockwise, so the room lies to the left of each edge.
        let along = (b - a).normalize();
        let inward = vec2(-along.y, along.x);
        let point = middle + inward * ENTRY_M;
        Some(Pose::new(point.x, point.y, inward.y.atan2(inward.x)))
    }

    /// The door through which a room is entered: the nearest to the start among its doors on the way.
    fn door_into(&self, room: &str) -> Option<&Door> {
        let home = self.room_at(self.start.position()).map(|room| room.name.as_str());
        if home == Some(room) {
            return None;
        }
        let doors = self.doors.iter().filter(|door| door.between.iter().any(|side| side == room));
        doors.min_by(|a, b| {
            let key = |door: &Door| {
                let from_home = door.between.iter().any(|side| Some(side.as_str()) == home);
                (!from_home, self.start.distance_to(door.middle()))
            };
            let (ka, kb) = (key(a), key(b));
            ka.0.cmp(&kb.0).then(ka.1.total_cmp(&kb.1))
        })
    }

    /// The walls: every outline's edges less the doors in them, and those inside the rooms, metres.
    pub fn walls(&self) -> Vec<(Vec2, Vec2)> {
        let inner = self.inner_walls.iter().map(|&[a, b]| (vec2(a[0], a[1]), vec2(b[0], b[1])));
        self.rooms
            .iter()
            .flat_map(|room| room.polygon().edges().collect::<Vec<_>>())
            .flat_map(|e| self.without_doors(e))
            .chain(inner)
            .collect()
    }

    fn without_doors(&self, (a, b): (Vec2, Vec2)) -> Vec<(Vec2, Vec2)> {
        let length = (b - a).norm();
        let along = (b - a) / length;
        let mut gaps: Vec<(f64, f64)> = self
            .doors
            .iter()
            .filter(|door| distance_to_segment(door.middle(), a, b) < IN_WALL_M)
            .map(|door| {
                let at = (door.middle() - a).dot(&along);
                ((at - door.width / 2.0).max(0.0), (at + door.width / 2.0).min(length))
            })
            .collect();
        gaps.sort_by(|p, q| p.0.total_cmp(&q.0));
        let mut walls = Vec::new();
        let mut from = 0.0;
        for (start, end) in gaps.into_iter().chain([(length, length)]) {
            if start - from > 1e-9 {
                walls.push((a + along * from, a + along * start));
            }
            from = end;
        }
        walls
    }

    /// Whether a door lies in the wall of a room it names.
    pub(super) fn door_is_in_wall(&self, door: &Door, room: &Room) -> bool {
        let middle = door.middle();
        room.polygon().edges().any(|(a, b)| {
            let along = (b - a).normalize() * (door.width / 2.0);
            [middle - along, middle + along].iter().all(|&end| distance_to_segment(end, a, b) < IN_WALL_M)
                && angle_between((b - a).y.atan2((b - a).x), along.y.atan2(along.x)) < PI
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_apartment_is_sound_and_has_its_rooms() {
        let map =
            RoomMap::from_json(include_str!("../../fixtures/apartment.map.json"), "apartment").expect("a sound map");
        assert_eq!(map.rooms.len(), 3);
        assert_eq!(map.rooms_by_distance().len(), 2);
    }

    #[test]
    fn the_living_room_lies_to_the_right_and_the_bedroom_to_the_left() {
        let map = RoomMap::apartment();
        assert_eq!(map.side_of("living_room"), Some(Direction::Right));
        assert_eq!(map.side_of("bedroom"), Some(Direction::Left));
        assert_eq!(map.rooms_on(Direction::Right), ["living_room"]);
    }

    #[test]
    fn a_room_is_entered_through_the_middle_of_its_door_heading_in() {
        let entry = RoomMap::apartment().entry_pose("living_room").expect("a door");
        assert!((entry.x - 2.63).abs() < 1e-9 && (entry.y - 2.0).abs() < 1e-9);
        assert!((entry.heading.to_degrees() - 90.0).abs() < 1e-9);
    }

    #[test]
    fn walls_leave_the_doors_open() {
        let map = RoomMap::apartment();
        let door = vec2(2.63, 1.28);
        assert!(map.walls().iter().all(|&(a, b)| distance_to_segment(door, a, b) > 0.6));
    }

    #[test]
    fn rooms_answer_to_their_synonyms() {
        assert_eq!(RoomMap::apartment().rooms_called("lounge"), ["living_room"]);
        assert!(RoomMap::apartment().rooms_called("kitchen").is_empty());
    }
}

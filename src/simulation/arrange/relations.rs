//! How pieces stand to each other and in their room, as words would tell it.
//!
//! Coarse on purpose: four directions in each frame of reference, near or not,
//! thirds of the room. Two arrangements with the same standings are described
//! by the same words.

use std::f64::consts::PI;

use crate::geometry::{Pose, Vec2, angle_between, distance_to_segment};
use crate::map::RoomMap;
use crate::record::Direction;
use crate::simulation::Item;

/// Nearer than this people say "next to", metres of gap.
pub const NEAR_M: f64 = 0.8;
/// Farther apart than this, people do not relate two pieces, metres of gap.
pub const RELATED_M: f64 = 2.5;
/// Nearer than this to a wall, a piece stands against it, metres.
pub const AT_WALL_M: f64 = 0.35;

/// How one piece stands to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Standing {
    /// On which side of the other, seen by someone who enters the room: front is nearer the door.
    pub viewer: Direction,
    /// On which side by the other's own front; nothing when it has none.
    pub intrinsic: Option<Direction>,
    /// Metres between the two outlines.
    pub gap_m: f64,
}

/// How `item` stands to `reference` in a room entered with the heading `entry`.
pub fn standing(item: &Item, reference: &Item, entry: Pose) -> Standing {
    let at = item.pose().position();
    let facing_door = entry.heading + PI;
    Standing {
        // Left and right stay the viewer's own, who looks the other way.
        viewer: side_of(at, reference, facing_door).mirrored(),
        intrinsic: reference.has_front().then(|| side_of(at, reference, reference.pose().heading)),
        gap_m: item.footprint().distance(&reference.footprint()),
    }
}

/// On which side of `reference` a point lies when its front is taken to look along `front`, radians.
///
/// Sides are those of its bounding box in that frame: beyond the end of a long couch is beside it, not behind it.
pub fn side_of(point: Vec2, reference: &Item, front: f64) -> Direction {
    let centre = reference.pose().position();
    let frame = Pose::new(centre.x, centre.y, front);
    let corners = reference.footprint();
    let half = corners.corners().iter().map(|&c| frame.to_local(c).abs()).fold(Vec2::zeros(), |a, b| a.sup(&b));
    let local = frame.to_local(point).component_div(&half);
    match (local.x.abs() >= local.y.abs(), local.x >= 0.0, local.y >= 0.0) {
        (true, true, _) => Direction::Front,
        (true, false, _) => Direction::Back,
        (false, _, true) => Direction::Left,
        (false, _, false) => Direction::Right,
    }
}

/// Where a piece stands in its room.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// Share of the way from the door's wall to the far wall, 0 to 1.
    pub depth: f64,
    /// Share of the way from the left wall to the right one, as on entering, 0 to 1.
    pub across: f64,
    /// Whether it stands against a wall.
    pub at_wall: bool,
    /// The angle to it on entering, radians, positive to the left.
    pub bearing: f64,
}

/// Where `item` stands in `room`, entered by `entry`.
pub fn part(item: &Item, map: &RoomMap, room: &str, entry: Pose) -> Option<Part> {
    let outline = map.room(room)?.polygon();
    let local: Vec<Vec2> = outline.corners().iter().map(|&corner| entry.to_local(corner)).collect();
    let least = |axis: usize| local.iter().map(|c| c[axis]).fold(f64::INFINITY, f64::min);
    let most = |axis: usize| local.iter().map(|c| c[axis]).fold(f64::NEG_INFINITY, f64::max);
    let at = entry.to_local(item.pose().position());
    let footprint = item.footprint();
    let gap =
        |corner: Vec2| outline.edges().map(|(a, b)| distance_to_segment(corner, a, b)).fold(f64::INFINITY, f64::min);
    Some(Part {
        depth: (at.x - least(0)) / (most(0) - least(0)),
        across: (most(1) - at.y) / (most(1) - least(1)),
        at_wall: footprint.corners().iter().any(|&corner| gap(corner) < AT_WALL_M),
        bearing: entry.bearing_to(item.pose().position()),
    })
}

impl Part {
    /// Whether words for parts of the room and for the hearer's left and right tell the two alike.
    pub fn is_told_like(&self, other: &Self) -> bool {
        third(self.depth) == third(other.depth)
            && third(self.across) == third(other.across)
            && self.at_wall == other.at_wall
            && angle_between(self.bearing, other.bearing) < 0.4
    }
}

impl Standing {
    /// Whether the same words tell both: the sides alike where the two are related at all, and near or far alike.
    pub fn is_told_like(&self, other: &Self) -> bool {
        if self.gap_m > RELATED_M {
            return other.gap_m > 0.7 * RELATED_M;
        }
        let near =
            if self.gap_m <= NEAR_M { other.gap_m <= NEAR_M.min(self.gap_m + 0.3) } else { other.gap_m > NEAR_M };
        near && self.viewer == other.viewer && self.intrinsic == other.intrinsic && other.gap_m < RELATED_M + 0.5
    }
}

fn third(share: f64) -> usize {
    ((share * 3.0) as usize).min(2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::Scene;

    fn stands(item: &str, reference: &str, room: &str) -> Standing {
        let (map, scene) = (RoomMap::apartment(), Scene::apartment());
        let entry = map.entry_pose(room).expect("a door");
        standing(scene.item(item).expect("there"), scene.item(reference).expect("there"), entry)
    }

    #[test]
    fn the_coffee_table_is_behind_the_couch_on_entering_and_before_its_own_front() {
        let stands = stands("coffee-table-1", "couch-1", "living_room");
        assert_eq!((stands.viewer, stands.intrinsic), (Direction::Back, Some(Direction::Front)));
        assert!(stands.gap_m < NEAR_M);
    }

    #[test]
    fn on_entering_the_bedroom_the_round_table_is_right_of_the_bed() {
        // Entered southward, the west is on the right.
        let map = RoomMap::apartment();
        let (scene, entry) = (Scene::apartment(), map.entry_pose("bedroom").expect("a door"));
        let mut table = scene.item("round-table-2").expect("there").clone();
        table.y = -3.0;
        let stands = standing(&table, scene.item("bed-1").expect("there"), entry);
        assert_eq!(stands.viewer, Direction::Right);
    }

    #[test]
    fn beyond_the_end_of_a_couch_is_beside_it() {
        let scene = Scene::apartment();
        let couch = scene.item("couch-1").expect("there");
        let end = couch.pose().to_world(crate::geometry::vec2(0.3, 1.4));
        assert_eq!(side_of(end, couch, couch.pose().heading), Direction::Left);
    }

    #[test]
    fn the_dinner_table_stands_at_the_back_of_the_living_room() {
        let (map, scene) = (RoomMap::apartment(), Scene::apartment());
        let entry = map.entry_pose("living_room").expect("a door");
        let part = part(scene.item("dinner-table-1").expect("there"), &map, "living_room", entry).expect("a room");
        assert!(part.depth > 0.67 && part.across > 0.33 && part.across < 0.67, "{part:?}");
    }
}

//! Whether a reference–direction pair is true of a piece, by the truth.

use crate::behavior::motion::RoomFrame;
use crate::geometry::{Pose, distance_to_segment};
use crate::map::RoomMap;
use crate::record::{Direction, Frame, Pair, Reference};
use crate::simulation::Item;
use crate::simulation::arrange::relations::{AT_WALL_M, NEAR_M, part, standing};

/// Nearer than this to the door, a piece is by it, metres.
const BY_DOOR_M: f64 = 2.4;
/// Left, right, behind reach so far, metres of gap.
const BESIDE_M: f64 = 1.2;

/// Where the words are read.
#[derive(Clone, Copy)]
pub(super) struct Told<'a> {
    pub map: &'a RoomMap,
    pub room: &'a str,
    pub frame: &'a RoomFrame,
    /// Where the motions have led.
    pub arrived: Pose,
}

/// Whether what a pair says of robot, room, wall or door is true; pairs with other references say nothing here.
pub(super) fn in_place(item: &Item, pair: &Pair, told: Told) -> bool {
    match &pair.reference {
        Reference::Robot => by_robot(item, pair.direction, told.arrived),
        Reference::Room => in_room(item, pair.direction, told),
        Reference::Wall => at_wall(item, pair.direction, told),
        Reference::Door => by_door(item, pair.direction, told),
        Reference::Move | Reference::Thing(_) => true,
    }
}

fn by_robot(item: &Item, direction: Direction, arrived: Pose) -> bool {
    let off = arrived.bearing_to(item.pose().position()).to_degrees();
    let at = arrived.distance_to(item.pose().position());
    let toward = match direction {
        Direction::Front => off.abs() < 35.0,
        Direction::Left => (30.0..=120.0).contains(&off),
        Direction::Right => (-120.0..=-30.0).contains(&off),
        Direction::Back => off.abs() > 130.0,
        _ => at < 2.0,
    };
    toward && at < 4.5
}

fn in_room(item: &Item, direction: Direction, told: Told) -> bool {
    let Some(part) = part(item, told.map, told.room, told.frame.entry) else { return false };
    match direction {
        Direction::Front => part.depth < 0.36,
        Direction::Back => part.depth > 0.64,
        Direction::Left => part.across < 0.38,
        Direction::Right => part.across > 0.62,
        Direction::Side => part.at_wall,
        _ => (0.3..=0.7).contains(&part.depth),
    }
}

fn at_wall(item: &Item, direction: Direction, told: Told) -> bool {
    let entry = told.frame.entry;
    let footprint = item.footprint();
    let gap = |a, b| footprint.corners().iter().map(|&c| distance_to_segment(c, a, b)).fold(f64::INFINITY, f64::min);
    told.frame.outline.edges().any(|(a, b)| {
        let middle = entry.to_local((a + b) / 2.0);
        let centre = entry.to_local(told.frame.outline.centroid());
        let away = middle - centre;
        let ahead = away.x.abs() >= away.y.abs();
        let is_it = match direction {
            Direction::Front => ahead && away.x < 0.0,
            Direction::Back => ahead && away.x > 0.0,
            Direction::Left => !ahead && away.y > 0.0,
            Direction::Right => !ahead && away.y < 0.0,
            _ => true,
        };
        is_it && gap(a, b) < AT_WALL_M
    })
}

fn by_door(item: &Item, direction: Direction, told: Told) -> bool {
    let entry = told.frame.entry;
    let at = entry.to_local(item.pose().position());
    let near = at.norm() < BY_DOOR_M;
    match direction {
        Direction::Left => near && at.y > 0.4,
        Direction::Right => near && at.y < -0.4,
        Direction::Front => at.y.abs() < at.x,
        // "Behind the door": beside it, at its wall.
        Direction::Back => near && at.x < 0.6,
        _ => near,
    }
}

/// Whether a pair is true of `item` with this `landmark`.
pub(super) fn related(item: &Item, landmark: &Item, pair: &Pair, told: Told) -> bool {
    if pair.reference.thing().is_none() {
        return false;
    }
    let stands = standing(item, landmark, told.frame.entry);
    match (pair.direction, pair.frame, stands.intrinsic) {
        (Direction::Side | Direction::Central | Direction::Between, _, _) => stands.gap_m < 0.75 * NEAR_M,
        (direction, Frame::Intrinsic, Some(side)) => side == direction && stands.gap_m < BESIDE_M,
        (direction, _, _) => stands.viewer == direction && stands.gap_m < BESIDE_M,
    }
}

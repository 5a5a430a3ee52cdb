//! How well a candidate fits a reference–direction pair, read in one frame of reference.

use std::f64::consts::{FRAC_PI_2, PI};

use super::Furniture;
use super::motion::RoomFrame;
use crate::force;
use crate::geometry::{Pose, Vec2};
use crate::record::{Direction, Frame};

/// "Next to" halves with every so many metres of gap.
const BESIDE_HALVES_M: f64 = 0.6;
/// "Left of", "behind": a relation to something far away says little; halves with every so many metres.
const RELATED_HALVES_M: f64 = 2.5;

/// "On the right" holds fully up to this far off square right, and no more at all from there on, radians.
const THERE_RAD: f64 = PI / 4.0;
const NOT_THERE_RAD: f64 = 1.75;
/// "At the left wall" halves with every so many metres from that wall.
const AT_WALL_HALVES_M: f64 = 1.5;

/// Where the words are read: the room, and the robot's pose when it reached them.
#[derive(Clone, Copy, Debug)]
pub struct Place<'a> {
    /// The room and its entry.
    pub room: &'a RoomFrame,
    /// Where the robot stood when it reached the words.
    pub arrived: Pose,
}

/// The angle in the world, radians, of a direction in a frame; nothing for central, side and between.
///
/// `yaw` is the heading of the reference's own front, when it has one.
pub fn angle_of(direction: Direction, frame: Frame, place: Place, yaw: Option<f64>) -> Option<f64> {
    // (heading of "front", +1 where left is counter-clockwise of it)
    let (front, left) = match frame {
        Frame::Robot => (place.arrived.heading, 1.0),
        Frame::Viewer => (place.room.entry.heading + PI, -1.0),
        Frame::Intrinsic => (yaw?, 1.0),
        Frame::Facing => (yaw?, -1.0),
    };
    match direction {
        Direction::Front => Some(front),
        Direction::Back => Some(front + PI),
        Direction::Left => Some(front + left * FRAC_PI_2),
        Direction::Right => Some(front - left * FRAC_PI_2),
        // Above and under are beside it on the floor plan; far is no direction.
        _ => None,
    }
}

/// How well `candidate` stands in `direction` of `reference`, 0 to 1: the histogram of forces' degree of truth
/// in that direction, less with distance. Nothing when the frame needs a front that the reference lacks.
pub fn to_furniture(
    candidate: &Furniture,
    reference: &Furniture,
    direction: Direction,
    frame: Frame,
    place: Place,
) -> Option<f64> {
    let gap = candidate.footprint().distance(reference.footprint());
    match direction {
        // What hangs over a thing or lies under it stands beside it as a robot sees it from above.
        Direction::Side | Direction::Between | Direction::Above | Direction::Under => {
            Some(halving(gap, BESIDE_HALVES_M))
        }
        Direction::Far => Some(1.0 - halving(gap, RELATED_HALVES_M)),
        Direction::Central => Some(halving((candidate.centre() - reference.centre()).norm(), BESIDE_HALVES_M)),
        _ => {
            let angle = angle_of(direction, frame, place, reference.detection().yaw)?;
            let (a, b) = (force::Shape::from(candidate.footprint()), force::Shape::from(reference.footprint()));
            Some(force::RelativePosition::between(&a, &b).degree(angle).a * halving(gap, RELATED_HALVES_M))
        }
    }
}

/// How well `candidate` stands between two references.
pub fn between(candidate: &Furniture, first: &Furniture, second: &Furniture) -> f64 {
    force::between(&candidate.footprint().into(), &first.footprint().into(), &second.footprint().into())
}

/// How well a point lies in a direction from the robot, as it stood when it reached the words.
pub fn to_robot(point: Vec2, direction: Direction, place: Place) -> f64 {
    let off = match direction {
        Direction::Front => 0.0,
        Direction::Back => PI,
        Direction::Left => FRAC_PI_2,
        Direction::Right => -FRAC_PI_2,
        _ => {
            return halving(place.arrived.distance_to(point), RELATED_HALVES_M);
        }
    };
    let deviation = crate::geometry::angle_between(place.arrived.bearing_to(point), off);
    ((NOT_THERE_RAD - deviation) / (NOT_THERE_RAD - THERE_RAD)).clamp(0.0, 1.0)
}

/// How well a candidate fits "by the door".
pub fn to_door(candidate: &Furniture, place: Place) -> f64 {
    halving(place.room.entry.distance_to(candidate.centre()), RELATED_HALVES_M)
}

/// How well a candidate fits a wall of the room.
pub fn to_wall(candidate: &Furniture, direction: Direction, place: Place) -> f64 {
    let ((near, far), (right, left)) = place.room.extent();
    let at = place.room.entry.to_local(candidate.centre());
    match direction {
        Direction::Side => halving(wall_gap(candidate, place), BESIDE_HALVES_M),
        Direction::Left => halving(left - at.y, AT_WALL_HALVES_M),
        Direction::Right => halving(at.y - right, AT_WALL_HALVES_M),
        Direction::Back => halving(far - at.x, AT_WALL_HALVES_M),
        Direction::Front => halving(at.x - near, AT_WALL_HALVES_M),
        _ => to_room(candidate, direction, place),
    }
}

/// How well a candidate fits a part of the room.
pub fn to_room(candidate: &Furniture, direction: Direction, place: Place) -> f64 {
    let ((near, far), (right, left)) = place.room.extent();
    let at = place.room.entry.to_local(candidate.centre());
    let share = |from: f64, to: f64, value: f64| ((value - from) / (to - from)).clamp(0.0, 1.0);
    match direction {
        Direction::Back => share(near, far, at.x),
        Direction::Front => share(far, near, at.x),
        Direction::Left => share(right, left, at.y),
        Direction::Right => share(left, right, at.y),
        Direction::Side => halving(wall_gap(candidate, place), 2.0 * BESIDE_HALVES_M),
        _ => 1.0 - (2.0 * share(near, far, at.x) - 1.0).abs().max((2.0 * share(right, left, at.y) - 1.0).abs()),
    }
}

fn wall_gap(candidate: &Furniture, place: Place) -> f64 {
    let gaps = place.room.outline.edges().flat_map(|(a, b)| {
        candidate.footprint().corners().iter().map(move |&corner| crate::geometry::distance_to_segment(corner, a, b))
    });
    gaps.fold(f64::INFINITY, f64::min)
}

fn halving(distance: f64, metres: f64) -> f64 {
    0.5_f64.powf(distance / metres)
}

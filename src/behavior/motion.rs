//! What a word of motion means, in one table ([`step_for`]), each row with a test.
//!
//! | words | action | ends |
//! |---|---|---|
//! | "go forward", no end said | `move front` | 2 m ahead, or 0.5 m before a wall |
//! | "go three steps / 2 m / halfway" | `move front` with an amount | after that much |
//! | "until you hit the wall" | `move front`, until wall | 0.5 m before the wall ahead |
//! | "turn left", "take a right" | `move left/right` | turned 90°, to the room's axes |
//! | "turn 45 degrees" | `move left/right` with degrees | turned that much |
//! | "turn around", "go back" | `move back` | turned 180°, to the room's axes |
//! | "halfway in", "to the middle" | `go room central` | at half the room's depth on the entry axis, keeping the side |
//! | "to the back", "end of the room" | `go room back` | 0.8 m before the far wall |
//! | "by the entrance", "front of the room" | `go door`, `go room front` | 0.8 m inside the door's wall |
//! | "to the left side of the room" | `go room left/right` | in that half, facing into it |
//! | "to the left wall", "the back wall" | `go wall left/right/back` | 0.5 m before that wall, facing it |
//! | "past the couch" | `go` furniture, side | beyond it on the way ahead |
//! | "to the left of the bed", more steps following | `go` furniture, direction | on that side of it |
//!
//! A forward move ends at furniture in the way; that is the route's business.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::geometry::{Polygon, Pose, Vec2, cross, vec2, wrap_angle};
use crate::map::RoomMap;
use crate::record::{Action, Amount, Direction, Motion, Reference};

/// A walk without a stated end, metres.
const WALK_M: f64 = 2.0;
/// From the robot's centre to a wall it stops before: 0.5 m in front of its nose (0.21 m).
const BEFORE_WALL_M: f64 = 0.71;
/// From the robot's centre to the far wall at "the back of the room".
const BEFORE_FAR_WALL_M: f64 = 0.8;
/// From a landmark's edge to the robot's centre once past it.
const BEYOND_LANDMARK_M: f64 = 0.7;
/// A human step.
const STEP_M: f64 = 0.7;

/// What the robot shall do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// Turn in place to this heading, radians.
    Turn(f64),
    /// Drive there, then turn to the pose's heading.
    Drive(Pose),
}

/// The room with the axes on which its words are read.
#[derive(Clone, Debug)]
pub struct RoomFrame {
    /// The room's outline.
    pub outline: Polygon,
    /// Where and with which heading the robot came in.
    pub entry: Pose,
}

/// A landmark's outline and the direction, radians, in which the words ask to pass or stand by it.
#[derive(Clone, Debug)]
pub struct Landmark<'a> {
    /// Its outline on the floor.
    pub footprint: &'a Polygon,
    /// Where to stand, seen from it; nothing for "past", "by", "at".
    pub towards: Option<f64>,
}

/// What `action` means for a robot at `pose` in `room`; nothing for the actions that are no motion.
///
/// `landmark` is the furniture an action names, when the robot knows where it stands.
pub fn step_for(action: &Action, pose: Pose, room: &RoomFrame, landmark: Option<&Landmark>) -> Option<Step> {
    match action {
        Action::Move { motion: Motion::Ahead, amount: Some(Amount::Until(what)) } if *what != Reference::Wall => {
            Some(landmark.map_or_else(|| walk(pose, room, f64::INFINITY), |at| reach(pose, at)))
        }
        Action::Move { motion: Motion::Ahead, amount } => Some(walk(pose, room, walk_length(amount.as_ref(), room))),
        Action::Move { motion, amount } => Some(Step::Turn(turned(pose, room, *motion, amount.as_ref()))),
        Action::Go { reference, direction, .. } => match reference {
            Reference::Room => Some(room.part(pose, *direction)),
            Reference::Wall => Some(room.wall(pose, *direction)),
            Reference::Door => Some(room.part(pose, Direction::Front)),
            Reference::Move | Reference::Robot | Reference::Thing(_) => landmark.map(|at| pass(pose, at)),
        },
        Action::Enter { .. } | Action::Search { .. } | Action::Find { .. } | Action::Deliver { .. } => None,
    }
}

fn walk_length(amount: Option<&Amount>, room: &RoomFrame) -> f64 {
    match amount {
        None | Some(Amount::Degrees(_)) => WALK_M,
        Some(Amount::Meters(metres)) => *metres,
        Some(Amount::Steps(steps)) => steps * STEP_M,
        Some(Amount::Fraction(share)) => share * room.depth(),
        Some(Amount::Until(_)) => f64::INFINITY,
    }
}

fn walk(pose: Pose, room: &RoomFrame, metres: f64) -> Step {
    let free = (room.wall_ahead(pose) - BEFORE_WALL_M).max(0.0);
    let to = pose.position() + pose.forward() * metres.min(free);
    Step::Drive(Pose::new(to.x, to.y, pose.heading))
}

fn turned(pose: Pose, room: &RoomFrame, motion: Motion, amount: Option<&Amount>) -> f64 {
    let sign = if motion == Motion::TurnRight { -1.0 } else { 1.0 };
    match (motion, amount) {
        (_, Some(Amount::Degrees(degrees))) => wrap_angle(pose.heading + sign * degrees.to_radians()),
        (Motion::TurnLeft | Motion::TurnRight, _) => room.nearest_axis(pose.heading + sign * FRAC_PI_2),
        _ => room.nearest_axis(pose.heading + PI),
    }
}

/// Up to a landmark: beside its near edge, facing it.
fn reach(pose: Pose, landmark: &Landmark) -> Step {
    let centre = landmark.footprint.centroid();
    let away = pose.position() - centre;
    let towards = away.y.atan2(away.x);
    let to = beside(landmark.footprint, towards);
    Step::Drive(Pose::new(to.x, to.y, wrap_angle(towards + PI)))
}

/// Past a landmark on the way ahead, or on the side the words name.
fn pass(pose: Pose, landmark: &Landmark) -> Step {
    match landmark.towards {
        Some(angle) => {
            let to = beside(landmark.footprint, angle);
            Step::Drive(Pose::new(to.x, to.y, pose.heading))
        }
        None => {
            let ahead = |corner: &Vec2| (corner - pose.position()).dot(&pose.forward());
            let furthest = landmark.footprint.corners().iter().map(ahead).fold(0.0, f64::max);
            let to = pose.position() + pose.forward() * (furthest + BEYOND_LANDMARK_M);
            Step::Drive(Pose::new(to.x, to.y, pose.heading))
        }
    }
}

fn beside(footprint: &Polygon, angle: f64) -> Vec2 {
    let direction = vec2(angle.cos(), angle.sin());
    let centre = footprint.centroid();
    let edge = footprint.corners().iter().map(|corner| (corner - centre).dot(&direction)).fold(0.0, f64::max);
    centre + direction * (edge + BEYOND_LANDMARK_M)
}

impl RoomFrame {
    /// The frame of a room of the map; about `here` where the map lacks its outline or its door.
    pub fn of(map: &RoomMap, room: &str, here: Pose) -> Self {
        let outline = map.room(room).map(|room| room.polygon());
        let entry = map.entry_pose(room).unwrap_or(here);
        Self { outline: outline.unwrap_or_else(|| Polygon::rectangle(here, 1.0, 1.0)), entry }
    }

    /// How far the room reaches along the entry axis and across it (to the left), from its entry pose: least, most.
    pub fn extent(&self) -> ((f64, f64), (f64, f64)) {
        let start = ((f64::INFINITY, f64::NEG_INFINITY), (f64::INFINITY, f64::NEG_INFINITY));
        self.outline.corners().iter().map(|&corner| self.entry.to_local(corner)).fold(start, |(depth, across), c| {
            ((depth.0.min(c.x), depth.1.max(c.x)), (across.0.min(c.y), across.1.max(c.y)))
        })
    }

    /// Metres from the door's wall to the far wall.
    pub fn depth(&self) -> f64 {
        let ((near, far), _) = self.extent();
        far - near
    }

    /// The room's axis nearest to `heading`.
    pub fn nearest_axis(&self, heading: f64) -> f64 {
        let quarter_turns = ((heading - self.entry.heading) / FRAC_PI_2).round();
        wrap_angle(self.entry.heading + quarter_turns * FRAC_PI_2)
    }

    /// Metres from `pose` to the room's wall along its heading.
    pub fn wall_ahead(&self, pose: Pose) -> f64 {
        let (origin, ray) = (pose.position(), pose.forward());
        let hit = |(a, b): (Vec2, Vec2)| {
            let along = b - a;
            let denominator = cross(ray, along);
            if denominator.abs() < 1e-12 {
                return f64::INFINITY;
            }
            let (t, s) = (cross(a - origin, along) / denominator, cross(a - origin, ray) / denominator);
            if t >= 0.0 && (0.0..=1.0).contains(&s) { t } else { f64::INFINITY }
        };
        let nearest = self.outline.edges().map(hit).fold(f64::INFINITY, f64::min);
        if nearest.is_finite() { nearest } else { 0.0 }
    }

    fn at(&self, depth: f64, across: f64, heading: f64) -> Step {
        let to = self.entry.to_world(vec2(depth, across));
        Step::Drive(Pose::new(to.x, to.y, wrap_angle(heading)))
    }

    fn part(&self, pose: Pose, direction: Direction) -> Step {
        let ((near, far), (right, left)) = self.extent();
        let here = self.entry.to_local(pose.position());
        let heading = self.entry.heading;
        match direction {
            Direction::Back => self.at(far - BEFORE_FAR_WALL_M, here.y, heading),
            Direction::Front => self.at(near + BEFORE_FAR_WALL_M, here.y, heading),
            Direction::Left => {
                self.at(here.x.max(near + BEFORE_FAR_WALL_M), three_quarters(right, left), heading + FRAC_PI_2)
            }
            Direction::Right => {
                self.at(here.x.max(near + BEFORE_FAR_WALL_M), three_quarters(left, right), heading - FRAC_PI_2)
            }
            _ => self.at((near + far) / 2.0, here.y, heading),
        }
    }

    fn wall(&self, pose: Pose, direction: Direction) -> Step {
        let ((near, far), (right, left)) = self.extent();
        let here = self.entry.to_local(pose.position());
        let heading = self.entry.heading;
        match direction {
            Direction::Left => self.at(here.x, left - BEFORE_WALL_M, heading + FRAC_PI_2),
            Direction::Right => self.at(here.x, right + BEFORE_WALL_M, heading - FRAC_PI_2),
            Direction::Front => self.at(near + BEFORE_WALL_M, here.y, heading + PI),
            Direction::Back => self.at(far - BEFORE_WALL_M, here.y, heading),
            _ => walk(pose, self, f64::INFINITY),
        }
    }
}

fn three_quarters(from: f64, to: f64) -> f64 {
    from + 0.75 * (to - from)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Frame;

    /// 6 m deep and 4 m wide, entered northward near its south-west corner.
    fn room() -> RoomFrame {
        let outline = Polygon::new(vec![vec2(0.0, 0.0), vec2(4.0, 0.0), vec2(4.0, 6.0), vec2(0.0, 6.0)]);
        RoomFrame { outline, entry: Pose::new(1.0, 0.7, FRAC_PI_2) }
    }

    fn moved(direction: Direction, amount: Option<Amount>, pose: Pose) -> Step {
        let motion = Motion::from_direction(direction).expect("a motion");
        step_for(&Action::Move { motion, amount }, pose, &room(), None).expect("a step")
    }

    fn gone(reference: &str, direction: Direction, landmark: Option<&Landmark>) -> Step {
        let action =
            Action::Go { reference: Reference::of(reference), direction, frame: Frame::Viewer, frames: Vec::new() };
        step_for(&action, room().entry, &room(), landmark).expect("a motion")
    }

    fn assert_drives(step: Step, x: f64, y: f64, heading: f64) {
        let Step::Drive(to) = step else { panic!("expected a drive, got {step:?}") };
        let near = (to.x - x).abs() < 1e-9 && (to.y - y).abs() < 1e-9 && wrap_angle(to.heading - heading).abs() < 1e-9;
        assert!(near, "expected ({x}, {y}, {heading}), got {to:?}");
    }

    #[test]
    fn go_forward_without_an_end_goes_two_metres() {
        assert_drives(moved(Direction::Front, None, room().entry), 1.0, 2.7, FRAC_PI_2);
    }

    #[test]
    fn go_forward_stops_before_a_wall() {
        assert_drives(moved(Direction::Front, None, Pose::new(1.0, 5.0, FRAC_PI_2)), 1.0, 6.0 - 0.71, FRAC_PI_2);
    }

    #[test]
    fn steps_metres_and_shares_are_measured() {
        assert_drives(moved(Direction::Front, Some(Amount::Steps(3.0)), room().entry), 1.0, 2.8, FRAC_PI_2);
        assert_drives(moved(Direction::Front, Some(Amount::Meters(1.0)), room().entry), 1.0, 1.7, FRAC_PI_2);
        assert_drives(moved(Direction::Front, Some(Amount::Fraction(0.5)), room().entry), 1.0, 3.7, FRAC_PI_2);
    }

    #[test]
    fn until_you_hit_the_wall_goes_to_the_wall_ahead() {
        let until = Some(Amount::Until(Reference::Wall));
        assert_drives(moved(Direction::Front, until, Pose::new(1.0, 2.0, 0.0)), 4.0 - 0.71, 2.0, 0.0);
    }

    #[test]
    fn turns_end_on_the_rooms_axes() {
        let askew = Pose::new(1.0, 1.0, FRAC_PI_2 + 0.2);
        assert_eq!(moved(Direction::Left, None, askew), Step::Turn(PI));
        let Step::Turn(right) = moved(Direction::Right, None, askew) else { panic!("a turn") };
        assert!(right.abs() < 1e-9);
    }

    #[test]
    fn a_turn_of_so_many_degrees_is_not_rounded() {
        let Step::Turn(to) = moved(Direction::Right, Some(Amount::Degrees(45.0)), room().entry) else {
            panic!("a turn")
        };
        assert!((to - FRAC_PI_2 / 2.0).abs() < 1e-9);
    }

    #[test]
    fn turn_around_is_half_a_turn() {
        let Step::Turn(to) = moved(Direction::Back, None, room().entry) else { panic!("a turn") };
        assert!((to + FRAC_PI_2).abs() < 1e-9);
    }

    #[test]
    fn halfway_in_keeps_the_side() {
        assert_drives(gone("room", Direction::Central, None), 1.0, 3.0, FRAC_PI_2);
    }

    #[test]
    fn the_back_of_the_room_is_before_the_far_wall() {
        assert_drives(gone("room", Direction::Back, None), 1.0, 5.2, FRAC_PI_2);
    }

    #[test]
    fn by_the_entrance_is_just_inside() {
        assert_drives(gone("door", Direction::Side, None), 1.0, 0.8, FRAC_PI_2);
        assert_drives(gone("room", Direction::Front, None), 1.0, 0.8, FRAC_PI_2);
    }

    #[test]
    fn the_right_side_of_the_room_is_faced_from_within_it() {
        assert_drives(gone("room", Direction::Right, None), 3.0, 0.8, 0.0);
        assert_drives(gone("room", Direction::Left, None), 1.0, 0.8, PI);
    }

    #[test]
    fn the_right_wall_is_gone_up_to_and_faced() {
        assert_drives(gone("wall", Direction::Right, None), 4.0 - 0.71, 0.7, 0.0);
        assert_drives(gone("wall", Direction::Back, None), 1.0, 6.0 - 0.71, FRAC_PI_2);
    }

    #[test]
    fn past_the_couch_is_beyond_it_on_the_way_ahead() {
        let couch = Polygon::rectangle(Pose::new(2.5, 3.0, 0.0), 2.0, 1.0);
        assert_drives(
            gone("couch", Direction::Side, Some(&Landmark { footprint: &couch, towards: None })),
            1.0,
            4.2,
            FRAC_PI_2,
        );
    }

    #[test]
    fn left_of_the_bed_is_on_that_side_of_it() {
        let bed = Polygon::rectangle(Pose::new(2.5, 3.0, 0.0), 2.0, 1.0);
        let landmark = Landmark { footprint: &bed, towards: Some(PI) };
        assert_drives(gone("bed", Direction::Left, Some(&landmark)), 0.8, 3.0, FRAC_PI_2);
    }

    #[test]
    fn until_the_desk_ends_beside_the_desk_facing_it() {
        let desk = Polygon::rectangle(Pose::new(1.0, 4.0, 0.0), 1.0, 1.0);
        let action = Action::Move { motion: Motion::Ahead, amount: Some(Amount::Until(Reference::of("desk"))) };
        let landmark = Landmark { footprint: &desk, towards: None };
        let step = step_for(&action, room().entry, &room(), Some(&landmark)).expect("a motion");
        assert_drives(step, 1.0, 2.8, FRAC_PI_2);
    }
}

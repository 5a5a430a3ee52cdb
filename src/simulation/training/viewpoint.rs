//! Where a robot stands to see some of the furniture.

use super::room::FurnishedRoom;
use crate::frame::Camera;
use crate::geometry::{Pose, vec2};
use crate::simulation::Dice;

/// The robot keeps this far from walls and furniture, metres.
const CLEARANCE_M: f64 = 0.3;

/// A pose 0.8–5 m from a piece it looks towards, and a camera on a tower of some height and tilt.
pub(super) fn choose(room: &FurnishedRoom, dice: &mut Dice) -> Option<(Pose, Camera)> {
    if room.placed.is_empty() {
        return None;
    }
    let camera =
        Camera { tower_m: dice.between(1.0, 1.4), tilt: dice.between(5.0, 20.0).to_radians(), ..Camera::kinect() };
    for _ in 0..40 {
        let at = vec2(dice.between(-room.half.0, room.half.0), dice.between(-room.half.1, room.half.1));
        let target = &room.placed[dice.whole(0, room.placed.len() - 1)];
        let to = target.pose.position() - at;
        let heading = to.y.atan2(to.x) + dice.normal(0.0, 0.2);
        let in_walls = at.x.abs() > room.half.0 - CLEARANCE_M || at.y.abs() > room.half.1 - CLEARANCE_M;
        let in_the_way = room.placed.iter().any(|placed| placed.footprint().distance_to(at) < CLEARANCE_M);
        if !in_walls && !in_the_way && (0.8..5.0).contains(&to.norm()) {
            return Some((Pose::new(at.x, at.y, heading), camera));
        }
    }
    None
}

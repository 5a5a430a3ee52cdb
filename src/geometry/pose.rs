//! Position and heading in the plane.

use std::f64::consts::{PI, TAU};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Vec2, vec2};

/// A position (metres) and a heading (radians, counter-clockwise from +x).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Pose {
    /// Metres east.
    pub x: f64,
    /// Metres north.
    pub y: f64,
    /// Radians, counter-clockwise from east.
    pub heading: f64,
}

impl Pose {
    /// A pose from metres and radians.
    pub const fn new(x: f64, y: f64, heading: f64) -> Self {
        Self { x, y, heading }
    }

    /// The position alone.
    pub fn position(self) -> Vec2 {
        vec2(self.x, self.y)
    }

    /// The unit vector the pose faces along.
    pub fn forward(self) -> Vec2 {
        vec2(self.heading.cos(), self.heading.sin())
    }

    /// A point given in this pose's frame (x ahead, y to the left), in the world frame.
    pub fn to_world(self, local: Vec2) -> Vec2 {
        let (sin, cos) = self.heading.sin_cos();
        vec2(self.x + cos * local.x - sin * local.y, self.y + sin * local.x + cos * local.y)
    }

    /// A point of the world in this pose's frame (x ahead, y to the left).
    pub fn to_local(self, world: Vec2) -> Vec2 {
        let (sin, cos) = self.heading.sin_cos();
        let d = world - self.position();
        vec2(cos * d.x + sin * d.y, -sin * d.x + cos * d.y)
    }

    /// The angle from the heading to `point`, in (−π, π], positive to the left.
    pub fn bearing_to(self, point: Vec2) -> f64 {
        let d = point - self.position();
        wrap_angle(d.y.atan2(d.x) - self.heading)
    }

    /// Metres from here to `point`.
    pub fn distance_to(self, point: Vec2) -> f64 {
        (point - self.position()).norm()
    }
}

/// The same angle in (−π, π].
pub fn wrap_angle(angle: f64) -> f64 {
    let wrapped = angle.rem_euclid(TAU);
    if wrapped > PI { wrapped - TAU } else { wrapped }
}

/// How far apart two angles are, in 0..=π.
pub fn angle_between(a: f64, b: f64) -> f64 {
    wrap_angle(a - b).abs()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    #[test]
    fn a_point_to_the_left_has_a_positive_bearing() {
        let facing_north = Pose::new(1.0, 1.0, FRAC_PI_2);
        assert!((facing_north.bearing_to(vec2(0.0, 1.0)) - FRAC_PI_2).abs() < 1e-12);
    }

    #[test]
    fn local_and_world_undo_each_other() {
        let pose = Pose::new(2.0, -1.0, 0.7);
        let point = vec2(0.3, 4.0);
        assert!((pose.to_local(pose.to_world(point)) - point).norm() < 1e-12);
    }

    #[test]
    fn angles_wrap_into_the_half_open_turn() {
        assert!((wrap_angle(3.0 * PI) - PI).abs() < 1e-12);
        assert!((wrap_angle(-PI) - PI).abs() < 1e-12);
        assert!((angle_between(0.1, TAU - 0.1) - 0.2).abs() < 1e-12);
    }
}

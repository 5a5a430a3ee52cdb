//! What a base is like from outside: its outline, and how fast it may go.

use crate::geometry::{Polygon, Pose, vec2};

/// A base's outline, its sonars' reach, and the limits it keeps to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// From the wheels' axis to the front, metres.
    pub front_m: f64,
    /// From the wheels' axis to the rear, metres.
    pub rear_m: f64,
    /// Metres.
    pub width_m: f64,
    /// Radius of the circle that the outline sweeps when the robot turns in place, metres.
    pub swing_m: f64,
    /// What a sonar reports when nothing echoes, metres.
    pub sonar_range_m: f64,
    /// Fastest, m/s.
    pub speed_m_s: f64,
    /// Fastest turn, rad/s.
    pub turn_rad_s: f64,
    /// Speeding up, m/s².
    pub acceleration_m_s2: f64,
    /// Slowing down, m/s².
    pub braking_m_s2: f64,
    /// Turning faster and slower, rad/s².
    pub turn_acceleration_rad_s2: f64,
}

impl Body {
    /// The outline of the robot at `pose`, metres.
    pub fn outline(&self, pose: Pose) -> Polygon {
        let half = self.width_m / 2.0;
        let corners = [(-self.rear_m, -half), (self.front_m, -half), (self.front_m, half), (-self.rear_m, half)];
        Polygon::new(corners.map(|(x, y)| pose.to_world(vec2(x, y))).to_vec())
    }
}

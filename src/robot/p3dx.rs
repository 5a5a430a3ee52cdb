//! The Pioneer 3-DX in numbers (Pioneer 3 Operations Manual; AriaCoda's parameters for the p3dx-sh).

use crate::geometry::{Polygon, Pose, Vec2, vec2};

/// From the wheels' axis to the front, metres.
pub const FRONT_M: f64 = 0.210;
/// From the wheels' axis to the rear, metres.
pub const REAR_M: f64 = 0.301;
/// Between the wheels, as the odometry counts on it, metres (DiffConvFactor 0.0056 rad/s per mm/s).
pub const TRACK_M: f64 = 0.357;
/// Metres.
pub const WIDTH_M: f64 = 0.425;
/// Radius of the circle the outline sweeps when the robot turns in place, metres.
pub const SWING_M: f64 = 0.369;
/// Speeds this project drives at: the robot can go 1.0 m/s and more; indoors half of it is brisk.
pub const SPEED_M_S: f64 = 0.5;
/// Radians a second.
pub const TURN_RAD_S: f64 = 1.74;
/// Speeding up and slowing down, m/s².
pub const ACCELERATION_M_S2: f64 = 0.3;
/// The same for braking, m/s².
pub const BRAKING_M_S2: f64 = 0.6;
/// Turning faster and slower, rad/s².
pub const TURN_ACCELERATION_RAD_S2: f64 = 1.74;
/// What a sonar reports when nothing echoes, metres.
pub const SONAR_RANGE_M: f64 = 5.0;

/// The sixteen sonars: x ahead, y to the left (mm), bearing (degrees); the newer array.
const SONARS: [(f64, f64, f64); 16] = [
    (69.0, 136.0, 90.0),
    (114.0, 119.0, 50.0),
    (148.0, 78.0, 30.0),
    (166.0, 27.0, 10.0),
    (166.0, -27.0, -10.0),
    (148.0, -78.0, -30.0),
    (114.0, -119.0, -50.0),
    (69.0, -136.0, -90.0),
    (-157.0, -136.0, -90.0),
    (-203.0, -119.0, -130.0),
    (-237.0, -78.0, -150.0),
    (-255.0, -27.0, -170.0),
    (-255.0, 27.0, 170.0),
    (-237.0, 78.0, 150.0),
    (-203.0, 119.0, 130.0),
    (-157.0, 136.0, 90.0),
];

/// Mount (metres) and bearing (radians) of each sonar.
pub fn sonars() -> impl Iterator<Item = (Vec2, f64)> {
    SONARS.iter().map(|&(x, y, deg)| (vec2(x / 1000.0, y / 1000.0), deg.to_radians()))
}

/// The outline of the robot at `pose`, metres.
pub fn outline(pose: Pose) -> Polygon {
    let half = WIDTH_M / 2.0;
    let corners = [(-REAR_M, -half), (FRONT_M, -half), (FRONT_M, half), (-REAR_M, half)];
    Polygon::new(corners.map(|(x, y)| pose.to_world(vec2(x, y))).to_vec())
}

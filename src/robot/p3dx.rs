//! The Pioneer 3-DX in numbers (Pioneer 3 Operations Manual; AriaCoda's parameters for the p3dx-sh).

use super::Body;
use crate::geometry::{Vec2, vec2};

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
/// Braking when everything but standing still is given up (E_STOP): the top that CONFIG announces, m/s² and rad/s².
pub const EMERGENCY_BRAKING_M_S2: f64 = 4.0;
/// The same against turning: 600°/s².
pub const EMERGENCY_TURN_BRAKING_RAD_S2: f64 = 10.472;
/// What a sonar reports when nothing echoes, metres.
pub const SONAR_RANGE_M: f64 = 5.0;

/// All of that in one.
pub const BODY: Body = Body {
    front_m: FRONT_M,
    rear_m: REAR_M,
    width_m: WIDTH_M,
    swing_m: SWING_M,
    sonar_range_m: SONAR_RANGE_M,
    speed_m_s: SPEED_M_S,
    turn_rad_s: TURN_RAD_S,
    acceleration_m_s2: ACCELERATION_M_S2,
    braking_m_s2: BRAKING_M_S2,
    turn_acceleration_rad_s2: TURN_ACCELERATION_RAD_S2,
};

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

/// The same for the older array (Player; ARIA 2.7.3): the front half, of which the rear one is the mirror image.
const OLDER_FRONT_SONARS: [(f64, f64, f64); 8] = [
    (115.0, 130.0, 90.0),
    (155.0, 115.0, 50.0),
    (190.0, 80.0, 30.0),
    (210.0, 25.0, 10.0),
    (210.0, -25.0, -10.0),
    (190.0, -80.0, -30.0),
    (155.0, -115.0, -50.0),
    (115.0, -130.0, -90.0),
];

/// Which of the two published sonar arrays a robot has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum SonarArray {
    /// ARIA since 2.8, AMRISim.
    #[default]
    Newer,
    /// Player, ARIA 2.7.3.
    Older,
}

impl SonarArray {
    /// Mount (metres) and bearing (radians) of sonar `number`, 0 to 15.
    pub fn sonar(self, number: u8) -> Option<(Vec2, f64)> {
        let index = usize::from(number);
        let (x, y, deg) = match self {
            Self::Newer => *SONARS.get(index)?,
            Self::Older if index < 8 => OLDER_FRONT_SONARS[index],
            Self::Older => {
                let (x, y, deg) = *OLDER_FRONT_SONARS.get(15_usize.checked_sub(index)?)?;
                (-x, y, if deg < 0.0 { -180.0 - deg } else { 180.0 - deg })
            }
        };
        Some((vec2(x / 1000.0, y / 1000.0), deg.to_radians()))
    }
}

/// Mount (metres) and bearing (radians) of each sonar of the newer array.
pub fn sonars() -> impl Iterator<Item = (Vec2, f64)> {
    (0..16).filter_map(|number| SonarArray::Newer.sonar(number))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_older_array_is_its_own_mirror_image() {
        let degrees: Vec<i64> = (0..16)
            .filter_map(|number| SonarArray::Older.sonar(number))
            .map(|(_, bearing)| bearing.to_degrees().round() as i64)
            .collect();
        assert_eq!(degrees, [90, 50, 30, 10, -10, -30, -50, -90, -90, -130, -150, -170, 170, 150, 130, 90]);
        assert_eq!(SonarArray::Older.sonar(8).map(|(mount, _)| mount), Some(vec2(-0.115, -0.130)));
        assert_eq!(SonarArray::Older.sonar(16), None);
    }
}

//! What is imperfect about a simulated robot's wheels, sonars, compass and start.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Standard deviations and rates of everything random about a simulated robot.
///
/// Wheel errors follow Borenstein & Feng (UMBmark, 1996): what is systematic –
/// wheel diameters and track that are not as told – is drawn once for a trial,
/// as for a robot whose odometry was calibrated some time ago; slip is drawn
/// all the time. A P3DX answers after 50 to 100 ms, measured. A scene may carry its own values.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Noise {
    /// The robot is put down beside its start pose, metres along each axis.
    pub start_m: f64,
    /// The robot is put down turned against its start pose, radians.
    pub start_rad: f64,
    /// Both wheels' diameter against what the odometry counts on, a share of it.
    pub wheel_scale: f64,
    /// One wheel's diameter against the other's, a share of it: the way bends.
    pub wheel_mismatch: f64,
    /// The effective distance between the wheels against what the odometry counts on, a share of it.
    pub track_scale: f64,
    /// Each wheel's slip, metres per square root of a metre rolled.
    pub slip: f64,
    /// A sonar's range, a share of it.
    pub sonar_share: f64,
    /// A sonar's range, metres, on top of the share.
    pub sonar_m: f64,
    /// Chance that an echo is not heard.
    pub sonar_miss: f64,
    /// Chance that a sonar hears another one's ping, and reports some shorter range.
    pub sonar_crosstalk: f64,
    /// The compass against true north, drawn once for a trial: mounting and the building's steel, radians.
    pub compass_bias_rad: f64,
    /// Each compass reading, radians.
    pub compass_rad: f64,
    /// From a velocity that is asked for to the wheels that follow it, seconds.
    pub dead_time_s: f64,
    /// On top of that, up to so much, differently each time, seconds.
    pub jitter_s: f64,
}

impl Default for Noise {
    /// A Pioneer 3-DX on a hard floor.
    fn default() -> Self {
        Self {
            start_m: 0.05,
            start_rad: 0.03,
            wheel_scale: 0.01,
            wheel_mismatch: 0.002,
            track_scale: 0.015,
            slip: 0.006,
            sonar_share: 0.01,
            sonar_m: 0.005,
            sonar_miss: 0.03,
            sonar_crosstalk: 0.002,
            compass_bias_rad: 0.05,
            compass_rad: 0.035,
            dead_time_s: 0.075,
            jitter_s: 0.05,
        }
    }
}

impl Noise {
    /// A robot without any error.
    pub fn off() -> Self {
        Self::default().times(0.0)
    }

    /// Everything so many times as large.
    pub fn times(self, factor: f64) -> Self {
        Self {
            start_m: self.start_m * factor,
            start_rad: self.start_rad * factor,
            wheel_scale: self.wheel_scale * factor,
            wheel_mismatch: self.wheel_mismatch * factor,
            track_scale: self.track_scale * factor,
            slip: self.slip * factor,
            sonar_share: self.sonar_share * factor,
            sonar_m: self.sonar_m * factor,
            sonar_miss: (self.sonar_miss * factor).min(1.0),
            sonar_crosstalk: (self.sonar_crosstalk * factor).min(1.0),
            compass_bias_rad: self.compass_bias_rad * factor,
            compass_rad: self.compass_rad * factor,
            dead_time_s: self.dead_time_s * factor,
            jitter_s: self.jitter_s * factor,
        }
    }
}

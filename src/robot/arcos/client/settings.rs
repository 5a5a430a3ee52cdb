//! How the client drives.

use std::time::Duration;

use crate::robot::Body;
use crate::robot::arcos::parameters::Parameters;
use crate::robot::p3dx::{self, SonarArray};

/// Limits and manners; the defaults are safe ones.
#[derive(Clone, Debug)]
pub struct ArcosSettings {
    /// m/s.
    pub speed: f64,
    /// rad/s.
    pub turn: f64,
    /// m/s².
    pub acceleration: f64,
    /// m/s².
    pub braking: f64,
    /// rad/s², for both.
    pub turn_acceleration: f64,
    /// A velocity holds for this long unless it is asked for again.
    pub deadline: Duration,
    /// Without an information packet for this long the link is lost.
    pub link_timeout: Duration,
    /// Go on by itself after an emergency stop or a stall is over.
    pub resume: bool,
    /// Connect again when the link is lost, for as long as this.
    pub reconnect: Option<Duration>,
    /// Scales to use whatever the robot calls itself.
    pub model: Option<Parameters>,
    /// Which sonar array the robot has.
    pub sonars: SonarArray,
}

impl Default for ArcosSettings {
    fn default() -> Self {
        Self {
            speed: 0.3,
            turn: 1.0,
            acceleration: 0.3,
            braking: 0.6,
            turn_acceleration: 1.5,
            deadline: Duration::from_millis(300),
            link_timeout: Duration::from_secs(2),
            resume: false,
            reconnect: None,
            model: None,
            sonars: SonarArray::default(),
        }
    }
}

impl ArcosSettings {
    /// The robot with these limits.
    pub fn body(&self) -> Body {
        Body {
            speed_m_s: self.speed,
            turn_rad_s: self.turn,
            acceleration_m_s2: self.acceleration,
            braking_m_s2: self.braking,
            turn_acceleration_rad_s2: self.turn_acceleration,
            ..p3dx::BODY
        }
    }

    /// A velocity within the limits; what is no number is none.
    pub fn limited(&self, linear: f64, angular: f64) -> (f64, f64) {
        let within = |value: f64, most: f64| if value.is_finite() { value.clamp(-most, most) } else { 0.0 };
        (within(linear, self.speed), within(angular, self.turn))
    }
}

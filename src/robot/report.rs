//! What a client knows of its robot.

use std::time::Duration;

use super::{SonarReading, Status};
use crate::geometry::Pose;

/// The latest state of the robot.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// By odometry, from where the robot was first heard.
    pub pose: Pose,
    /// Metres driven.
    pub distance_m: f64,
    /// m/s and rad/s, as measured.
    pub velocity: (f64, f64),
    /// The last reading of each sonar.
    pub sonar: Vec<SonarReading>,
    /// Stalls and bumpers.
    pub status: Status,
    /// Front bumpers pressed, a bit each.
    pub front_bumpers: u8,
    /// Rear bumpers pressed, a bit each.
    pub rear_bumpers: u8,
    /// Volts.
    pub battery_v: f64,
    /// The motors are enabled.
    pub motors: bool,
    /// The STOP button is pressed, or its stall engaged.
    pub emergency_stop: bool,
    /// Why the robot is being held, when it is.
    pub held: Option<String>,
    /// Time on the line's clock.
    pub at: Duration,
    /// When the robot last reported.
    pub heard_at: Duration,
    /// From a command to the report that shows it, as found when connecting.
    pub dead_time: Duration,
    /// Reports so far.
    pub sips: u64,
}

impl Report {
    /// Seconds since the robot reported this.
    pub fn age_s(&self) -> f64 {
        self.at.saturating_sub(self.heard_at).as_secs_f64()
    }
}

//! One small trait for a mobile base, and the bases that have it.
//!
//! Nothing here plans: a base takes velocities and reports what it measures.

pub mod arcos;
mod body;
mod guard;
pub mod p3dx;
mod real;
mod report;
pub mod ros;
pub mod sonar;
pub mod standby;
mod threaded;

pub use body::Body;
pub use guard::guarded_speed;
pub use real::{Event, RealBase, Remote};
pub use report::Report;
pub use threaded::{Driven, Stopper, ThreadedBase};

use crate::geometry::{Pose, Vec2, vec2};

/// A differential-drive base.
pub trait MobileBase {
    /// Its outline and the limits it keeps to.
    fn body(&self) -> Body;

    /// Where the base believes it is, by odometry, in the room map's frame.
    fn pose(&self) -> Pose;

    /// Linear (m/s) and angular (rad/s, counter-clockwise) velocity, as measured.
    fn velocity(&self) -> (f64, f64);

    /// Seconds since the trial began.
    fn time_s(&self) -> f64;

    /// Asks for a velocity (m/s, rad/s) and lets `seconds` pass. The base keeps to its own limits of speed and acceleration.
    fn drive(&mut self, linear: f64, angular: f64, seconds: f64) -> Result<(), RobotError>;

    /// Seconds since the report that pose, velocity and sonars are from.
    fn age_s(&self) -> f64 {
        0.0
    }

    /// Seconds from a velocity that is asked for to the report that shows it, as found when connecting.
    fn dead_time_s(&self) -> f64 {
        0.0
    }

    /// The latest sonar readings.
    fn sonar(&self) -> &[SonarReading];

    /// The heading a compass shows, radians counter-clockwise from the map's +x; nothing where there is no compass.
    fn compass(&self) -> Option<f64> {
        None
    }

    /// What else the base reports.
    fn status(&self) -> Status;
}

/// One sonar's reading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SonarReading {
    /// Where the sonar sits on the base: x ahead, y to the left of its centre, metres.
    pub mount: Vec2,
    /// Which way it looks, radians from straight ahead.
    pub bearing: f64,
    /// Metres to the nearest echo; the body's `sonar_range_m` when there is none.
    pub range_m: f64,
}

impl SonarReading {
    /// Where the echo is, in the robot's frame, metres.
    pub fn echo(&self) -> Vec2 {
        self.mount + vec2(self.bearing.cos(), self.bearing.sin()) * self.range_m
    }
}

/// What a base reports of itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Status {
    /// A wheel is held fast.
    pub stalled: bool,
    /// A bumper is pressed.
    pub bumped: bool,
}

/// Why a base no longer does as it is asked.
#[derive(Debug, thiserror::Error)]
pub enum RobotError {
    /// It does not answer.
    #[error("the robot does not answer: {0}")]
    Link(String),
    /// It is held, by its STOP button, a stall or a person, and stands.
    #[error("{0}")]
    Held(String),
}

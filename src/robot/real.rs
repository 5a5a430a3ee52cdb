//! A base outside this process: what a trial on it needs beside driving.

use std::sync::Arc;
use std::time::Duration;

use super::MobileBase;
use crate::geometry::Pose;

/// Something worth telling, with its time on the clock of the line to the robot.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// When.
    pub at: Duration,
    /// What, for people.
    pub text: String,
}

/// A real base. Connecting to one makes it; a velocity that is not asked for again within the deadline it was
/// connected with becomes a stop, whatever the program does; dropping it stops the robot.
pub trait RealBase: MobileBase + Send {
    /// Everything to know before driving off, in one line: who it is, how it is, its limits.
    fn preflight(&self) -> &str;

    /// Time and distance begin anew.
    fn begin_trial(&mut self);

    /// Metres driven in this trial.
    fn trial_distance_m(&self) -> f64;

    /// A handle that watches and stops it from any thread.
    fn remote(&self) -> Arc<dyn Remote>;
}

/// Watches and stops a real base from any thread, such as a signal handler's.
pub trait Remote: Send + Sync {
    /// Stops the robot for good, lets go of it, and waits until that is done.
    fn stop(&self);

    /// Brings the robot to stand, and waits until it does; what it is asked for is passed over until it may go on.
    fn pause(&self);

    /// The robot may go on, zero set-points first.
    fn go_on(&self);

    /// Whether someone has told it to stop for good.
    fn is_stopping(&self) -> bool;

    /// Whether the robot moves.
    fn is_moving(&self) -> bool;

    /// Where its odometry believes it is, in the frame of the map.
    fn pose(&self) -> Pose;

    /// What happened since this was last asked.
    fn take_events(&self) -> Vec<Event>;
}

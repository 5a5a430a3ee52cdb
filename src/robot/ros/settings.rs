//! How a ROS base is driven.

use std::ffi::OsString;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use super::Names;
use crate::geometry::Pose;
use crate::robot::Body;

/// Limits and manners.
#[derive(Clone, Debug)]
pub struct RosSettings {
    /// The robot's outline and the limits to keep to.
    pub body: Body,
    /// Names of its topics.
    pub names: Names,
    /// Velocities bear their time.
    pub stamped: bool,
    /// A velocity holds for this long unless it is asked for again.
    pub deadline: Duration,
    /// Go on by itself after what held it up is over.
    pub resume: bool,
    /// The program whose second process stands by.
    pub program: Option<OsString>,
    /// Where the robot stands in the map, unless it tells by `map → odom`.
    pub start: Pose,
    /// Where its own odometry begins in the map, told here for its camera.
    pub origin: Arc<Mutex<Pose>>,
}

//! A base that runs ROS, driven like any other: velocities under a deadline, and zero on every ending.

use super::client::Client;
use super::{RosError, RosSettings, Transport};
use crate::robot::ThreadedBase;

/// Connects to ROS bases.
pub struct RosBase;

impl RosBase {
    /// Connects to the robot that `transport` reaches.
    ///
    /// # Errors
    /// When it has no odometry, nobody obeys, or ROS is not there.
    pub fn connect(transport: Box<dyn Transport>, settings: RosSettings) -> Result<ThreadedBase, RosError> {
        let (body, resume, start) = (settings.body, settings.resume, settings.start);
        let name = transport.name();
        let mut client = Client::new(transport, settings);
        client.set_up()?;
        let preflight = client.preflight();
        ThreadedBase::start(client, body, resume, preflight, start).map_err(|error| RosError::Master(name, error))
    }
}

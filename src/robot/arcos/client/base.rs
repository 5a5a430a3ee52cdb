//! A Pioneer as a mobile base: a client with a thread of its own.

use std::time::Duration;

use super::{ArcosSettings, Client, ConnectError};
use crate::geometry::Pose;
use crate::robot::arcos::line::Line;
use crate::robot::{Driven, Event, Report, RobotError, ThreadedBase};

/// Connects to Pioneers.
pub struct ArcosBase;

impl ArcosBase {
    /// Connects to the robot on `line`, which stands at `start` in the map.
    ///
    /// # Errors
    /// When no robot answers, it reports nothing, or its scales are not known.
    pub fn connect(
        line: Box<dyn Line + Send>,
        settings: ArcosSettings,
        start: Pose,
    ) -> Result<ThreadedBase, ConnectError> {
        let (resume, body) = (settings.resume, settings.body());
        let client = Client::connect(line, settings)?;
        let preflight = client.preflight();
        let thread = ThreadedBase::start(client, body, resume, preflight, start);
        thread.map_err(|error| ConnectError::Line("the robot's thread".to_string(), error))
    }
}

impl<L: Line + Send> Driven for Client<L> {
    fn ask(&mut self, linear: f64, angular: f64) {
        Self::ask(self, linear, angular);
    }

    fn zero(&mut self) {
        Self::zero(self);
    }

    fn turn(&mut self, wait: Duration) -> Result<(), RobotError> {
        Self::turn(self, wait)
    }

    fn close(&mut self) {
        Self::close(self);
    }

    fn report(&self) -> &Report {
        Self::report(self)
    }

    fn stands(&self) -> bool {
        Self::stands(self)
    }

    fn take_events(&mut self) -> Vec<Event> {
        Self::take_events(self)
    }
}

//! How a link ends: lost and found again, or with a good-bye.

use std::io;
use std::time::Duration;

use super::connection::{SPACING, TURN};
use super::handshake::Handshake;
use super::{Client, ConnectError};
use crate::robot::RobotError;
use crate::robot::arcos::codec::{Command, number};
use crate::robot::arcos::line::Line;

/// The longest time between two attempts to connect again.
const LONGEST_BACK_OFF: Duration = Duration::from_secs(4);
/// A robot that shall stand stands within this.
const STANDS_WITHIN: Duration = Duration::from_millis(1500);

impl<L: Line> Client<L> {
    /// The link is gone: for good, or until it is back.
    pub(super) fn lose(&mut self, why: String) -> Result<(), RobotError> {
        self.ask = None;
        self.note(format!("link lost: {why}"));
        let Some(limit) = self.settings.reconnect else {
            self.lost = Some(format!("{}: {why}", self.line.name()));
            return Err(RobotError::Link(format!("{}: {why}", self.line.name())));
        };
        let (began, mut back_off) = (self.line.now(), Duration::from_millis(250));
        while self.line.now().saturating_sub(began) < limit {
            self.line.sleep(back_off);
            back_off = (back_off * 2).min(LONGEST_BACK_OFF);
            if let Err(error) = self.reconnect() {
                self.note(format!("not yet: {error}"));
                continue;
            }
            let after = self.line.now().saturating_sub(began).as_secs_f64();
            self.note(format!("connected again after {after:.1} s; set-points are zero"));
            return Ok(());
        }
        self.lost = Some(format!("{}: {why}, and no way back within {} s", self.line.name(), limit.as_secs()));
        Err(RobotError::Link(self.lost.clone().unwrap_or_default()))
    }

    fn reconnect(&mut self) -> Result<(), ConnectError> {
        self.line.reopen().map_err(|error| ConnectError::Line(self.line.name(), error))?;
        self.decoder.clear();
        (self.told, self.wants_motors) = ((0, 0), false);
        let mut handshake = Handshake::new(&mut self.line, &mut self.decoder);
        let shaken = handshake.run();
        self.round_trip = handshake.round_trip();
        self.sonar_at = [None; 2];
        shaken.map_err(|error| ConnectError::Handshake(self.line.name(), error))?;
        self.heard_at = self.line.now();
        self.set_up()
    }

    /// Stops, waits until the robot stands, switches the motors off and says good-bye. Safe to call twice.
    pub fn close(&mut self) {
        if std::mem::replace(&mut self.closed, true) {
            return;
        }
        // A line that fails now leaves the rest to the robot's watchdog.
        let _ = if self.lost.is_some() { self.call_out() } else { self.say_good_bye() };
    }

    /// To a robot that is not heard, but may hear.
    fn call_out(&mut self) -> io::Result<()> {
        for command in [Command::int(number::VEL2, 0), Command::int(number::ENABLE, 0), Command::bare(number::CLOSE)] {
            self.send(&command)?;
            self.line.sleep(SPACING);
        }
        Ok(())
    }

    fn say_good_bye(&mut self) -> io::Result<()> {
        self.ask = None;
        self.told = (1, 1);
        let until = self.line.now() + STANDS_WITHIN + self.round_trip;
        self.steer()?;
        while !self.stands() && self.line.now() < until {
            self.read(TURN)?;
            self.steer()?;
        }
        self.send_spaced(&Command::int(number::ENABLE, 0))?;
        self.send_spaced(&Command::bare(number::CLOSE))?;
        self.line.sleep(SPACING);
        Ok(())
    }
}

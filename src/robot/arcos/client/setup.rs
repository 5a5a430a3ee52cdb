//! From an answer to a robot ready to drive: OPEN, CONFIG, rate, limits, and zero set-points before the motors.

use std::io;
use std::time::Duration;

use super::{Client, ConnectError};
use crate::robot::arcos::codec::{Command, number};
use crate::robot::arcos::line::Line;

/// Requests are made again after this.
const AGAIN: Duration = Duration::from_millis(250);
/// And so many times.
const TRIES: u32 = 6;
/// The rate to change to, and its number.
const BETTER_BAUD: (u32, i32) = (38400, 2);
/// A changed rate shows within this (ARIA).
const NEW_RATE: Duration = Duration::from_millis(900);

impl<L: Line> Client<L> {
    /// Brings an answered robot to where velocities mean something.
    pub(super) fn set_up(&mut self) -> Result<(), ConnectError> {
        let failed = |line: &L, error| ConnectError::Line(line.name(), error);
        self.prepare().map_err(|error| failed(&self.line, error))?;
        if self.report.sips == self.sips_before_open {
            return Err(ConnectError::Silent(self.line.name(), AGAIN * TRIES));
        }
        self.switch_rate().map_err(|error| failed(&self.line, error))?;
        self.set_limits().map_err(|error| failed(&self.line, error))?;
        self.enable_motors().map_err(|error| failed(&self.line, error))
    }

    fn prepare(&mut self) -> io::Result<()> {
        self.sips_before_open = self.report.sips;
        let sips = self.sips_before_open;
        self.ask_until(&[Command::bare(number::OPEN)], |client| client.report.sips > sips)?;
        self.ask_until(&[Command::bare(number::CONFIG)], |client| client.config.subclass.is_some())?;
        if self.config.subclass.is_none() {
            self.note("the robot sends no CONFIG packet; going on with what is known of its model");
        }
        Ok(())
    }

    /// 9600 baud carries no more than ten packets a second: a better rate is asked for where robot and user allow it.
    fn switch_rate(&mut self) -> io::Result<()> {
        let (better, code) = BETTER_BAUD;
        let can = self.config.auto_baud.is_some_and(|auto| auto >= 1) && !self.line.baud_is_fixed();
        let Some(now) = self.line.baud().filter(|baud| can && *baud < better) else { return Ok(()) };
        self.send(&Command::int(number::HOSTBAUD, code))?;
        self.line.sleep(Duration::from_millis(30));
        self.line.set_baud(better)?;
        self.decoder.clear();
        self.line.sleep(Duration::from_millis(10));
        self.send(&Command::bare(number::PULSE))?;
        let sips = self.report.sips;
        self.pause_until(NEW_RATE + self.round_trip, |client| client.report.sips > sips + 1)?;
        if self.report.sips <= sips + 1 {
            self.line.set_baud(now)?;
            self.note(format!("the robot did not follow to {better} baud; staying at {now}"));
        }
        Ok(())
    }

    fn set_limits(&mut self) -> io::Result<()> {
        let s = self.settings.clone();
        let mm = |metres: f64| (metres * 1000.0).round() as i32;
        let deg = |radians: f64| radians.to_degrees().round() as i32;
        for (number, value) in [
            (number::SETV, mm(s.speed)),
            (number::SETA, mm(s.acceleration)),
            (number::SETA, -mm(s.braking)),
            (number::SETRV, deg(s.turn)),
            (number::SETRA, deg(s.turn_acceleration)),
            (number::SETRA, -deg(s.turn_acceleration)),
            (number::SONAR, 1),
        ] {
            self.send_spaced(&Command::int(number, value))?;
        }
        Ok(())
    }

    /// Zero first, and the motors only after it: the firmware would take up the set-point of an earlier session.
    pub(super) fn enable_motors(&mut self) -> io::Result<()> {
        if self.report.emergency_stop {
            self.hold("the STOP button is pressed");
            return Ok(());
        }
        let zero_then_motors =
            [Command::int(number::VEL, 0), Command::int(number::RVEL, 0), Command::int(number::ENABLE, 1)];
        self.ask_until(&zero_then_motors, |client| client.report.motors)?;
        self.wants_motors = true;
        if !self.report.motors {
            self.hold("the motors stay disabled: press the MOTORS button, or charge the battery");
        }
        Ok(())
    }

    /// Sends commands again and again until the robot shows that they came through.
    fn ask_until(&mut self, commands: &[Command], mut done: impl FnMut(&Self) -> bool) -> io::Result<()> {
        for _ in 0..TRIES {
            for command in commands {
                self.send_spaced(command)?;
            }
            self.pause_until(AGAIN + self.round_trip, &mut done)?;
            if done(self) {
                break;
            }
        }
        Ok(())
    }
}

//! What comes from the robot, and what follows from it.

use std::time::Duration;

use super::Client;
use super::connection::SAY_AGAIN;
use super::odometry::Taken;
use crate::robot::arcos::codec::{Config, Packet, Sip};
use crate::robot::arcos::line::Line;
use crate::robot::{SonarReading, Status};

/// The sonars before this one look ahead.
const FIRST_REAR_SONAR: u8 = 8;
/// An echo older than this, two or three sweeps, is no echo.
const SONARS_SILENT: Duration = Duration::from_millis(800);
/// Longer without a packet than this many cycles is told.
const LATE_CYCLES: f64 = 1.7;

impl<L: Line> Client<L> {
    pub(super) fn take_in(&mut self, packet: &Packet) {
        if let Some(sip) = Sip::from_packet(packet) {
            self.take_in_sip(&sip);
        } else if let Some(config) = Config::from_packet(packet) {
            self.config = config;
        }
        // Others are not asked for here, and an unknown type is none of our business.
    }

    fn take_in_sip(&mut self, sip: &Sip) {
        let now = self.line.now();
        let gap = now.saturating_sub(self.heard_at);
        let cycle = f64::from(self.config.sip_cycle_ms.unwrap_or(100).max(10)) / 1000.0;
        let is_new = self.late_said.is_none_or(|said| now.saturating_sub(said) > SAY_AGAIN);
        if self.report.sips > 0 && gap.as_secs_f64() > LATE_CYCLES * cycle && is_new {
            self.late_said = Some(now);
            self.note(format!("no information packet for {} ms", gap.as_millis()));
        }
        self.heard_at = now;
        if self.odometry.take(sip, now) == Taken::Rebased {
            self.note("the robot's position counters were set anew; going on from the same place");
        }
        let p = self.parameters;
        let wheels = (f64::from(sip.left_mm_s), f64::from(sip.right_mm_s));
        let by_wheels = (wheels.1 - wheels.0) / 2.0 * p.turn_rad_per_mm;
        let turn = sip.tail.turn_ddeg_s.map_or(by_wheels, |ddeg| (f64::from(ddeg) / 10.0).to_radians());
        let report = &mut self.report;
        report.pose = self.odometry.pose();
        report.distance_m = self.odometry.distance_m();
        report.velocity = (wheels.0.midpoint(wheels.1) * p.velocity_m_s, turn);
        report.front_bumpers = sip.front_bumpers();
        report.rear_bumpers = sip.rear_bumpers();
        report.status = Status { stalled: sip.stalled(), bumped: sip.front_bumpers() | sip.rear_bumpers() != 0 };
        report.battery_v = sip.battery_v();
        report.motors = sip.flags.motors_enabled();
        report.emergency_stop = sip.flags.emergency_stopped();
        report.sips += 1;
        report.heard_at = now;
        for (number, range) in &sip.sonar {
            let Some((mount, bearing)) = p.sonars.sonar(*number) else { continue };
            self.sonar_at[usize::from(*number >= FIRST_REAR_SONAR)] = Some(now);
            let reading = SonarReading { mount, bearing, range_m: f64::from(*range) * p.range_m };
            match report.sonar.iter_mut().find(|known| known.bearing == bearing && known.mount == mount) {
                Some(known) => *known = reading,
                None => report.sonar.push(reading),
            }
        }
        self.watch();
    }

    /// What holds the robot, and what no longer does.
    fn watch(&mut self) {
        let low = self.config.low_battery_dv.map_or(11.0, |dv| f64::from(dv) / 10.0);
        if self.report.battery_v < low && !std::mem::replace(&mut self.low_battery, true) {
            self.note(format!("the battery is low: {:.1} V", self.report.battery_v));
        }
        if self.report.emergency_stop {
            self.hold("the STOP button is pressed");
        } else if self.report.status.stalled {
            self.hold("a wheel is stalled");
        } else if self.wants_motors && !self.report.motors {
            self.hold("the motors are disabled");
        } else if let Some(end) = self.deaf_end() {
            self.hold(&format!("the {end} sonars have fallen silent"));
        } else if self.settings.resume && self.report.motors && self.report.held.take().is_some() {
            self.note("free again: going on");
        }
    }

    /// The end whose sonars were heard once and are no more.
    fn deaf_end(&self) -> Option<&'static str> {
        let now = self.line.now();
        let is_deaf = |at: Option<Duration>| at.is_some_and(|at| now.saturating_sub(at) > SONARS_SILENT);
        let ends = self.sonar_at.into_iter().zip(["front", "rear"]);
        ends.into_iter().find_map(|(at, end)| is_deaf(at).then_some(end))
    }

    /// Holds the robot: no velocity is passed on until someone allows it.
    pub(super) fn hold(&mut self, why: &str) {
        if self.report.held.as_deref() != Some(why) {
            self.report.held = Some(why.to_string());
            self.note(format!("{why}: stopping"));
        }
        self.ask = None;
    }
}

//! The client itself: reads, watches, and sends what is safe to send.

use std::io;
use std::time::Duration;

use super::handshake::Handshake;
use super::odometry::Taken;
use super::{ConnectError, Event, Identity, Odometry, Report, Settings, guarded_speed};
use crate::robot::arcos::codec::{Command, Config, Counters, Decoder, Packet, Sip, number};
use crate::robot::arcos::line::Line;
use crate::robot::arcos::parameters::Parameters;
use crate::robot::{MobileBase, RobotError, SonarReading, Status};

use crate::geometry::Pose;

/// Between two commands (Operations Manual: 3 to 5 ms).
const SPACING: Duration = Duration::from_millis(4);
/// A stop is repeated this often until the robot stands.
const STOP_AGAIN: Duration = Duration::from_millis(60);
/// A robot with nothing to do hears from us this often.
const PULSE: Duration = Duration::from_millis(500);
/// Longer without a packet than this many cycles is told.
const LATE_CYCLES: f64 = 1.7;
/// Faults of the line are summed up over this time.
const SUM_UP: Duration = Duration::from_secs(1);
/// The longest time between two attempts to connect again.
const LONGEST_BACK_OFF: Duration = Duration::from_secs(4);
/// A robot that shall stand stands within this.
const STANDS_WITHIN: Duration = Duration::from_millis(1500);
/// One turn of the loop waits for bytes no longer than this.
const TURN: Duration = Duration::from_millis(20);

/// A velocity that was asked for.
#[derive(Clone, Copy, Debug)]
struct Ask {
    linear: f64,
    angular: f64,
    at: Duration,
    sent: bool,
}

/// A robot at the end of a line.
pub struct Client<L: Line> {
    pub(super) line: L,
    pub(super) decoder: Decoder,
    pub(super) settings: Settings,
    pub(super) identity: Identity,
    pub(super) config: Config,
    pub(super) report: Report,
    pub(super) sips_before_open: u64,
    pub(super) wants_motors: bool,
    parameters: Parameters,
    odometry: Odometry,
    ask: Option<Ask>,
    /// The velocity the robot was last told, mm/s and °/s.
    told: (i32, i32),
    told_at: Duration,
    heard_at: Duration,
    guarding: bool,
    low_battery: bool,
    events: Vec<Event>,
    summed_up: (Duration, Counters),
    lost: Option<String>,
    closed: bool,
}

impl<L: Line> Client<L> {
    /// Finds the robot, and brings it to stand ready with its motors on.
    pub fn connect(mut line: L, settings: Settings) -> Result<Self, ConnectError> {
        let mut decoder = Decoder::default();
        let shaken = Handshake::new(&mut line, &mut decoder).run();
        let identity = shaken.map_err(|error| ConnectError::Handshake(line.name(), error))?;
        let parameters = settings.model.or_else(|| Parameters::of(&identity.subclass));
        let Some(mut parameters) = parameters else {
            return Err(ConnectError::UnknownModel(line.name(), identity.subclass));
        };
        parameters.sonars = settings.sonars;
        let now = line.now();
        let mut client = Self {
            odometry: Odometry::new(parameters, settings.speed),
            line,
            decoder,
            settings,
            identity,
            config: Config::default(),
            report: Report::default(),
            sips_before_open: 0,
            wants_motors: false,
            parameters,
            ask: None,
            told: (0, 0),
            told_at: now,
            heard_at: now,
            guarding: false,
            low_battery: false,
            events: Vec::new(),
            summed_up: (now, Counters::default()),
            lost: None,
            closed: false,
        };
        client.set_up()?;
        Ok(client)
    }

    /// What the robot last reported.
    pub fn report(&self) -> &Report {
        &self.report
    }

    /// What the robot says it is set to.
    pub fn config(&self) -> &Config {
        &self.config
    }

    /// What came over the line, good and bad.
    pub fn counters(&self) -> Counters {
        self.decoder.counters()
    }

    /// The line.
    pub fn line(&mut self) -> &mut L {
        &mut self.line
    }

    /// What happened since this was last asked.
    pub fn take_events(&mut self) -> Vec<Event> {
        std::mem::take(&mut self.events)
    }

    /// Everything to know before driving off, in one line.
    pub fn preflight(&self) -> String {
        let (r, s, c) = (&self.report, &self.settings, &self.config);
        let firmware = c.firmware.as_deref().unwrap_or("unknown");
        let watchdog = c.watchdog_ms.map_or("unknown".to_string(), |ms| format!("{ms} ms"));
        let line = self.line.baud().map_or(String::new(), |baud| format!(", {baud} baud"));
        format!(
            "{} \"{}\" at {}{line}: battery {:.1} V, motors {}, {} sonars, firmware {firmware}, at most {:.2} m/s and {:.0}°/s, \
             {:.2} m/s², stops after {} ms without a command (robot: {watchdog})",
            self.identity.subclass,
            self.identity.name,
            self.line.name(),
            r.battery_v,
            if r.motors { "on" } else { "off" },
            r.sonar.len(),
            s.speed,
            s.turn.to_degrees(),
            s.acceleration,
            s.deadline.as_millis(),
        )
    }

    /// Asks for a velocity, m/s and rad/s; it holds until the deadline.
    pub fn ask(&mut self, linear: f64, angular: f64) {
        let (linear, angular) = self.settings.limited(linear, angular);
        self.ask = Some(Ask { linear, angular, at: self.line.now(), sent: false });
    }

    /// One turn: takes in what came within `wait`, and sends what is due.
    pub fn turn(&mut self, wait: Duration) -> Result<(), RobotError> {
        if let Some(why) = &self.lost {
            return Err(RobotError::Link(why.clone()));
        }
        let done = self.read(wait).and_then(|()| self.steer());
        let silent = self.line.now().saturating_sub(self.heard_at);
        match done {
            Ok(()) if silent <= self.settings.link_timeout => Ok(()),
            Ok(()) => self.lose(format!("nothing heard for {:.1} s", silent.as_secs_f64())),
            Err(error) => self.lose(error.to_string()),
        }
    }

    /// Lets time pass, with everything that goes on meanwhile.
    pub(super) fn pause_until(&mut self, time: Duration, mut done: impl FnMut(&Self) -> bool) -> io::Result<()> {
        let until = self.line.now() + time;
        while self.line.now() < until && !done(self) {
            self.read(TURN.min(until.saturating_sub(self.line.now())))?;
        }
        Ok(())
    }

    fn read(&mut self, wait: Duration) -> io::Result<()> {
        let mut buffer = [0; 512];
        let count = self.line.read(&mut buffer, wait)?;
        let now = self.line.now();
        self.decoder.push(&buffer[..count], now);
        while let Some(packet) = self.decoder.next(now) {
            self.take_in(&packet);
        }
        self.report.at = now;
        self.sum_up_faults(now);
        Ok(())
    }

    fn take_in(&mut self, packet: &Packet) {
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
        if self.report.sips > 0 && gap.as_secs_f64() > LATE_CYCLES * cycle {
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
        for (number, range) in &sip.sonar {
            let Some((mount, bearing)) = p.sonars.sonar(*number) else { continue };
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
        } else if self.settings.resume && self.report.motors && self.report.held.take().is_some() {
            self.note("free again: going on");
        }
    }

    /// Holds the robot: no velocity is passed on until someone allows it.
    pub(super) fn hold(&mut self, why: &str) {
        if self.report.held.as_deref() != Some(why) {
            self.report.held = Some(why.to_string());
            self.note(format!("{why}: stopping"));
        }
        self.ask = None;
    }

    /// The velocity that is safe now, mm/s and °/s.
    fn wanted(&mut self) -> (i32, i32) {
        let now = self.line.now();
        let Some(ask) = self.ask.filter(|_| self.report.held.is_none()) else { return (0, 0) };
        if now.saturating_sub(ask.at) > self.settings.deadline {
            self.ask = None;
            if ask.linear != 0.0 || ask.angular != 0.0 {
                self.note(format!("no new velocity for {} ms: stopping", self.settings.deadline.as_millis()));
            }
            return (0, 0);
        }
        let (speed, why) = guarded_speed(ask.linear, &self.report);
        let began = !std::mem::replace(&mut self.guarding, why.is_some());
        if let Some(why) = why.filter(|_| began) {
            self.note(why);
        }
        ((speed * 1000.0) as i32, ask.angular.to_degrees().round() as i32)
    }

    /// Sends what is due: a velocity each time it is asked for, a stop until the robot stands, a pulse now and then.
    fn steer(&mut self) -> io::Result<()> {
        let now = self.line.now();
        let wanted = self.wanted();
        let since = now.saturating_sub(self.told_at);
        let standing = self.report.velocity.0.abs() < 0.005 && self.report.velocity.1.abs() < 0.01;
        let is_new = self.ask.is_some_and(|ask| !ask.sent);
        let due = if wanted == (0, 0) {
            self.told != wanted || (!standing && since >= STOP_AGAIN)
        } else {
            is_new || self.told != wanted
        };
        if let Some(ask) = &mut self.ask {
            ask.sent = true;
        }
        if due {
            self.told = wanted;
            self.send(&Command::int(number::VEL, wanted.0))?;
            return self.send_spaced(&Command::int(number::RVEL, wanted.1));
        }
        if wanted == (0, 0) && since >= PULSE {
            if self.settings.resume && self.wants_motors && !self.report.motors && !self.report.emergency_stop {
                self.send(&Command::int(number::VEL, 0))?;
                self.send_spaced(&Command::int(number::RVEL, 0))?;
                return self.send_spaced(&Command::int(number::ENABLE, 1));
            }
            return self.send(&Command::bare(number::PULSE));
        }
        Ok(())
    }

    /// Sends a command after a pause for the one before it.
    pub(super) fn send_spaced(&mut self, command: &Command) -> io::Result<()> {
        self.pause_until(SPACING, |_| false)?;
        self.send(command)
    }

    pub(super) fn send(&mut self, command: &Command) -> io::Result<()> {
        self.told_at = self.line.now();
        self.line.write(&command.to_packet().to_bytes())
    }

    pub(super) fn note(&mut self, text: impl Into<String>) {
        self.events.push(Event { at: self.line.now(), text: text.into() });
    }

    /// Faults of the line, told at most once a second.
    fn sum_up_faults(&mut self, now: Duration) {
        let (at, before) = self.summed_up;
        let new = self.decoder.counters().since(&before);
        if new.faults() > 0 && now.saturating_sub(at) >= SUM_UP {
            self.summed_up = (now, self.decoder.counters());
            self.note(format!(
                "the line: {} wrong checksums, {} wrong counts, {} packets cut short, {} bytes skipped, {} good packets",
                new.bad_checksum, new.bad_count, new.cut_short, new.skipped, new.good
            ));
        }
    }

    fn lose(&mut self, why: String) -> Result<(), RobotError> {
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
        let shaken = Handshake::new(&mut self.line, &mut self.decoder).run();
        shaken.map_err(|error| ConnectError::Handshake(self.line.name(), error))?;
        self.heard_at = self.line.now();
        self.set_up()
    }

    /// Stops, waits until the robot stands, switches the motors off and says good-bye. Safe to call twice.
    pub fn close(&mut self) {
        if std::mem::replace(&mut self.closed, true) || self.lost.is_some() {
            return;
        }
        // A line that fails now leaves the rest to the robot's watchdog.
        let _ = self.say_good_bye();
    }

    fn say_good_bye(&mut self) -> io::Result<()> {
        self.ask = None;
        self.told = (1, 1);
        let until = self.line.now() + STANDS_WITHIN;
        let sips = self.report.sips;
        loop {
            self.steer()?;
            self.read(TURN)?;
            let standing = self.report.velocity.0.abs() < 0.005 && self.report.velocity.1.abs() < 0.01;
            if (standing && self.report.sips > sips) || self.line.now() >= until {
                break;
            }
        }
        self.send_spaced(&Command::int(number::ENABLE, 0))?;
        self.send_spaced(&Command::bare(number::CLOSE))?;
        self.line.sleep(SPACING);
        Ok(())
    }
}

impl<L: Line> Drop for Client<L> {
    fn drop(&mut self) {
        self.close();
    }
}

impl<L: Line> MobileBase for Client<L> {
    fn pose(&self) -> Pose {
        self.report.pose
    }

    fn velocity(&self) -> (f64, f64) {
        self.report.velocity
    }

    fn time_s(&self) -> f64 {
        self.report.at.as_secs_f64()
    }

    fn drive(&mut self, linear: f64, angular: f64, seconds: f64) -> Result<(), RobotError> {
        let until = self.line.now() + Duration::from_secs_f64(seconds);
        self.ask(linear, angular);
        while self.line.now() < until {
            self.turn(TURN)?;
        }
        match &self.report.held {
            Some(why) if !self.settings.resume => Err(RobotError::Held(why.clone())),
            _ => Ok(()),
        }
    }

    fn sonar(&self) -> &[SonarReading] {
        &self.report.sonar
    }

    fn status(&self) -> Status {
        self.report.status
    }
}

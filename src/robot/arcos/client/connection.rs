//! The client itself: reads, watches, and sends what is safe to send.

use std::io;
use std::time::Duration;

use super::handshake::Handshake;
use super::{ArcosSettings, ConnectError, Identity, Odometry};
use crate::geometry::Pose;
use crate::robot::arcos::codec::{Command, Config, Counters, Decoder, number};
use crate::robot::arcos::line::Line;
use crate::robot::arcos::parameters::Parameters;
use crate::robot::{Body, Event, MobileBase, Report, RobotError, SonarReading, Status, guarded_speed};

/// Between two commands (Operations Manual: 3 to 5 ms).
pub(super) const SPACING: Duration = Duration::from_millis(4);
/// A stop is repeated this often until the robot stands.
const STOP_AGAIN: Duration = Duration::from_millis(20);
/// A report that comes sooner than this after a command was made before it.
const HEARS_WITHIN: Duration = Duration::from_millis(120);
/// A robot that was told something does it after this (measured on robots: 50 to 100 ms).
const BASE_ANSWERS: Duration = Duration::from_millis(50);
/// Without a report for this long, or so many of its cycles, the robot is stopped until it reports again.
const SILENCE: Duration = Duration::from_millis(400);
const SILENT_CYCLES: u32 = 4;
/// That a report is late, or what sonars and bumpers forbid, is said at most so often.
pub(super) const SAY_AGAIN: Duration = Duration::from_secs(5);
/// A robot with nothing to do hears from us this often.
const IDLE: Duration = Duration::from_millis(500);
/// Faults of the line are summed up over this time.
const SUM_UP: Duration = Duration::from_secs(1);
/// One turn of the loop waits for bytes no longer than this.
pub(super) const TURN: Duration = Duration::from_millis(20);

/// A velocity that was asked for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ask {
    linear: f64,
    angular: f64,
    at: Duration,
    sent: bool,
}

/// A robot at the end of a line.
pub struct Client<L: Line> {
    pub(super) line: L,
    pub(super) decoder: Decoder,
    pub(super) settings: ArcosSettings,
    pub(super) identity: Identity,
    pub(super) config: Config,
    pub(super) report: Report,
    /// From a word to its answer, as found when connecting.
    pub(super) round_trip: Duration,
    pub(super) sips_before_open: u64,
    pub(super) wants_motors: bool,
    pub(super) parameters: Parameters,
    pub(super) odometry: Odometry,
    pub(super) ask: Option<Ask>,
    /// The velocity the robot was last told, mm/s and °/s.
    pub(super) told: (i32, i32),
    pub(super) told_at: Duration,
    /// Since when it is told to stand.
    pub(super) zero_at: Duration,
    pub(super) heard_at: Duration,
    /// Since when sonars and bumpers have been said to have the last word.
    pub(super) guarding: Option<Duration>,
    /// When a report was last said to be late.
    pub(super) late_said: Option<Duration>,
    /// The robot has not reported for too long to be driven.
    pub(super) is_silent: bool,
    /// When the front sonars and the rear ones were last heard.
    pub(super) sonar_at: [Option<Duration>; 2],
    pub(super) low_battery: bool,
    pub(super) events: Vec<Event>,
    pub(super) summed_up: (Duration, Counters),
    pub(super) lost: Option<String>,
    pub(super) closed: bool,
}

impl<L: Line> Client<L> {
    /// Finds the robot, and brings it to stand ready with its motors on.
    ///
    /// # Errors
    /// When no robot answers, it reports nothing, or its scales are not known.
    pub fn connect(mut line: L, settings: ArcosSettings) -> Result<Self, ConnectError> {
        let mut decoder = Decoder::patient();
        let mut handshake = Handshake::new(&mut line, &mut decoder);
        let (shaken, round_trip) = (handshake.run(), handshake.round_trip());
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
            report: Report { dead_time: round_trip + BASE_ANSWERS, ..Report::default() },
            round_trip,
            sips_before_open: 0,
            wants_motors: false,
            parameters,
            ask: None,
            told: (0, 0),
            told_at: now,
            zero_at: now,
            heard_at: now,
            guarding: None,
            late_said: None,
            is_silent: false,
            sonar_at: [None; 2],
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
    ///
    /// # Errors
    /// When the line fails, or the robot has been silent too long.
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

    pub(super) fn read(&mut self, wait: Duration) -> io::Result<()> {
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

    /// Nothing is asked for any more: zero set-points go out at the next turn, whatever was told before. Time that
    /// passed unheard, as in a process that was suspended, does not count.
    pub(super) fn zero(&mut self) {
        (self.ask, self.told, self.heard_at) = (None, (1, 1), self.line.now());
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
        if self.falls_silent(now) {
            // What was asked for before the silence is not taken up after it.
            self.ask = None;
            return (0, 0);
        }
        let (speed, why) = guarded_speed(ask.linear, &self.report);
        let is_new = self.guarding.is_none_or(|said| now.saturating_sub(said) > SAY_AGAIN);
        if let Some(why) = why.filter(|_| is_new) {
            self.guarding = Some(now);
            self.note(why);
        }
        ((speed * 1000.0) as i32, ask.angular.to_degrees().round() as i32)
    }

    /// Whether the robot has not reported for so long that it would be driven blind; said when it begins.
    fn falls_silent(&mut self, now: Duration) -> bool {
        let cycle = Duration::from_millis(u64::from(self.config.sip_cycle_ms.unwrap_or(100)));
        let silence = SILENCE.max(cycle * SILENT_CYCLES);
        let is_silent = now.saturating_sub(self.heard_at) > silence;
        if is_silent && !self.is_silent {
            self.note(format!("nothing heard for {} ms: stopping until the robot reports again", silence.as_millis()));
        }
        self.is_silent = is_silent;
        is_silent
    }

    /// Sends what is due: a velocity each time it is asked for, zero until the robot stands and now and then after it.
    ///
    /// Zero goes as VEL2, one packet for both: after a silence the first packet
    /// is the sign to take up the old set-points, and must replace them all.
    pub(super) fn steer(&mut self) -> io::Result<()> {
        let now = self.line.now();
        let wanted = self.wanted();
        let is_new = self.ask.is_some_and(|ask| !ask.sent);
        if let Some(ask) = &mut self.ask {
            ask.sent = true;
        }
        if wanted == (0, 0) {
            return self.stand(now);
        }
        if !is_new && self.told == wanted {
            return Ok(());
        }
        self.told = wanted;
        self.send(&Command::int(number::VEL, wanted.0))?;
        self.send_spaced(&Command::int(number::RVEL, wanted.1))
    }

    fn stand(&mut self, now: Duration) -> io::Result<()> {
        let since = now.saturating_sub(self.told_at);
        let is_new = self.told != (0, 0);
        if is_new {
            (self.told, self.zero_at) = ((0, 0), now);
        }
        let again = if self.stands() { IDLE } else { STOP_AGAIN };
        if !is_new && since < again {
            return Ok(());
        }
        self.send(&Command::int(number::VEL2, 0))?;
        let frees = self.settings.resume && self.wants_motors && !self.report.motors && !self.report.emergency_stop;
        if frees { self.send_spaced(&Command::int(number::ENABLE, 1)) } else { Ok(()) }
    }

    /// Whether the robot says that it stands, and said so after it was told to.
    pub(super) fn stands(&self) -> bool {
        let (linear, angular) = self.report.velocity;
        linear.abs() < 0.005 && angular.abs() < 0.01 && self.heard_at > self.zero_at + HEARS_WITHIN + self.round_trip
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
}

impl<L: Line> Drop for Client<L> {
    fn drop(&mut self) {
        self.close();
    }
}

impl<L: Line> MobileBase for Client<L> {
    fn age_s(&self) -> f64 {
        self.report.age_s()
    }

    fn dead_time_s(&self) -> f64 {
        self.report.dead_time.as_secs_f64()
    }

    fn body(&self) -> Body {
        self.settings.body()
    }

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

//! The client itself: watches over silence, and tells the robot what is safe to tell.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use super::beams::Frames;
use super::track::Track;
use super::{Header, Message, RosSettings, Transport};
use crate::robot::{Driven, Event, Report, RobotError, SonarReading, guarded_speed};

/// Without odometry for this long, or so many of its cycles, the robot is stopped until it reports again.
pub(super) const SILENCE: Duration = Duration::from_millis(400);
const SILENT_CYCLES: u32 = 4;
/// The same for what measures distances: sonars come ten times a second, some scanners five.
const BLIND: Duration = Duration::from_millis(1000);
/// Without one of them for this long the robot is lost.
const LOST: Duration = Duration::from_secs(5);
/// A velocity is said again this often; a stop, until the robot stands.
const SAY_AGAIN: Duration = Duration::from_millis(100);
pub(super) const STOP_AGAIN: Duration = Duration::from_millis(20);
/// A robot that is told to stand does within this.
const STANDS_WITHIN: Duration = Duration::from_millis(1500);
/// A robot with nothing to do is told to stand for this long, then left to whoever else drives it.
const STANDS_FOR: Duration = Duration::from_millis(1500);
/// The same remark comes at most so often.
const REMARK_AGAIN: Duration = Duration::from_secs(5);

/// What measures distances, a topic each.
pub(super) struct Ears {
    pub(super) readings: Vec<SonarReading>,
    pub(super) heard_at: Duration,
}

pub(super) struct Client {
    pub(super) transport: Box<dyn Transport>,
    pub(super) settings: RosSettings,
    pub(super) began: Instant,
    pub(super) command: String,
    pub(super) odometry: String,
    pub(super) report: Report,
    pub(super) track: Track,
    pub(super) frames: Frames,
    /// The base's own frame.
    pub(super) base_frame: String,
    pub(super) odometry_frame: String,
    /// Between two odometry messages, as heard.
    pub(super) cycle: Duration,
    /// Our clock less the robot's, seconds.
    pub(super) clock: Option<f64>,
    pub(super) ears: BTreeMap<String, Ears>,
    /// Topics that stop the robot while they say so.
    pub(super) holds: BTreeMap<String, &'static str>,
    pub(super) ask: Option<(f64, f64, Duration)>,
    pub(super) told: (f64, f64),
    pub(super) told_at: Duration,
    /// Since when it is told to stand.
    pub(super) zero_at: Option<Duration>,
    pub(super) silent: bool,
    pub(super) remarks: BTreeMap<&'static str, Duration>,
    pub(super) events: Vec<Event>,
    pub(super) lost: Option<String>,
    pub(super) closed: bool,
}

/// Topics whose word stops the robot: yes to the first two, no to the third.
pub(super) const BUMPER: &str = "/bumper";
pub(super) const STOP_BUTTON: &str = "/estop";
pub(super) const MOTORS: &str = "/motors_state";

impl Client {
    pub(super) fn new(transport: Box<dyn Transport>, settings: RosSettings) -> Self {
        let (command, odometry) = (settings.names.of("/cmd_vel"), settings.names.of("/odom"));
        Self {
            transport,
            settings,
            began: Instant::now(),
            command,
            odometry,
            report: Report::default(),
            track: Track::default(),
            frames: Frames::default(),
            base_frame: String::new(),
            odometry_frame: String::new(),
            cycle: Duration::from_millis(50),
            clock: None,
            ears: BTreeMap::new(),
            holds: BTreeMap::new(),
            ask: None,
            told: (0.0, 0.0),
            told_at: Duration::ZERO,
            zero_at: None,
            silent: false,
            remarks: BTreeMap::new(),
            events: Vec::new(),
            lost: None,
            closed: false,
        }
    }

    pub(super) fn now(&self) -> Duration {
        self.began.elapsed()
    }

    pub(super) fn note(&mut self, text: impl Into<String>) {
        let at = self.now();
        self.events.push(Event { at, text: text.into() });
    }

    /// Says it unless it was said a moment ago.
    pub(super) fn remark(&mut self, about: &'static str, text: impl Into<String>) {
        let now = self.now();
        if self.remarks.get(about).is_none_or(|at| now.saturating_sub(*at) > REMARK_AGAIN) {
            self.remarks.insert(about, now);
            self.note(text);
        }
    }

    pub(super) fn velocity(&self, linear: f64, angular: f64) -> Message {
        if !self.settings.stamped {
            return Message::Twist(linear, angular);
        }
        let stamp_s = self.clock.map_or(0.0, |ahead| self.now().as_secs_f64() - ahead);
        Message::TwistStamped(Header { stamp_s, frame: self.base_frame.clone() }, linear, angular)
    }

    /// What is silent for too long, and for how long.
    pub(super) fn silence(&self) -> Option<(String, Duration)> {
        let now = self.now();
        let odometry = now.saturating_sub(self.report.heard_at);
        if odometry > SILENCE.max(self.cycle * SILENT_CYCLES) {
            return Some((self.odometry.clone(), odometry));
        }
        let ears = self.ears.iter().map(|(topic, ears)| (topic.clone(), now.saturating_sub(ears.heard_at)));
        ears.filter(|(_, silent)| *silent > BLIND).max_by_key(|(_, silent)| *silent)
    }

    /// Tells the robot what is safe to tell.
    pub(super) fn steer(&mut self) -> Result<(), RobotError> {
        let now = self.now();
        let silence = self.silence();
        if let Some((topic, silent)) = &silence {
            if *silent > LOST {
                return Err(RobotError::Link(format!("{topic} is silent for {:.0} s", silent.as_secs_f64())));
            }
            self.silent |= *topic == self.odometry;
            self.remark("silence", format!("{topic} is silent; the robot is stopped until it speaks again"));
        }
        let fresh = self.ask.filter(|(_, _, at)| now.saturating_sub(*at) <= self.settings.deadline);
        let wanted = fresh.filter(|_| silence.is_none() && self.report.held.is_none());
        let (linear, angular, is_new) =
            wanted.map_or((0.0, 0.0, false), |(linear, angular, at)| (linear, angular, at > self.told_at));
        let (linear, why) = guarded_speed(linear, &self.report);
        if let Some(why) = why {
            self.remark("guard", why);
        }
        self.tell(linear, angular, is_new, now);
        Ok(())
    }

    pub(super) fn tell(&mut self, linear: f64, angular: f64, is_new: bool, now: Duration) {
        let stands = (linear, angular) == (0.0, 0.0);
        let changed = (linear, angular) != self.told;
        if !stands {
            self.zero_at = None;
        } else if changed {
            self.zero_at = Some(now);
        }
        let idle = stands && self.zero_at.is_none_or(|at| now.saturating_sub(at) > STANDS_FOR);
        let again = if stands && !self.stands() { STOP_AGAIN } else { SAY_AGAIN };
        if changed || is_new || (!idle && now.saturating_sub(self.told_at) >= again) {
            let message = self.velocity(linear, angular);
            self.transport.publish(&self.command, &message);
            (self.told, self.told_at) = ((linear, angular), now);
        }
    }
}

impl Driven for Client {
    fn ask(&mut self, linear: f64, angular: f64) {
        let body = &self.settings.body;
        let within = |value: f64, most: f64| if value.is_finite() { value.clamp(-most, most) } else { 0.0 };
        self.ask = Some((within(linear, body.speed_m_s), within(angular, body.turn_rad_s), self.now()));
    }

    fn zero(&mut self) {
        // What was told is no longer known: zero is said next.
        (self.ask, self.told) = (None, (f64::NAN, f64::NAN));
    }

    fn turn(&mut self, wait: Duration) -> Result<(), RobotError> {
        self.listen(wait);
        let lost = self.lost.clone().map(RobotError::Link);
        let steered = lost.map_or_else(|| self.steer(), Err);
        if steered.is_err() {
            self.close();
        }
        steered
    }

    /// Zero, again and again, until the robot stands; nothing more after it.
    fn close(&mut self) {
        if std::mem::replace(&mut self.closed, true) {
            return;
        }
        self.ask = None;
        let began = self.now();
        self.zero_at = Some(began);
        let least = STOP_AGAIN * 10;
        while self.now() - began < least || (!self.stands() && self.now() - began < STANDS_WITHIN) {
            let zero = self.velocity(0.0, 0.0);
            self.transport.publish(&self.command, &zero);
            self.listen(STOP_AGAIN);
            std::thread::sleep(Duration::from_millis(5));
        }
        self.transport.leave();
    }

    fn report(&self) -> &Report {
        &self.report
    }

    fn stands(&self) -> bool {
        let (linear, angular) = self.report.velocity;
        let heard = self.zero_at.is_some_and(|at| self.report.heard_at > at + self.report.dead_time);
        linear.abs() < 0.005 && angular.abs() < 0.01 && heard
    }

    fn take_events(&mut self) -> Vec<Event> {
        std::mem::take(&mut self.events)
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        self.close();
    }
}

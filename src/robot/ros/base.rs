//! A base that runs ROS, driven like any other: velocities under a deadline, and zero on every ending.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::beams::{Frames, of_cloud, of_range, of_scan};
use super::track::Track;
use super::{Header, Incoming, Kind, Message, Names, Odometry, RosError, Transport};
use crate::geometry::{Pose, wrap_angle};
use crate::robot::{Body, Driven, Event, Report, RobotError, SonarReading, ThreadedBase, guarded_speed};

/// What a ROS base needs is there within this.
const THERE_WITHIN: Duration = Duration::from_secs(8);
/// Transforms are waited for so long.
const PLACED_WITHIN: Duration = Duration::from_millis(1500);
/// Without odometry for this long, or so many of its cycles, the robot is stopped until it reports again.
const SILENCE: Duration = Duration::from_millis(400);
const SILENT_CYCLES: u32 = 4;
/// The same for what measures distances: sonars come ten times a second, some scanners five.
const BLIND: Duration = Duration::from_millis(1000);
/// Without one of them for this long the robot is lost.
const LOST: Duration = Duration::from_secs(5);
/// A velocity is said again this often; a stop, until the robot stands.
const SAY_AGAIN: Duration = Duration::from_millis(100);
const STOP_AGAIN: Duration = Duration::from_millis(20);
/// A robot that is told to stand does within this.
const STANDS_WITHIN: Duration = Duration::from_millis(1500);
/// A robot with nothing to do is told to stand for this long, then left to whoever else drives it.
const STANDS_FOR: Duration = Duration::from_millis(1500);
/// The same remark comes at most so often.
const REMARK_AGAIN: Duration = Duration::from_secs(5);
/// Stamps that go back, or run ahead of our clock, by more than this, seconds, are a clock that was set.
const CLOCK_JUMP_S: f64 = 1.0;
/// From a velocity to the odometry that shows it, beside one cycle of it (measured on robots: 50 to 100 ms).
const BASE_ANSWERS: Duration = Duration::from_millis(60);

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

/// What measures distances, a topic each.
struct Ears {
    readings: Vec<SonarReading>,
    heard_at: Duration,
}

struct Client {
    transport: Box<dyn Transport>,
    settings: RosSettings,
    began: Instant,
    command: String,
    odometry: String,
    report: Report,
    track: Track,
    frames: Frames,
    /// The base's own frame.
    base_frame: String,
    odometry_frame: String,
    /// Between two odometry messages, as heard.
    cycle: Duration,
    /// Our clock less the robot's, seconds.
    clock: Option<f64>,
    ears: BTreeMap<String, Ears>,
    /// Topics that stop the robot while they say so.
    holds: BTreeMap<String, &'static str>,
    ask: Option<(f64, f64, Duration)>,
    told: (f64, f64),
    told_at: Duration,
    /// Since when it is told to stand.
    zero_at: Option<Duration>,
    silent: bool,
    remarks: BTreeMap<&'static str, Duration>,
    events: Vec<Event>,
    lost: Option<String>,
    closed: bool,
}

/// Topics whose word stops the robot: yes to the first two, no to the third.
const BUMPER: &str = "/bumper";
const STOP_BUTTON: &str = "/estop";
const MOTORS: &str = "/motors_state";

impl Client {
    fn new(transport: Box<dyn Transport>, settings: RosSettings) -> Self {
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

    fn now(&self) -> Duration {
        self.began.elapsed()
    }

    fn lacks(&self, what: String) -> RosError {
        RosError::Lacks(self.transport.name(), what)
    }

    /// Joins the topics, and waits for what a robot cannot be driven without.
    fn set_up(&mut self) -> Result<(), RosError> {
        let kind = if self.settings.stamped { Kind::TwistStamped } else { Kind::Twist };
        self.transport.advertise(&self.command, kind, false)?;
        let zero = self.velocity(0.0, 0.0);
        if let Some(program) = self.settings.program.clone() {
            self.transport.guard(&program, &self.command, &zero);
        }
        self.transport.subscribe(&self.odometry, Kind::Odometry)?;
        for topic in ["/tf", "/tf_static"] {
            self.transport.subscribe(&self.settings.names.of(topic), Kind::Transforms)?;
        }
        self.await_that(THERE_WITHIN, |client| client.report.sips > 1)?;
        if self.report.sips == 0 {
            return Err(self.lacks(format!("no odometry on {} ({})", self.odometry, self.others(Kind::Odometry)?)));
        }
        self.join_senses()?;
        self.await_that(THERE_WITHIN, |client| client.transport.listeners(&client.command) > 0)?;
        if self.transport.listeners(&self.command) == 0 {
            let what = "nobody listens to it: is the base up, and is this its topic (--remap /cmd_vel:=/its/topic)?";
            return Err(self.lacks(format!("{}: {what}", self.command)));
        }
        self.await_that(PLACED_WITHIN, |client| client.has_all())?;
        Ok(())
    }

    fn has_all(&self) -> bool {
        !self.ears.is_empty() && self.ears.values().all(|ears| !ears.readings.is_empty())
    }

    /// Every topic that measures distances, and those that stop the robot.
    fn join_senses(&mut self) -> Result<(), RosError> {
        let topics = self.transport.topics()?;
        let names = &self.settings.names;
        let (scan, sonar) = (names.of("/scan"), names.of("/sonar"));
        let home = names.of("");
        let senses = topics.iter().filter_map(|(topic, kind)| {
            let kind = Kind::of(kind)?;
            let is_ours = match kind {
                Kind::Scan => *topic == scan,
                Kind::Cloud => *topic == sonar,
                Kind::Range => topic.starts_with(&home),
                _ => false,
            };
            is_ours.then(|| (topic.clone(), kind))
        });
        let senses: Vec<(String, Kind)> = senses.collect();
        for (topic, kind) in senses {
            self.transport.subscribe(&topic, kind)?;
            self.ears.insert(topic, Ears { readings: Vec::new(), heard_at: self.now() });
        }
        for topic in [BUMPER, STOP_BUTTON, MOTORS] {
            let theirs = self.settings.names.of(topic);
            if topics.iter().any(|(name, kind)| *name == theirs && kind == Kind::Flag.name()) {
                self.transport.subscribe(&theirs, Kind::Flag)?;
                self.holds.insert(theirs, topic);
            }
        }
        Ok(())
    }

    /// Topics of this kind that there are.
    fn others(&self, kind: Kind) -> Result<String, RosError> {
        let topics = self.transport.topics()?;
        let those: Vec<String> =
            topics.into_iter().filter(|(_, name)| name == kind.name()).map(|(topic, _)| topic).collect();
        Ok(if those.is_empty() {
            format!("there is no {}", kind.name())
        } else {
            format!("there is {}", those.join(", "))
        })
    }

    fn await_that(&mut self, most: Duration, there: impl Fn(&Self) -> bool) -> Result<(), RosError> {
        let until = self.now() + most;
        while !there(self) && self.now() < until {
            self.listen(STOP_AGAIN);
            if let Some(why) = &self.lost {
                return Err(self.lacks(why.clone()));
            }
        }
        Ok(())
    }

    fn preflight(&self) -> String {
        let body = &self.settings.body;
        let (linear, angular) = (body.speed_m_s, body.turn_rad_s);
        let heard: Vec<&str> = self.ears.keys().map(String::as_str).collect();
        let ears = if heard.is_empty() {
            "nothing that measures distances (no /scan, /sonar or Range): it stops only for what its camera has seen"
                .into()
        } else {
            format!("distances by {}", heard.join(", "))
        };
        let place = if self.map_from_odometry().is_some() { "place by /tf map → odom" } else { "place by odometry" };
        format!(
            "{}: driving on {}, odometry {} every {} ms, {ears}, {place}; at most {linear:.2} m/s and {angular:.2} rad/s, \
             stops {} ms after the last word",
            self.transport.name(),
            self.command,
            self.odometry,
            self.cycle.as_millis(),
            self.settings.deadline.as_millis(),
        )
    }

    fn note(&mut self, text: impl Into<String>) {
        let at = self.now();
        self.events.push(Event { at, text: text.into() });
    }

    /// Says it unless it was said a moment ago.
    fn remark(&mut self, about: &'static str, text: impl Into<String>) {
        let now = self.now();
        if self.remarks.get(about).is_none_or(|at| now.saturating_sub(*at) > REMARK_AGAIN) {
            self.remarks.insert(about, now);
            self.note(text);
        }
    }

    fn velocity(&self, linear: f64, angular: f64) -> Message {
        if !self.settings.stamped {
            return Message::Twist(linear, angular);
        }
        let stamp_s = self.clock.map_or(0.0, |ahead| self.now().as_secs_f64() - ahead);
        Message::TwistStamped(Header { stamp_s, frame: self.base_frame.clone() }, linear, angular)
    }

    /// Takes in what comes.
    fn listen(&mut self, wait: Duration) {
        for incoming in self.transport.take(wait) {
            match incoming {
                Incoming::Message(topic, message) => self.hear(&topic, message),
                Incoming::Trouble(what) => self.note(what),
                Incoming::Lost(why) => self.lost = Some(why),
            }
        }
        self.report.at = self.now();
    }

    fn hear(&mut self, topic: &str, message: Message) {
        match message {
            Message::Odometry(odometry) if topic == self.odometry => self.take_odometry(&odometry),
            Message::Transforms(all) => all.iter().for_each(|told| self.frames.take(told)),
            Message::Flag(flag) => self.take_flag(topic, flag),
            Message::Scan(scan) => {
                let place = self.place_of(&scan.header.frame);
                self.take_readings(topic, place.and_then(|place| of_scan(&scan, &place, &self.settings.body)));
            }
            Message::Range(header, values) => {
                let place = self.place_of(&header.frame);
                let reading = place.and_then(|place| of_range(values, &place, &self.settings.body));
                self.take_readings(topic, reading.map(|reading| vec![reading]));
            }
            Message::Cloud(header, points) => {
                let place = self.place_of(&header.frame);
                self.take_readings(topic, place.and_then(|place| of_cloud(&points, &place, &self.settings.body)));
            }
            _ => {}
        }
    }

    /// Where a sensor sits; at the base's middle when nobody has told for a while.
    fn place_of(&mut self, frame: &str) -> Option<nalgebra::Isometry3<f64>> {
        let found = self.frames.within(&self.base_frame, frame);
        if found.is_none() && self.now() > PLACED_WITHIN {
            let what =
                format!("no transform tells where `{frame}` is on `{}`; it is taken for its middle", self.base_frame);
            if !self.remarks.contains_key("place") {
                self.remark("place", what);
            }
            return Some(nalgebra::Isometry3::identity());
        }
        found
    }

    fn take_readings(&mut self, topic: &str, readings: Option<Vec<SonarReading>>) {
        let now = self.now();
        let Some(readings) = readings else {
            self.remark(
                "nonsense",
                format!("{topic}: nothing measured in this message, or no numbers; it is passed over"),
            );
            return;
        };
        if let Some(ears) = self.ears.get_mut(topic) {
            (ears.readings, ears.heard_at) = (readings, now);
        }
        self.report.sonar = self.ears.values().flat_map(|ears| ears.readings.iter().copied()).collect();
    }

    fn take_flag(&mut self, topic: &str, flag: bool) {
        match self.holds.get(topic).copied() {
            Some(BUMPER) => {
                let backward = self.told.0 < 0.0;
                self.report.front_bumpers = u8::from(flag && !backward);
                self.report.rear_bumpers = u8::from(flag && backward);
                self.report.status.bumped = flag;
            }
            Some(STOP_BUTTON) => {
                self.report.emergency_stop = flag;
                self.hold(flag, "the STOP button is pressed");
            }
            Some(_) => self.hold(!flag, "the motors are switched off"),
            None => {}
        }
    }

    fn hold(&mut self, held: bool, why: &str) {
        let was = self.report.held.is_some();
        self.report.held = held.then(|| why.to_string());
        if held != was {
            self.note(if held { why.to_string() } else { "nothing holds the robot any more".to_string() });
        }
        if held {
            self.ask = None;
        }
    }

    fn take_odometry(&mut self, odometry: &Odometry) {
        let now = self.now();
        self.watch_clock(odometry.header.stamp_s, now);
        let before = self.report.heard_at;
        if !self.track.take(odometry, now) {
            self.remark(
                "jump",
                format!("{}: its pose jumps or is no number; going on from where the robot was", self.odometry),
            );
        }
        let (linear, angular) = odometry.velocity;
        if linear.is_finite() && angular.is_finite() {
            self.report.velocity = odometry.velocity;
        }
        if self.report.sips > 0 {
            // A smooth mean, of waits that are none of a stop.
            let wait = now.saturating_sub(before).min(SILENCE);
            self.cycle = (self.cycle * 7 + wait) / 8;
        }
        (self.base_frame, self.odometry_frame) =
            (odometry.child.trim_start_matches('/').into(), odometry.header.frame.clone());
        self.report.sips += 1;
        self.report.heard_at = now;
        self.report.dead_time = self.cycle + BASE_ANSWERS;
        self.report.distance_m = self.track.distance_m();
        self.report.pose = self.pose();
        self.tell_origin();
        if std::mem::take(&mut self.silent) {
            self.note(format!("{} is heard again", self.odometry));
        }
    }

    /// Only told: every deadline here is by our own clock, which does not jump.
    fn watch_clock(&mut self, stamp_s: f64, now: Duration) {
        let ahead = now.as_secs_f64() - stamp_s;
        let jumped = self.clock.map(|before| before - ahead).filter(|jump| jump.abs() > CLOCK_JUMP_S);
        if let Some(jump) = jumped {
            self.remark("clock", format!("the robot's clock jumps by {jump:+.1} s; it is not driven by it"));
        }
        self.clock = Some(ahead);
    }

    fn map_from_odometry(&self) -> Option<Pose> {
        let place = self.frames.within("map", &self.odometry_frame)?;
        let forward = place.rotation * nalgebra::Vector3::x();
        Some(Pose::new(place.translation.x, place.translation.y, forward.y.atan2(forward.x)))
    }

    /// From the start: by the robot's own localization when it has one, by odometry else.
    fn pose(&self) -> Pose {
        let (Some(odometry), Some(own)) = (self.map_from_odometry(), self.track.own()) else {
            return self.track.pose();
        };
        let at = self.settings.start.to_local(odometry.to_world(own.position()));
        Pose::new(at.x, at.y, wrap_angle(odometry.heading + own.heading - self.settings.start.heading))
    }

    fn tell_origin(&self) {
        let Some(own) = self.track.own() else { return };
        let at = self.settings.start.to_world(self.report.pose.position());
        let turned = wrap_angle(self.settings.start.heading + self.report.pose.heading - own.heading);
        let back = Pose::new(0.0, 0.0, turned).to_world(own.position());
        let origin = Pose::new(at.x - back.x, at.y - back.y, turned);
        *self.settings.origin.lock().unwrap_or_else(PoisonError::into_inner) = origin;
    }

    /// What is silent for too long, and for how long.
    fn silence(&self) -> Option<(String, Duration)> {
        let now = self.now();
        let odometry = now.saturating_sub(self.report.heard_at);
        if odometry > SILENCE.max(self.cycle * SILENT_CYCLES) {
            return Some((self.odometry.clone(), odometry));
        }
        let ears = self.ears.iter().map(|(topic, ears)| (topic.clone(), now.saturating_sub(ears.heard_at)));
        ears.filter(|(_, silent)| *silent > BLIND).max_by_key(|(_, silent)| *silent)
    }

    /// Tells the robot what is safe to tell.
    fn steer(&mut self) -> Result<(), RobotError> {
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

    fn tell(&mut self, linear: f64, angular: f64, is_new: bool, now: Duration) {
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

//! One robot: synchronisation, commands, the watchdog, and time.

use std::cell::RefCell;
use std::f64::consts::TAU;
use std::rc::Rc;
use std::time::Duration;

use super::extras::Extras;
use super::motion::{Motion, STEP_S};
use crate::geometry::Pose;
use crate::robot::arcos::codec::{Command, Counters, Decoder, Io, Packet, number};
use crate::robot::arcos::parameters::Parameters;
use crate::robot::{MobileBase, RobotError, p3dx};
use crate::simulation::base::{SimulatedBase, Truth};

/// What a served robot is set to.
#[derive(Clone, Debug)]
pub struct ServerSettings {
    /// What it calls itself.
    pub name: String,
    /// Its scales, and the subclass it announces.
    pub parameters: Parameters,
    /// Without a command for this long it stops (firmware: 2 s).
    pub watchdog: Duration,
    /// Time between two SIPs.
    pub cycle: Duration,
}

impl Default for ServerSettings {
    fn default() -> Self {
        Self {
            name: "spatial-fetch".to_string(),
            parameters: Parameters::P3DX_SH,
            watchdog: Duration::from_secs(2),
            cycle: Duration::from_millis(100),
        }
    }
}

/// Where the conversation is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// Waiting for this number of the three.
    Sync(u8),
    /// All three heard; waiting for OPEN.
    Ready,
    /// Commands in, reports out.
    Open,
}

/// A command as it was heard, for the log.
#[derive(Clone, Debug, PartialEq)]
pub struct Heard {
    /// When.
    pub at: Duration,
    /// What.
    pub command: Command,
}

/// A simulated robot that speaks ARCOS.
pub struct Server {
    pub(super) base: SimulatedBase,
    pub(super) settings: ServerSettings,
    pub(super) motion: Motion,
    /// The pose, by the base's odometry, that the robot calls 0, 0, 0.
    origin: Pose,
    decoder: Decoder,
    state: State,
    output: Vec<u8>,
    pub(super) clock: Duration,
    next_sip: Duration,
    heard_at: Duration,
    heard: Vec<Heard>,
    pub(super) motors: bool,
    pub(super) stop_button: bool,
    pub(super) sonar: bool,
    extras: Extras,
    pub(super) sips: u64,
    pub(super) battery_v: f64,
    pub(super) travelled: (f64, f64),
    baud_asked: Option<u32>,
    stopped_by_watchdog: bool,
    /// It was going backward when it touched what it touches.
    pub(super) hit_backward: bool,
    log: Vec<String>,
}

impl Server {
    /// A robot of the given base, at rest, waiting for a client.
    pub fn new(base: SimulatedBase, settings: ServerSettings) -> Self {
        let origin = base.pose();
        Self {
            base,
            settings,
            motion: Motion::default(),
            origin,
            decoder: Decoder::default(),
            state: State::Sync(0),
            output: Vec::new(),
            clock: Duration::ZERO,
            next_sip: Duration::ZERO,
            heard_at: Duration::ZERO,
            heard: Vec::new(),
            motors: false,
            stop_button: false,
            sonar: true,
            extras: Extras::default(),
            sips: 0,
            battery_v: 12.8,
            travelled: (0.0, 0.0),
            baud_asked: None,
            stopped_by_watchdog: false,
            hit_backward: false,
            log: Vec::new(),
        }
    }

    /// What is true of the robot, for a judge.
    pub fn truth(&self) -> Rc<RefCell<Truth>> {
        self.base.truth()
    }

    /// Where it is by its own odometry, in the map's frame.
    pub fn odometry(&self) -> Pose {
        self.base.pose()
    }

    /// Time on its clock.
    pub fn now(&self) -> Duration {
        self.clock
    }

    /// Information packets sent.
    pub fn sip_count(&self) -> u64 {
        self.sips
    }

    /// Velocity as the base measures it, m/s and rad/s.
    pub fn velocity(&self) -> (f64, f64) {
        self.base.velocity()
    }

    /// Whether the robot is being asked to move and may.
    pub fn is_driven(&self) -> bool {
        self.motion.asks_for_motion() && !self.is_held()
    }

    /// What came over the line, good and bad.
    pub fn counters(&self) -> Counters {
        self.decoder.counters()
    }

    /// The commands heard since this was last asked.
    pub fn take_heard(&mut self) -> Vec<Heard> {
        std::mem::take(&mut self.heard)
    }

    /// What happened since this was last asked, for people.
    pub fn take_log(&mut self) -> Vec<String> {
        std::mem::take(&mut self.log)
    }

    /// Bytes for the client.
    pub fn take_output(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.output)
    }

    /// The rate a client has asked for since this was last asked.
    pub fn take_baud(&mut self) -> Option<u32> {
        self.baud_asked.take()
    }

    /// Someone presses the STOP button, or lets it go.
    pub fn press_stop_button(&mut self, pressed: bool) {
        self.stop_button = pressed;
        if pressed {
            self.motors = false;
            self.motion.give_up();
        }
    }

    /// Someone puts the robot's counters back to zero behind the client's back.
    pub fn reset_odometry(&mut self) {
        self.origin = self.base.pose();
    }

    /// Bytes from the client.
    pub fn receive(&mut self, bytes: &[u8]) {
        self.decoder.push(bytes, self.clock);
        while let Some(packet) = self.decoder.next(self.clock) {
            self.hear(&packet);
        }
    }

    /// Lets the robot live until `now`.
    pub fn advance_to(&mut self, now: Duration) {
        let step = Duration::from_secs_f64(STEP_S);
        while self.clock + step <= now {
            self.clock += step;
            self.receive(&[]);
            // The simulated base answers always.
            let _ = self.step();
            if self.state == State::Open && self.clock >= self.next_sip {
                self.next_sip = self.clock + self.settings.cycle;
                self.report();
            }
        }
    }

    pub(super) fn is_held(&self) -> bool {
        !self.motors || self.stop_button || self.clock.saturating_sub(self.heard_at) > self.settings.watchdog
    }

    /// Where it is in its own frame.
    pub(super) fn own_pose(&self) -> Pose {
        let pose = self.base.pose();
        let at = self.origin.to_local(pose.position());
        Pose::new(at.x, at.y, crate::geometry::wrap_angle(pose.heading - self.origin.heading))
    }

    fn step(&mut self) -> Result<(), RobotError> {
        let held = self.is_held();
        if held && self.motors && !self.stop_button && self.motion.asks_for_motion() && !self.stopped_by_watchdog {
            self.log.push(format!("no command for {} ms: stopped by the watchdog", self.settings.watchdog.as_millis()));
            self.stopped_by_watchdog = true;
        }
        let (linear, angular) = self.motion.step(held, self.own_pose().heading);
        let before = self.base.pose();
        let (was_bumped, speed) = (self.base.status().bumped, self.base.velocity().0);
        if self.motion.is_emergency() {
            self.base.brake(STEP_S);
            if self.base.velocity() == (0.0, 0.0) {
                self.motion.stands();
            }
        } else {
            self.base.drive(linear, angular, STEP_S)?;
        }
        if self.base.status().bumped && !was_bumped {
            self.hit_backward = if speed == 0.0 { self.motion.is_backward() } else { speed < 0.0 };
        }
        let ahead = before.to_local(self.base.pose().position()).x;
        self.motion.moved(ahead);
        self.travelled.0 += ahead;
        self.travelled.1 += crate::geometry::wrap_angle(self.base.pose().heading - before.heading);
        self.extras.turned(self.base.velocity().1);
        self.battery_v =
            (self.battery_v - STEP_S * if linear == 0.0 && angular == 0.0 { 2e-5 } else { 2e-4 }).max(10.0);
        Ok(())
    }

    fn send(&mut self, packet: &Packet) {
        self.output.extend(packet.to_bytes());
    }

    fn hear(&mut self, packet: &Packet) {
        self.heard_at = self.clock;
        self.stopped_by_watchdog = false;
        match self.state {
            State::Open => {
                let command = Command::from_packet(packet);
                self.obey(&command);
                self.heard.push(Heard { at: self.clock, command });
            }
            State::Ready if packet.kind == number::OPEN => self.open(),
            State::Sync(wanted) if packet.kind == wanted => self.synchronise(wanted),
            // Out of order: begin again.
            _ if packet.kind == 0 => self.synchronise(0),
            _ => self.state = State::Sync(0),
        }
    }

    fn synchronise(&mut self, number: u8) {
        if number < 2 {
            self.send(&Packet::new(number, Vec::new()));
            self.state = State::Sync(number + 1);
            return;
        }
        let subclass = self.settings.parameters.subclass;
        let data = format!("{}\0Pioneer\0{subclass}\0", self.settings.name).into_bytes();
        self.send(&Packet::new(2, data));
        self.state = State::Ready;
    }

    /// Motors are off after OPEN, whatever they were before, and settings are what they were made with.
    fn open(&mut self) {
        self.state = State::Open;
        (self.motors, self.sonar) = (false, true);
        self.motion = Motion::default();
        self.next_sip = self.clock;
        self.log.push("a client has opened the robot".to_string());
    }

    /// The line to the client is gone: nobody drives the robot any more.
    pub fn hang_up(&mut self, why: &str) {
        self.decoder.clear();
        if self.state == State::Open {
            self.end_session();
            self.log.push(format!("{why}: stopped"));
        }
        self.state = State::Sync(0);
        self.output.clear();
    }

    fn close(&mut self) {
        self.end_session();
        self.log.push("the client has closed the robot".to_string());
    }

    fn end_session(&mut self) {
        self.motion.stop();
        self.motors = false;
        self.extras = Extras::default();
        self.state = State::Sync(0);
    }

    fn obey(&mut self, command: &Command) {
        let value = command.value();
        match command.number {
            number::CLOSE => self.close(),
            number::ENABLE => self.motors = value.unwrap_or(0) != 0 && !self.stop_button,
            number::CONFIG => {
                let packet = self.config().to_packet();
                self.send(&packet);
            }
            number::SETO => self.reset_odometry(),
            number::SONAR => self.sonar = value.unwrap_or(0) & 1 != 0,
            number::HOSTBAUD => {
                let rates = [9600, 19200, 38400, 57600, 115_200];
                self.baud_asked = value.and_then(|index| rates.get(usize::try_from(index).ok()?).copied());
            }
            number::BATTEST => self.battery_v = value.filter(|dv| *dv > 0).map_or(12.8, |dv| f64::from(dv) / 10.0),
            number if self.extras.ask(number, value) => {}
            number => self.obey_motion(number, value),
        }
        if !self.motors && command.number == number::ENABLE {
            self.motion.give_up();
        }
    }

    fn obey_motion(&mut self, command: u8, value: Option<i32>) {
        // In an emergency stop motion commands are ignored until the robot stands.
        if self.motion.is_emergency() {
            return;
        }
        let metres = f64::from(value.unwrap_or(0)) / 1000.0;
        let radians = f64::from(value.unwrap_or(0)).to_radians();
        let heading = self.own_pose().heading;
        match command {
            number::VEL => self.motion.set_velocity(metres),
            number::RVEL | number::ROTATE => self.motion.set_turn(radians),
            number::VEL2 => {
                let [right, left] = (value.unwrap_or(0) as i16).to_le_bytes().map(|byte| f64::from(byte as i8));
                let p = self.settings.parameters;
                let unit = p.vel2_mm_s / 1000.0;
                self.motion.set_wheels(left * unit, right * unit, p.turn_rad_per_mm * 1000.0);
            }
            number::MOVE => self.motion.move_by(metres),
            number::HEAD => self.motion.turn_to(radians),
            number::DHEAD => self.motion.turn_to(heading + radians.clamp(-TAU, TAU)),
            number::DCHEAD => self.motion.turn_on(radians, heading),
            number::STOP => self.motion.stop(),
            number::E_STOP | number::QSTOP => self.motion.stop_in_emergency(),
            number::SETV => self.motion.limits.speed = metres.abs().min(p3dx::BODY.speed_m_s),
            number::SETRV => self.motion.limits.turn = radians.abs().min(p3dx::BODY.turn_rad_s),
            number::SETA if metres > 0.0 => self.motion.limits.acceleration = metres,
            number::SETA if metres < 0.0 => self.motion.limits.braking = -metres,
            number::SETRA if radians > 0.0 => self.motion.limits.turn_acceleration = radians,
            number::SETRA if radians < 0.0 => self.motion.limits.turn_braking = -radians,
            // PULSE, and what a simulated robot has no part for.
            _ => {}
        }
    }

    /// The gyro goes before the SIP, everything else after it.
    fn report(&mut self) {
        if let Some(gyro) = self.extras.gyro() {
            self.send(&gyro.to_packet());
        }
        let sip = self.sip().to_packet();
        self.send(&sip);
        if self.extras.encoders_are_due() {
            let packet = self.encoder().to_packet();
            self.send(&packet);
        }
        if self.extras.inputs_are_due() {
            self.send(&Io::default().to_packet());
        }
        self.sips += 1;
    }
}

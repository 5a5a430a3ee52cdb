//! A robot at the end of a long way: what the control loop makes of dead time and jitter; and robots that fall silent.

#[path = "common/late_line.rs"]
mod late_line;

use std::cell::RefCell;
use std::collections::VecDeque;
use std::io;
use std::rc::Rc;
use std::time::Duration;

use late_line::LateLine;
use spatial_fetch::behavior::{Executive, Options, Report, Watcher};
use spatial_fetch::geometry::Pose;
use spatial_fetch::map::RoomMap;
use spatial_fetch::perception::{Eyes, View};
use spatial_fetch::record::{Outcome, Plan};
use spatial_fetch::robot::arcos::client::{ArcosSettings, Client, ConnectError};
use spatial_fetch::robot::arcos::codec::{Decoder, Packet, SIP_MOVING, SIP_STOPPED, number};
use spatial_fetch::robot::arcos::line::Line;
use spatial_fetch::robot::{MobileBase, RobotError};
use spatial_fetch::simulation::arcos::{MemoryLine, Server, ServerSettings};
use spatial_fetch::simulation::base::{Obstacles, SimulatedBase};
use spatial_fetch::simulation::{Noise, Scene};

type Robot = Rc<RefCell<Server>>;

/// In the empty apartment, before the living room's door.
fn robot_that_answers_after(dead_time_s: f64) -> Robot {
    let map = RoomMap::apartment();
    let scene = Scene { furniture: Vec::new(), objects: Vec::new(), ..Scene::apartment() };
    let noise = Noise { dead_time_s, ..Noise::off() };
    let base = SimulatedBase::with_noise(Obstacles::new(&map, &scene), start(), noise, 0, 0);
    Rc::new(RefCell::new(Server::new(base, ServerSettings::default())))
}

fn start() -> Pose {
    Pose::new(2.63, 0.0, 0.0)
}

/// No camera.
struct Shut;

impl Eyes for Shut {
    fn look(&mut self, _believed: Pose) -> View {
        View::default()
    }

    fn can_see(&self) -> bool {
        false
    }
}

/// Counts how often the robot truly turns the other way round.
struct Reversals {
    robot: Robot,
    sense: f64,
    count: usize,
}

impl Watcher for Reversals {
    fn sensed(&mut self, _base: &dyn MobileBase) {
        let turning = self.robot.borrow().velocity().1;
        if turning.abs() > 0.05 {
            self.count += usize::from(turning * self.sense < 0.0);
            self.sense = turning;
        }
    }
}

/// A client in the frame of the map.
struct InMap<L: Line>(Client<L>);

impl<L: Line> MobileBase for InMap<L> {
    fn body(&self) -> spatial_fetch::robot::Body {
        self.0.body()
    }

    fn pose(&self) -> Pose {
        let (own, from) = (self.0.pose(), start());
        let at = from.to_world(own.position());
        Pose::new(at.x, at.y, own.heading + from.heading)
    }

    fn velocity(&self) -> (f64, f64) {
        self.0.velocity()
    }

    fn time_s(&self) -> f64 {
        self.0.time_s()
    }

    fn age_s(&self) -> f64 {
        self.0.age_s()
    }

    fn dead_time_s(&self) -> f64 {
        self.0.dead_time_s()
    }

    fn drive(&mut self, linear: f64, angular: f64, seconds: f64) -> Result<(), RobotError> {
        self.0.drive(linear, angular, seconds)
    }

    fn sonar(&self) -> &[spatial_fetch::robot::SonarReading] {
        self.0.sonar()
    }

    fn status(&self) -> spatial_fetch::robot::Status {
        self.0.status()
    }
}

/// Into the living room, three metres on, and a turn; over a line so late.
fn trial(delay_ms: u64, jitter_ms: u64, seed: u64) -> (Report, f64, usize, u32) {
    let plan = r#"{"map":"apartment","room":"living_room","actions":[{"do":"enter","room":"living_room"},
        {"do":"move","direction":"front","amount":{"meters":3.0}},{"do":"move","direction":"left"}],"problems":[]}"#;
    let plan: Plan = serde_json::from_str(plan).expect("a plan");
    let robot = robot_that_answers_after(0.06);
    let line = LateLine::new(MemoryLine::new(Rc::clone(&robot)), seed, delay_ms, jitter_ms);
    let mut base = InMap(Client::connect(line, ArcosSettings::default()).expect("connects"));
    let map = RoomMap::apartment();
    let mut watcher = Reversals { robot: Rc::clone(&robot), sense: 0.0, count: 0 };
    let began_s = base.time_s();
    let options = Options { no_localization: true, ..Options::default() };
    let report = Executive::new(&map, &mut base, &mut Shut, &mut watcher, options).run(&plan);
    let truth = robot.borrow().truth();
    let collisions = truth.borrow().collisions;
    (report, base.time_s() - began_s, watcher.count, collisions)
}

#[test]
fn a_trial_ends_at_the_same_place_however_late_the_line_and_hardly_later_up_to_two_hundred_milliseconds() {
    let (at_once, seconds, reversals, _) = trial(0, 0, 0);
    assert_eq!(at_once.outcome, Outcome::Arrived, "{}", at_once.why);
    println!("at once: {seconds:.1} s, {reversals} reversals");
    for (delay_ms, jitter_ms) in [(50, 0), (50, 50), (100, 0), (100, 50), (200, 0), (200, 50), (400, 0), (400, 50)] {
        for seed in 0..5 {
            let (report, took, turned, collisions) = trial(delay_ms, jitter_ms, seed);
            let how = format!("{delay_ms} ms + {jitter_ms} ms, seed {seed}: {took:.1} s, {turned} reversals");
            println!("{how}");
            assert_eq!((report.outcome, collisions), (Outcome::Arrived, 0), "{how}: {}", report.why);
            assert!(report.pose.distance_to(at_once.pose.position()) < 0.25, "{how}: {:?}", report.pose);
            assert!(delay_ms > 200 || took < 1.5 * seconds, "{how}");
            assert!(turned <= reversals + 3, "{how}");
        }
    }
}

/// What becomes of the reports of a robot.
type Edit = Box<dyn FnMut(&mut Packet) -> bool>;

/// A line on which reports are altered, or lost when `edit` says no.
struct Edited {
    inner: MemoryLine,
    decoder: Decoder,
    waiting: VecDeque<u8>,
    edit: Edit,
}

impl Line for Edited {
    fn read(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<usize> {
        let mut fresh = [0; 512];
        let count = self.inner.read(&mut fresh, wait)?;
        self.decoder.push(&fresh[..count], self.inner.now());
        while let Some(mut packet) = self.decoder.next(self.inner.now()) {
            if !matches!(packet.kind, SIP_STOPPED | SIP_MOVING) || (self.edit)(&mut packet) {
                self.waiting.extend(packet.to_bytes());
            }
        }
        let count = self.waiting.len().min(buffer.len());
        buffer.iter_mut().zip(self.waiting.drain(..count)).for_each(|(to, from)| *to = from);
        Ok(count)
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.inner.write(bytes)
    }

    fn reopen(&mut self) -> io::Result<()> {
        self.inner.reopen()
    }

    fn now(&self) -> Duration {
        self.inner.now()
    }

    fn sleep(&mut self, time: Duration) {
        self.inner.sleep(time);
    }

    fn name(&self) -> String {
        self.inner.name()
    }
}

fn edited(robot: &Robot, edit: Edit) -> Client<Edited> {
    let inner = MemoryLine::new(Rc::clone(robot));
    let line = Edited { inner, decoder: Decoder::default(), waiting: VecDeque::new(), edit };
    Client::connect(line, ArcosSettings::default()).expect("connects")
}

fn said(client: &mut Client<Edited>) -> String {
    client.take_events().into_iter().map(|event| event.text + "\n").collect()
}

/// From this report on.
fn after(reports: usize) -> impl FnMut() -> bool {
    let mut count = 0;
    move || {
        count += 1;
        count > reports
    }
}

#[test]
fn sonars_that_fall_silent_are_said_within_a_second_and_stop_the_robot() {
    let robot = robot_that_answers_after(0.0);
    let mut silent = after(40);
    let mut client = edited(
        &robot,
        Box::new(move |packet| {
            if silent() {
                // The count of readings, and the readings.
                let count = usize::from(packet.data[18]);
                packet.data[18] = 0;
                packet.data.drain(19..19 + 3 * count);
            }
            true
        }),
    );
    let ended = (0..100).find_map(|_| client.drive(0.3, 0.0, 0.1).err());
    assert!(matches!(&ended, Some(RobotError::Held(why)) if why.contains("sonars have fallen silent")), "{ended:?}");
    (0..50).for_each(|_| client.turn(Duration::from_millis(20)).expect("linked"));
    assert_eq!(robot.borrow().velocity().0, 0.0);
    assert!(client.report().distance_m < 1.7, "{} m", client.report().distance_m);
}

#[test]
fn a_robot_whose_reports_stop_is_not_driven_blind() {
    let robot = robot_that_answers_after(0.0);
    let mut silent = after(30);
    let mut client = edited(&robot, Box::new(move |_| !silent()));
    let mut blind_s = 0.0;
    for _ in 0..60 {
        if client.drive(0.3, 0.0, 0.02).is_ok() && client.age_s() > 0.1 && robot.borrow().is_driven() {
            blind_s += 0.02;
        }
    }
    for _ in 0..200 {
        if client.drive(0.3, 0.0, 0.02).is_ok() && client.age_s() > 0.1 && robot.borrow().is_driven() {
            blind_s += 0.02;
        }
    }
    assert!((0.1..=0.5).contains(&blind_s), "driven for {blind_s:.2} s without a report");
    assert!(said(&mut client).contains("stopping until the robot reports again"));
}

/// A robot that takes what comes before its SYNC0 for the end of the handshake, as AMRISim does: it answers 32 to a
/// number out of its turn and no more after it; and that answers a byte at a time.
#[derive(Default)]
struct Particular {
    now: Duration,
    decoder: Decoder,
    next: u8,
    is_lost: bool,
    waiting: VecDeque<u8>,
    heard: Rc<RefCell<Vec<u8>>>,
    sips_at: Option<Duration>,
    a_byte: Duration,
}

impl Particular {
    fn answer(&mut self, packet: &Packet) {
        self.heard.borrow_mut().push(packet.kind);
        let reply = match packet.kind {
            _ if self.is_lost => return,
            kind if self.next < 3 && kind != self.next => {
                self.is_lost = true;
                Packet::new(32, Vec::new())
            }
            2 if self.next == 2 => Packet::new(2, b"\x1b[31mA robot with a long name\0Pioneer\0p3dx-sh\0".to_vec()),
            kind if self.next < 3 => Packet::new(kind, Vec::new()),
            number::OPEN => return self.sips_at = Some(self.now),
            _ => return,
        };
        self.next += 1;
        self.waiting.extend(reply.to_bytes());
    }
}

impl Line for Particular {
    fn read(&mut self, buffer: &mut [u8], wait: Duration) -> io::Result<usize> {
        if self.a_byte.is_zero() || self.waiting.is_empty() {
            self.now += wait.min(Duration::from_millis(10));
        } else {
            self.now += self.a_byte;
        }
        if self.sips_at.is_some_and(|at| at <= self.now) && self.waiting.is_empty() {
            self.sips_at = Some(self.now + Duration::from_millis(100));
            let mut data = vec![0; 19];
            data[15] = 1;
            self.waiting.extend(Packet::new(SIP_STOPPED, data).to_bytes());
        }
        let most = if self.a_byte.is_zero() { buffer.len() } else { 1 };
        let count = self.waiting.len().min(most);
        buffer.iter_mut().zip(self.waiting.drain(..count)).for_each(|(to, from)| *to = from);
        Ok(count)
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.decoder.push(bytes, self.now);
        while let Some(packet) = self.decoder.next(self.now) {
            self.answer(&packet);
        }
        Ok(())
    }

    fn reopen(&mut self) -> io::Result<()> {
        Ok(())
    }

    fn now(&self) -> Duration {
        self.now
    }

    fn sleep(&mut self, time: Duration) {
        self.now += time;
    }

    fn name(&self) -> String {
        "particular".to_string()
    }
}

#[test]
fn the_first_word_to_a_robot_is_its_first_number() {
    let robot = Particular::default();
    let heard = Rc::clone(&robot.heard);
    let client = Client::connect(robot, ArcosSettings::default()).expect("connects");
    assert_eq!(heard.borrow()[..4], [0, 1, 2, number::OPEN]);
    let line = client.preflight();
    assert!(line.contains("A robot with a long name") && !line.contains('\x1b'), "{line:?}");
}

#[test]
fn replies_that_come_a_byte_every_five_milliseconds_are_waited_for() {
    let robot = Particular { a_byte: Duration::from_millis(5), ..Particular::default() };
    Client::connect(robot, ArcosSettings::default()).expect("connects");
}

#[test]
fn a_robot_that_answers_and_does_not_synchronise_is_not_called_silent() {
    let robot = Particular { next: 1, ..Particular::default() };
    let error = Client::connect(robot, ArcosSettings::default()).err().expect("refused");
    assert!(matches!(error, ConnectError::Handshake(..)), "{error}");
    assert!(error.to_string().contains("a robot answers (packet type 32)"), "{error}");
}

#[test]
fn sonars_switched_off_by_one_client_hear_for_the_next() {
    let robot = robot_that_answers_after(0.0);
    let mut first = Client::connect(MemoryLine::new(Rc::clone(&robot)), ArcosSettings::default()).expect("connects");
    let sonars_off = spatial_fetch::robot::arcos::codec::Command::int(number::SONAR, 0);
    first.line().write(&sonars_off.to_packet().to_bytes()).expect("memory");
    drop(first);
    let mut line = MemoryLine::new(Rc::clone(&robot));
    // Its clock begins anew, the robot's does not.
    line.sleep(Duration::from_secs(10));
    for sync in [0, 1, 2, number::OPEN] {
        line.write(&Packet::new(sync, Vec::new()).to_bytes()).expect("memory");
    }
    line.sleep(Duration::from_millis(300));
    let (mut buffer, mut decoder) = ([0; 512], Decoder::default());
    while let Ok(count @ 1..) = line.read(&mut buffer, Duration::ZERO) {
        decoder.push(&buffer[..count], line.now());
    }
    let sips = std::iter::from_fn(|| decoder.next(line.now())).filter(|packet| packet.kind == SIP_STOPPED);
    assert!(sips.filter(|sip| sip.data[18] > 0).count() >= 2, "readings in every report");
}

#[test]
fn after_a_frontal_hit_the_front_bumper_is_pressed_and_backing_off_in_a_turn_comes_free() {
    use spatial_fetch::robot::arcos::codec::Command;
    let base = SimulatedBase::new(Obstacles::new(&RoomMap::apartment(), &Scene::apartment()), Pose::new(6.3, 0.0, 0.0));
    let mut server = Server::new(base, ServerSettings::default());
    let mut now = Duration::ZERO;
    let mut tell = |server: &mut Server, packets: &[Packet], seconds: f64| {
        packets.iter().for_each(|packet| server.receive(&packet.to_bytes()));
        for _ in 0..(seconds * 2.0) as usize {
            now += Duration::from_millis(500);
            server.receive(&Packet::new(number::PULSE, Vec::new()).to_bytes());
            server.advance_to(now);
        }
        let (mut decoder, output) = (Decoder::default(), server.take_output());
        decoder.push(&output, now);
        std::iter::from_fn(|| decoder.next(now)).last().expect("a report")
    };
    let int = |number, value| Command::int(number, value).to_packet();
    let opening = [0, 1, 2, number::OPEN].map(|number| Packet::new(number, Vec::new()));
    tell(&mut server, &opening, 0.5);
    let hit = tell(&mut server, &[int(number::ENABLE, 1), int(number::VEL, 300)], 8.0);
    assert!(hit.data[12] & !1 != 0 && hit.data[11] & !1 == 0, "the front bumpers: {:?}", &hit.data[11..13]);
    let backing = tell(&mut server, &[int(number::VEL, -150), int(number::HEAD, -45)], 1.0);
    assert_eq!(backing.data[11] & !1, 0, "not the rear ones");
    tell(&mut server, &[], 3.0);
    let truth = server.truth();
    assert!(truth.borrow().pose.x < 6.8 && truth.borrow().pose.heading < -0.5, "{:?}", truth.borrow().pose);
}

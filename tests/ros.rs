//! A base that runs ROS, behind a transport in memory: every ending is zero, and nothing is driven blind.

use std::ffi::OsStr;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use spatial_fetch::geometry::Pose;
use spatial_fetch::robot::ros::{
    Header, Incoming, Kind, Message, Names, Odometry, RosBase, RosError, RosSettings, Scan, Transport,
};
use spatial_fetch::robot::{MobileBase, RealBase, RobotError, ThreadedBase, p3dx};

/// What a robot hears and does.
#[derive(Default)]
struct World {
    heard: Vec<(Instant, f64, f64)>,
    pose: Pose,
    at: Option<Instant>,
    mute: bool,
    blind: bool,
    jump: f64,
    listeners: usize,
    lost: bool,
}

impl World {
    fn told(&self) -> (f64, f64) {
        self.heard.last().map_or((0.0, 0.0), |(_, linear, angular)| (*linear, *angular))
    }

    fn live(&mut self) {
        let now = Instant::now();
        let passed = self.at.replace(now).map_or(0.0, |at| (now - at).as_secs_f64());
        let (linear, angular) = self.told();
        let ahead = self.pose.forward() * (linear * passed);
        (self.pose.x, self.pose.y) = (self.pose.x + ahead.x, self.pose.y + ahead.y);
        self.pose.heading += angular * passed;
    }
}

struct Wire(Arc<Mutex<World>>);

impl Transport for Wire {
    fn name(&self) -> String {
        "memory".into()
    }

    fn topics(&self) -> Result<Vec<(String, String)>, RosError> {
        Ok(vec![("/scan".into(), "sensor_msgs/LaserScan".into())])
    }

    fn advertise(&mut self, _: &str, _: Kind, _: bool) -> Result<(), RosError> {
        Ok(())
    }

    fn subscribe(&mut self, _: &str, _: Kind) -> Result<(), RosError> {
        Ok(())
    }

    fn publish(&mut self, topic: &str, message: &Message) {
        assert_eq!(topic, "/cmd_vel");
        let Message::Twist(linear, angular) = message else { panic!("{message:?}") };
        let mut world = self.0.lock().expect("whole");
        world.live();
        world.heard.push((Instant::now(), *linear, *angular));
    }

    fn listeners(&self, _: &str) -> usize {
        self.0.lock().expect("whole").listeners
    }

    fn take(&mut self, wait: Duration) -> Vec<Incoming> {
        std::thread::sleep(wait.min(Duration::from_millis(10)));
        let mut world = self.0.lock().expect("whole");
        world.live();
        let mut said = Vec::new();
        if world.lost {
            said.push(Incoming::Lost("gone".into()));
        }
        if world.mute {
            return said;
        }
        let header = Header { stamp_s: 1.0, frame: "odom".into() };
        let pose = Pose::new(world.pose.x + world.jump, world.pose.y, world.pose.heading);
        let velocity = world.told();
        let odometry = Odometry { header, child: "base_link".into(), pose, velocity };
        said.push(Incoming::Message("/odom".into(), Message::Odometry(odometry)));
        let range = if world.blind { f32::NAN } else { 4.0 };
        let header = Header { stamp_s: 1.0, frame: "base_link".into() };
        let scan =
            Scan { header, step_rad: 0.0175, least_m: 0.1, most_m: 8.0, ranges_m: vec![range; 360], ..Scan::default() };
        said.push(Incoming::Message("/scan".into(), Message::Scan(scan)));
        said
    }

    fn guard(&mut self, _: &OsStr, _: &str, _: &Message) {}

    fn leave(&mut self) {}
}

fn settings() -> RosSettings {
    RosSettings {
        body: p3dx::BODY,
        names: Names::default(),
        stamped: false,
        deadline: Duration::from_millis(300),
        resume: false,
        program: None,
        start: Pose::new(2.0, 3.0, 0.0),
        origin: Arc::default(),
    }
}

fn robot() -> (ThreadedBase, Arc<Mutex<World>>) {
    let world = Arc::new(Mutex::new(World { listeners: 1, ..World::default() }));
    let base = RosBase::connect(Box::new(Wire(Arc::clone(&world))), settings()).expect("connects");
    (base, world)
}

/// Drives ahead for so many periods of 50 ms.
fn ahead(base: &mut ThreadedBase, periods: usize) -> Result<(), RobotError> {
    (0..periods).try_for_each(|_| base.drive(0.3, 0.0, 0.05))
}

fn await_that(what: &str, world: &Mutex<World>, done: impl Fn(&World) -> bool) {
    let until = Instant::now() + Duration::from_secs(10);
    while !done(&world.lock().expect("whole")) {
        assert!(Instant::now() < until, "no {what}");
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[test]
fn a_velocity_not_asked_for_again_ends_as_zero_and_then_nothing_is_said() {
    let (mut base, world) = robot();
    ahead(&mut base, 10).expect("drives");
    assert!(world.lock().expect("whole").told().0 > 0.29);
    await_that("zero", &world, |world| world.told() == (0.0, 0.0));
    await_that("silence", &world, |world| {
        world.heard.last().is_some_and(|(at, ..)| at.elapsed() > Duration::from_secs(1))
    });
    assert!((base.pose().y - 3.0).abs() < 1e-6 && base.pose().x > 2.1, "{:?}", base.pose());
}

#[test]
fn dropping_and_stopping_end_in_zero_said_again_and_again() {
    for by_hand in [false, true] {
        let (mut base, world) = robot();
        ahead(&mut base, 10).expect("drives");
        if by_hand {
            base.remote().stop();
        }
        drop(base);
        let world = world.lock().expect("whole");
        let zeros =
            world.heard.iter().rev().take_while(|(_, linear, angular)| (*linear, *angular) == (0.0, 0.0)).count();
        assert!(zeros >= 5, "{zeros}");
    }
}

#[test]
fn odometry_that_falls_silent_or_a_scan_of_no_numbers_stops_the_robot_and_speech_lets_it_go_on() {
    type Fault = fn(&mut World, bool);
    let faults: [Fault; 2] = [|world, is| world.mute = is, |world, is| world.blind = is];
    for fault in faults {
        let (mut base, world) = robot();
        ahead(&mut base, 10).expect("drives");
        fault(&mut world.lock().expect("whole"), true);
        ahead(&mut base, 40).expect("still linked");
        assert_eq!(world.lock().expect("whole").told(), (0.0, 0.0));
        assert!(base.remote().take_events().iter().any(|event| event.text.contains("silent")));
        fault(&mut world.lock().expect("whole"), false);
        ahead(&mut base, 10).expect("drives");
        assert!(world.lock().expect("whole").told().0 > 0.29);
    }
}

#[test]
fn odometry_that_jumps_does_not_move_the_robot_in_the_map() {
    let (mut base, world) = robot();
    ahead(&mut base, 5).expect("drives");
    world.lock().expect("whole").jump = 40.0;
    ahead(&mut base, 5).expect("drives");
    assert!(base.pose().x < 3.0, "{:?}", base.pose());
    assert!(base.remote().take_events().iter().any(|event| event.text.contains("jumps")));
}

#[test]
fn ros_that_is_gone_ends_the_drive_with_the_reason_after_zero() {
    let (mut base, world) = robot();
    ahead(&mut base, 5).expect("drives");
    world.lock().expect("whole").lost = true;
    let error = ahead(&mut base, 60).expect_err("lost");
    assert!(matches!(&error, RobotError::Link(why) if why == "gone"), "{error}");
    assert_eq!(world.lock().expect("whole").told(), (0.0, 0.0));
}

#[test]
fn a_robot_that_nobody_would_drive_is_none() {
    let world = Arc::new(Mutex::new(World::default()));
    let connected = RosBase::connect(Box::new(Wire(world)), settings());
    let error = connected.err().expect("refused").to_string();
    assert!(error.contains("/cmd_vel") && error.contains("--remap"), "{error}");
}

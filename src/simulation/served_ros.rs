//! The simulated robot as a ROS robot: odometry, transforms, scan, sonars and camera out, `/cmd_vel` in.

use std::io;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, sync_channel};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use nalgebra::{Matrix3, Rotation3, UnitQuaternion};

use super::base::{Obstacles, SimulatedBase};
use super::served::{TruthLog, Whereabouts, note, roll};
use super::{Home, TrialSettings};
use crate::geometry::{Pose, vec2, wrap_angle};
use crate::recording::TimedFrame;
use crate::robot::ros::{Header, Incoming, Kind, Message, Names, Odometry, Picture, Scan, Transform, Transport};
use crate::robot::{MobileBase, SonarReading};

/// The base lives in steps of this.
const STEP: Duration = Duration::from_millis(20);
/// Steps between two odometry messages, and between two scans.
const ODOMETRY_EVERY: u64 = 2;
const SCAN_EVERY: u64 = 5;
/// The scanner: on the base's middle line, metres ahead and high; its beams, and how far they reach.
const SCANNER_M: [f64; 3] = [0.1, 0.0, 0.3];
const BEAMS: usize = 360;
const REACH_M: f64 = 10.0;
const LEAST_M: f64 = 0.05;

/// What is served, and what comes out beside it.
#[derive(Clone, Debug)]
pub struct ServedRos {
    /// Names of its topics.
    pub names: Names,
    /// Without a command for this long it stops.
    pub watchdog: Duration,
    /// Velocities bear their time.
    pub stamped: bool,
    /// Where it truly is, JSON lines.
    pub truth: Option<PathBuf>,
    /// How imperfect it and its camera are.
    pub how: TrialSettings,
}

/// The robot, its topics and its clock.
struct Robot<'a> {
    served: &'a ServedRos,
    base: SimulatedBase,
    obstacles: Obstacles,
    start: Pose,
    transport: Box<dyn Transport>,
    told: (f64, f64),
    told_at: Option<Instant>,
    driven: bool,
    steps: u64,
}

impl ServedRos {
    /// Serves the robot in `home` over `transport` until `goes_on` says no; `tell` hears what happens.
    ///
    /// # Errors
    /// When ROS refuses a topic, or is gone.
    pub fn run(
        &self,
        home: &Home,
        transport: Box<dyn Transport>,
        mut goes_on: impl FnMut() -> bool,
        tell: impl Fn(&str),
    ) -> io::Result<()> {
        let noise = self.how.noise_in(home.scene.noise.unwrap_or_default());
        let obstacles = Obstacles::new(&home.map, &home.scene);
        let start = home.map.start;
        let base = SimulatedBase::with_noise(obstacles.clone(), start, noise, self.how.seed, 0);
        let (told, told_at, driven, steps) = ((0.0, 0.0), None, false, 0);
        let mut robot = Robot { served: self, base, obstacles, start, transport, told, told_at, driven, steps };
        robot.announce(home).map_err(io::Error::other)?;
        let whereabouts = Arc::new(Mutex::new(Whereabouts::default()));
        let frames = self.film(home, &whereabouts)?;
        let mut truth = self.truth.as_deref().map(TruthLog::create).transpose()?;
        tell(&format!("serving at {}; ctrl-C ends it", robot.transport.name()));
        let began = Instant::now();
        while goes_on() {
            robot.hear(STEP / 4, &tell)?;
            while STEP * (robot.steps as u32 + 1) <= began.elapsed() {
                robot.step(&tell);
                note(&whereabouts, robot.base.truth().borrow().pose, robot.base.pose());
                if let Some(log) = &mut truth {
                    let (now, truth) = (began.elapsed(), robot.base.truth());
                    log.write(now, &truth.borrow(), robot.base.velocity(), robot.driven, robot.steps)?;
                }
            }
            frames.try_iter().for_each(|frame| robot.show(frame));
        }
        Ok(())
    }

    /// Films on a thread of its own.
    fn film(&self, home: &Home, whereabouts: &Arc<Mutex<Whereabouts>>) -> io::Result<Receiver<TimedFrame>> {
        let (sender, frames) = sync_channel(1);
        let (home, whereabouts, how) = (home.clone(), Arc::clone(whereabouts), self.how);
        std::thread::Builder::new().name("camera".to_string()).spawn(move || {
            // The film ends with the robot.
            let _ = roll(&home, &whereabouts, how, |frame| sender.send(frame).map_err(|error| error.to_string()));
        })?;
        Ok(frames)
    }
}

/// Seconds since 1970.
fn now_s() -> f64 {
    SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default().as_secs_f64()
}

fn header(frame: &str) -> Header {
    Header { stamp_s: now_s(), frame: frame.to_string() }
}

/// The camera's frame: x right, y down, z ahead.
const OPTICAL: &str = "camera_rgb_optical_frame";
const PICTURES: [(&str, Kind); 4] = [
    ("/camera/rgb/image_raw", Kind::Picture),
    ("/camera/rgb/camera_info", Kind::Camera),
    ("/camera/depth_registered/image_raw", Kind::Picture),
    ("/camera/depth_registered/camera_info", Kind::Camera),
];

impl Robot<'_> {
    fn announce(&mut self, home: &Home) -> Result<(), String> {
        let told = |error: crate::robot::ros::RosError| error.to_string();
        let topics = [
            ("/odom", Kind::Odometry),
            ("/tf", Kind::Transforms),
            ("/scan", Kind::Scan),
            ("/sonar", Kind::Cloud),
            ("/bumper", Kind::Flag),
            ("/clock", Kind::Clock),
        ];
        for (topic, kind) in topics.into_iter().chain(PICTURES) {
            self.transport.advertise(&self.served.names.of(topic), kind, false).map_err(told)?;
        }
        self.transport.advertise("/tf_static", Kind::Transforms, true).map_err(told)?;
        let [x, y, z] = SCANNER_M;
        let camera = home.camera().world_from_camera(Pose::default());
        let rotation = Matrix3::from_fn(|row, column| camera[row][column]);
        let turned = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix(&rotation));
        let place = |child: &str, translation, rotation| Transform {
            header: header("base_link"),
            child: child.into(),
            translation,
            rotation,
        };
        let eye = [camera[0][3], camera[1][3], camera[2][3]];
        let fixed = vec![
            place("laser", [x, y, z], [0.0, 0.0, 0.0, 1.0]),
            place(OPTICAL, eye, [turned.i, turned.j, turned.k, turned.w]),
        ];
        self.transport.publish("/tf_static", &Message::Transforms(fixed));
        let kind = if self.served.stamped { Kind::TwistStamped } else { Kind::Twist };
        self.transport.subscribe(&self.served.names.of("/cmd_vel"), kind).map_err(told)
    }

    fn hear(&mut self, wait: Duration, tell: &impl Fn(&str)) -> io::Result<()> {
        for incoming in self.transport.take(wait) {
            match incoming {
                Incoming::Message(_, Message::Twist(linear, angular) | Message::TwistStamped(_, linear, angular)) => {
                    if !linear.is_finite() || !angular.is_finite() {
                        tell("a command that is no number is passed over");
                        continue;
                    }
                    (self.told, self.told_at) = ((linear, angular), Some(Instant::now()));
                }
                Incoming::Message(..) => {}
                Incoming::Trouble(what) => tell(&what),
                Incoming::Lost(why) => return Err(io::Error::other(why)),
            }
        }
        Ok(())
    }

    /// One step of the base, and what is due to be said after it.
    fn step(&mut self, tell: &impl Fn(&str)) {
        let silent = self.told_at.is_none_or(|at| at.elapsed() > self.served.watchdog);
        if silent && self.told != (0.0, 0.0) {
            tell(&format!("watchdog: no command for {} ms; stopping", self.served.watchdog.as_millis()));
            self.told = (0.0, 0.0);
        }
        self.driven = self.told != (0.0, 0.0);
        // The simulated base does what it is told, and fails at nothing.
        let _ = self.base.drive(self.told.0, self.told.1, STEP.as_secs_f64());
        self.steps += 1;
        self.transport.publish("/clock", &Message::Clock(now_s()));
        if self.steps.is_multiple_of(ODOMETRY_EVERY) {
            self.say_where();
        }
        if self.steps.is_multiple_of(SCAN_EVERY) {
            self.say_what_is_near();
        }
    }

    fn say(&mut self, topic: &str, message: &Message) {
        let topic = self.served.names.of(topic);
        self.transport.publish(&topic, message);
    }

    /// Odometry begins at 0, 0, 0.
    fn say_where(&mut self) {
        let pose = self.base.pose();
        let at = self.start.to_local(pose.position());
        let pose = Pose::new(at.x, at.y, wrap_angle(pose.heading - self.start.heading));
        let header = header("odom");
        let place = Transform::flat(header.clone(), "base_link", pose);
        let velocity = self.base.velocity();
        self.say("/odom", &Message::Odometry(Odometry { header, child: "base_link".into(), pose, velocity }));
        self.say("/tf", &Message::Transforms(vec![place]));
    }

    fn say_what_is_near(&mut self) {
        let [x, y, _] = SCANNER_M;
        let pose = self.base.truth().borrow().pose;
        let origin = pose.to_world(vec2(x, y));
        let step_rad = std::f64::consts::TAU / BEAMS as f64;
        let beam = |i: usize| {
            let bearing = pose.heading - std::f64::consts::PI + step_rad * i as f64;
            let axis = vec2(bearing.cos(), bearing.sin());
            self.obstacles.beam(origin, axis, REACH_M).map_or(f32::INFINITY, |range| range as f32)
        };
        let ranges_m = (0..BEAMS).map(beam).collect();
        let first_rad = -std::f64::consts::PI;
        let scan = Scan { header: header("laser"), first_rad, step_rad, least_m: LEAST_M, most_m: REACH_M, ranges_m };
        self.say("/scan", &Message::Scan(scan));
        let echoes = self.base.sonar().iter().map(SonarReading::echo).map(|echo| [echo.x as f32, echo.y as f32, 0.2]);
        let cloud = Message::Cloud(header("base_link"), echoes.collect());
        self.say("/sonar", &cloud);
        let touched = self.base.status().bumped || self.base.status().stalled;
        self.say("/bumper", &Message::Flag(touched));
    }

    fn show(&mut self, timed: TimedFrame) {
        let frame = timed.frame;
        let header = header(OPTICAL);
        let size = [frame.width as u32, frame.height as u32];
        let lens = frame.intrinsics;
        let camera = Message::Camera(header.clone(), size, [lens.fx, lens.fy, lens.cx, lens.cy]);
        let picture = |encoding: &str, data| {
            let (header, encoding) = (header.clone(), encoding.to_string());
            Message::Picture(Picture { header, width: size[0], height: size[1], encoding, data })
        };
        let colour = picture("rgb8", frame.color.iter().flatten().copied().collect());
        let unit = frame.depth_unit_m * 1000.0;
        let mm = frame.depth.iter().map(|depth| (f64::from(*depth) * unit).round() as u16);
        let depth = picture("16UC1", mm.flat_map(u16::to_le_bytes).collect());
        for ((topic, _), message) in PICTURES.into_iter().zip([&colour, &camera, &depth, &camera]) {
            self.say(topic, message);
        }
    }
}

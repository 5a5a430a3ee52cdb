//! Which robot is driven, how carefully, and through which camera; or served to others.

use std::path::PathBuf;
use std::process::ExitCode;
use std::str::FromStr;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use clap::{Args, ValueEnum};
use spatial_fetch::behavior::Options;
use spatial_fetch::cli::{Exit, Failure, Pause, Reporter, on_interrupt, on_suspend, within};
use spatial_fetch::field::{NoEyes, RealDriver, RosCamera, StreamEyes, Tell};
use spatial_fetch::geometry::Pose;
use spatial_fetch::perception::Eyes;
use spatial_fetch::recording::Outputs;
use spatial_fetch::robot::arcos::client::{ArcosBase, ArcosSettings};
use spatial_fetch::robot::arcos::line::{Address, Line};
use spatial_fetch::robot::arcos::parameters::Parameters;
use spatial_fetch::robot::arcos::standby::GuardedLine;
use spatial_fetch::robot::p3dx::SonarArray;
use spatial_fetch::robot::ros::ros1::Ros1;
use spatial_fetch::robot::ros::{
    BodyFile, Names, RosBase, RosSettings, Transport, master_of, remapping, shipped_bodies,
};
use spatial_fetch::robot::{Body, RealBase, Remote, ThreadedBase, standby};
use spatial_fetch::simulation::arcos::DryLine;
use spatial_fetch::simulation::arcos::{ServeAddress, ServerSettings};
use spatial_fetch::simulation::{self, Home, Served, ServedRos};

/// Without a command for this long a served robot stops: as a Pioneer does, and as most ROS bases do.
const ARCOS_WATCHDOG_MS: u64 = 2000;
const ROS_WATCHDOG_MS: u64 = 600;

/// Where a robot is.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Place {
    Arcos(Address),
    /// The master, `HOST:PORT`.
    Ros1(String),
}

impl FromStr for Place {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match master_of(text) {
            Some(master) => master.map(Self::Ros1),
            None => text.parse().map(Self::Arcos).map_err(|error| format!("{error}, or ros1:HOST:11311")),
        }
    }
}

/// Where the simulated robot is served.
#[derive(Clone, Debug, PartialEq, Eq)]
enum ServePlace {
    Arcos(ServeAddress),
    Ros1(String),
}

impl FromStr for ServePlace {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match master_of(text) {
            Some(master) => master.map(Self::Ros1),
            None => text.parse().map(Self::Arcos).map_err(|error| format!("{error}, or ros1:HOST:11311")),
        }
    }
}

/// The models whose scales are known.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Model {
    /// ARCOS on the SH2 processor
    P3dxSh,
    /// The older H8 processor
    P3dx,
}

#[derive(Args)]
#[group(skip)]
#[command(next_help_heading = "Robot")]
pub struct Arguments {
    /// sim, `serial:/dev/ttyUSB0[@38400]`, tcp:HOST:8101, or `ros1:[HOST[:11311]]`, a robot that runs ROS 1
    #[arg(long, value_name = "ADDRESS", default_value = "sim")]
    robot: Place,
    /// Frames of the real robot's camera: an MCAP file, FIFO or `-`, kinect, or `ros1:[HOST[:11311]]`; none drives by
    /// odometry and sonar alone
    #[arg(long, value_name = "FILE", default_value = "none")]
    camera: PathBuf,
    /// Fastest, m/s
    #[arg(long, value_name = "M/S", default_value_t = 0.3, value_parser = within(0.01..=1.5))]
    max_speed: f64,
    /// Speeding up and slowing down, m/s²
    #[arg(long, value_name = "M/S2", default_value_t = 0.3, value_parser = within(0.01..=1.5))]
    max_acceleration: f64,
    /// Milliseconds after which the robot stops unless told again to go on
    #[arg(long, value_name = "MS", default_value_t = 300, value_parser = clap::value_parser!(u64).range(50..=2000))]
    deadline: u64,
    /// Go on by itself after the STOP button is released, or a stall is over
    #[arg(long)]
    resume: bool,
    /// Connect again when the link is lost, for up to this many seconds
    #[arg(long, value_name = "SECONDS", num_args = 0..=1, default_missing_value = "60")]
    reconnect: Option<u64>,
    /// Treat the robot as this model, whatever it calls itself
    #[arg(long, value_enum)]
    robot_model: Option<Model>,
    /// Where its sonars sit
    #[arg(long, value_enum, default_value = "newer")]
    sonars: SonarArray,
    /// Outline and limits of a robot that runs ROS: p3dx, turtlebot2, turtlebot4, create3, or a file like theirs
    #[arg(long, value_name = "NAME|FILE", default_value = "p3dx", help_heading = "ROS")]
    body: PathBuf,
    /// Another name for a topic, such as /cmd_vel:=/mobile_base/commands/velocity; again for each
    #[arg(long, value_name = "/OURS:=/THEIRS", value_parser = remapping, help_heading = "ROS")]
    remap: Vec<(String, String)>,
    /// Put before the names of all other topics but /tf
    #[arg(long, value_name = "NAME", default_value = "", hide_default_value = true, help_heading = "ROS")]
    namespace: String,
    /// Say velocities as TwistStamped
    #[arg(long, help_heading = "ROS")]
    stamped: bool,
    /// Print the commands the robot would get; touches no line
    #[arg(long)]
    dry_run: bool,
    /// Serve the simulated robot at tcp:127.0.0.1:8101 or `pty:PATH[@BAUD]`, to this or any ARCOS program, or as a ROS 1
    /// robot at the master `ros1:[HOST[:11311]]`
    #[arg(long, value_name = "ADDRESS", help_heading = "Serving the simulated robot")]
    serve: Option<ServePlace>,
    /// Stream what its Kinect sees, MCAP, into this file or FIFO (over ROS it is on topics)
    #[arg(long, value_name = "FILE", requires = "serve", help_heading = "Serving the simulated robot")]
    camera_out: Option<PathBuf>,
    /// Write where it truly is, JSON lines
    #[arg(long, value_name = "FILE", requires = "serve", help_heading = "Serving the simulated robot")]
    truth_out: Option<PathBuf>,
    /// Milliseconds without a command after which it stops by itself [default: 2000, over ROS 600]
    #[arg(long, value_name = "MS", value_parser = clap::value_parser!(u64).range(100..=65535), requires = "serve", help_heading = "Serving the simulated robot")]
    watchdog: Option<u64>,
}

impl Arguments {
    pub fn serves(&self) -> bool {
        self.serve.is_some()
    }

    pub fn is_real(&self) -> bool {
        self.robot != Place::Arcos(Address::Sim) || self.dry_run
    }

    fn settings(&self) -> ArcosSettings {
        ArcosSettings {
            speed: self.max_speed,
            acceleration: self.max_acceleration,
            braking: self.max_acceleration.max(ArcosSettings::default().braking),
            deadline: Duration::from_millis(self.deadline),
            resume: self.resume,
            reconnect: self.reconnect.map(Duration::from_secs),
            model: self.robot_model.map(|model| match model {
                Model::P3dxSh => Parameters::P3DX_SH,
                Model::P3dx => Parameters::P3DX,
            }),
            sonars: self.sonars,
            ..ArcosSettings::default()
        }
    }

    /// Serves until interrupted.
    pub fn run_served(
        self,
        home: &Home,
        reporter: &Reporter,
        how: simulation::TrialSettings,
        force: bool,
    ) -> Result<Exit, Failure> {
        let Some(place) = self.serve.clone() else { return Ok(Exit::Done) };
        for path in [&self.camera_out, &self.truth_out].into_iter().flatten() {
            spatial_fetch::files::refuse_existing(path, force)?;
        }
        let stop = spatial_fetch::simulation::served_until_interrupted();
        let closing = stop.clone();
        on_interrupt(move || closing.stop());
        let goes_on = || stop.goes_on();
        let tell = |text: &str| reporter.remark(text);
        let run = match place {
            ServePlace::Arcos(address) => self.serve_arcos(address, home, how, goes_on, tell),
            ServePlace::Ros1(master) => self.serve_ros(&master, home, how, goes_on, tell),
        };
        stop.ended();
        run.map(|()| Exit::Done)
    }

    fn serve_arcos(
        self,
        address: ServeAddress,
        home: &Home,
        how: simulation::TrialSettings,
        goes_on: impl FnMut() -> bool,
        tell: impl Fn(&str),
    ) -> Result<(), Failure> {
        let watchdog = Duration::from_millis(self.watchdog.unwrap_or(ARCOS_WATCHDOG_MS));
        let settings = ServerSettings { watchdog, ..ServerSettings::default() };
        let served = Served { address: address.clone(), settings, camera: self.camera_out, truth: self.truth_out, how };
        let run = served.run(home, goes_on, tell);
        run.map_err(|error| Failure::Failed(format!("--serve {address}: {error}")))
    }

    fn serve_ros(
        self,
        master: &str,
        home: &Home,
        how: simulation::TrialSettings,
        goes_on: impl FnMut() -> bool,
        tell: impl Fn(&str),
    ) -> Result<(), Failure> {
        if self.camera_out.is_some() {
            return Err(Failure::Usage("--camera-out: over ROS the camera is on topics".to_string()));
        }
        let failed = |error: &dyn std::fmt::Display| Failure::Failed(format!("--serve: {error}"));
        let node = Ros1::join(master, "fetch_robot").map_err(|error| failed(&error))?;
        let watchdog = Duration::from_millis(self.watchdog.unwrap_or(ROS_WATCHDOG_MS));
        let (names, stamped, truth) = (self.names(), self.stamped, self.truth_out);
        let served = ServedRos { names, watchdog, stamped, truth, how };
        served.run(home, Box::new(node), goes_on, tell).map_err(|error| failed(&error))
    }

    fn names(&self) -> Names {
        Names { namespace: self.namespace.clone(), remapped: self.remap.clone() }
    }

    /// Connects to the robot.
    pub fn driver(
        self,
        map: spatial_fetch::map::RoomMap,
        options: Options,
        outputs: Outputs,
        reporter: Reporter,
    ) -> Result<RealDriver, Failure> {
        let start = map.start;
        let origin = Arc::new(Mutex::new(start));
        let base: Box<dyn RealBase> = match &self.robot {
            Place::Ros1(master) if !self.dry_run => Box::new(self.ros_base(master, start, &origin)?),
            _ => {
                let base = ArcosBase::connect(self.line(&reporter)?, self.settings(), start);
                Box::new(base.map_err(|error| Failure::Failed(error.to_string()))?)
            }
        };
        let tell: Tell = Arc::new(move |text: &str| reporter.remark(text));
        let eyes = self.eyes(&map, base.as_ref(), &origin, &tell)?;
        let remote = base.remote();
        let driver = RealDriver::new(map, options, outputs, base, eyes, tell);
        let interrupter = driver.interrupter();
        on_interrupt(move || interrupter.stop());
        on_suspend(Arc::new(Suspended(remote)));
        Ok(driver)
    }

    fn eyes(
        &self,
        map: &spatial_fetch::map::RoomMap,
        base: &dyn RealBase,
        origin: &Arc<Mutex<Pose>>,
        tell: &Tell,
    ) -> Result<Box<dyn Eyes + Send>, Failure> {
        let (map, carrier, tell) = (map.clone(), base.remote(), Arc::clone(tell));
        let master = self.camera.to_str().and_then(master_of).transpose().map_err(Failure::Usage)?;
        let eyes = match self.camera.to_str() {
            _ if master.is_some() => {
                let (names, origin) = (self.names(), Arc::clone(origin));
                StreamEyes::ros(RosCamera { master: master.unwrap_or_default(), names, origin }, map, carrier, tell)
            }
            Some("none") => return Ok(Box::new(NoEyes)),
            #[cfg(feature = "kinect")]
            Some("kinect") => StreamEyes::kinect(map, carrier, tell),
            #[cfg(not(feature = "kinect"))]
            Some("kinect") => {
                let what = "--camera kinect: this build has no Kinect; build it with `--features kinect` (a file of that name is ./kinect)";
                return Err(Failure::Usage(what.to_string()));
            }
            _ => StreamEyes::open(&self.camera, map, carrier, tell),
        };
        let eyes = eyes.map_err(|error| Failure::Failed(format!("--camera: {error}")))?;
        on_interrupt(eyes.closer());
        Ok(Box::new(eyes))
    }

    /// The robot whose master is there.
    fn ros_base(&self, master: &str, start: Pose, origin: &Arc<Mutex<Pose>>) -> Result<ThreadedBase, Failure> {
        let failed = |error: &dyn std::fmt::Display| Failure::Failed(error.to_string());
        let node = Ros1::join(master, "fetch").map_err(|error| failed(&error))?;
        let transport: Box<dyn Transport> = Box::new(node);
        let settings = RosSettings {
            body: self.body()?,
            names: self.names(),
            stamped: self.stamped,
            deadline: Duration::from_millis(self.deadline),
            resume: self.resume,
            program: std::env::current_exe().ok().map(PathBuf::into_os_string),
            start,
            origin: Arc::clone(origin),
        };
        RosBase::connect(transport, settings).map_err(|error| failed(&error))
    }

    /// The body that is named, no faster than is allowed.
    fn body(&self) -> Result<Body, Failure> {
        let shipped = self.body.to_str().and_then(BodyFile::shipped);
        let file = match shipped {
            Some(file) => file,
            None => {
                let path = self.body.display();
                let names = shipped_bodies().collect::<Vec<_>>().join(", ");
                let read = std::fs::read_to_string(&self.body);
                let text =
                    read.map_err(|error| Failure::Failed(format!("--body {path}: {error}; shipped are {names}")))?;
                BodyFile::read(&text).map_err(|error| Failure::Failed(format!("--body {path}: {error}")))?
            }
        };
        let body = file.body();
        Ok(Body {
            speed_m_s: body.speed_m_s.min(self.max_speed),
            acceleration_m_s2: body.acceleration_m_s2.min(self.max_acceleration),
            turn_rad_s: body.turn_rad_s.min(ArcosSettings::default().turn),
            ..body
        })
    }

    fn line(&self, reporter: &Reporter) -> Result<Box<dyn Line + Send>, Failure> {
        if self.dry_run {
            return Ok(Box::new(DryLine::default()));
        }
        let none = || Failure::Usage("the simulated robot has no line".to_string());
        let Place::Arcos(address) = &self.robot else { return Err(none()) };
        let failed = |error: std::io::Error| Failure::Failed(format!("{address}: {error}"));
        let line = address.open().map_err(failed)?.ok_or_else(none)?;
        let program = std::env::current_exe().map_err(failed)?;
        match GuardedLine::new(line, program.as_os_str()) {
            Ok(line) => Ok(Box::new(line)),
            Err(error) => {
                let left = "if this process is killed, only the robot's own watchdog stops it";
                reporter.remark(&format!("no second process to stand by ({error}): {left}"));
                address.open().map_err(failed)?.ok_or_else(none)
            }
        }
    }
}

/// The robot, in a process that is suspended.
struct Suspended(Arc<dyn Remote>);

impl Pause for Suspended {
    fn pause(&self) {
        self.0.pause();
    }

    fn go_on(&self) {
        self.0.go_on();
    }
}

/// Whether this is the second process of a `drive` that drives a real robot.
pub fn stands_by() -> bool {
    std::env::args_os().nth(1).is_some_and(|first| first == standby::ARGUMENT)
}

/// Its whole life.
pub fn stand_by() -> ExitCode {
    if standby::stand_by().is_ok() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

//! Which robot is driven, how carefully, and through which camera; or served to others.

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use clap::{Args, ValueEnum};
use spatial_fetch::behavior::Options;
use spatial_fetch::cli::{Exit, Failure, Pause, Reporter, on_interrupt, on_suspend, within};
use spatial_fetch::field::{NoEyes, RealDriver, StreamEyes, Tell};
use spatial_fetch::perception::Eyes;
use spatial_fetch::recording::Outputs;
use spatial_fetch::robot::arcos::client::{ArcosBase, ArcosSettings};
use spatial_fetch::robot::arcos::line::{Address, Line};
use spatial_fetch::robot::arcos::parameters::Parameters;
use spatial_fetch::robot::arcos::standby::GuardedLine;
use spatial_fetch::robot::p3dx::SonarArray;
use spatial_fetch::robot::{RealBase, Remote, standby};
use spatial_fetch::simulation::arcos::DryLine;
use spatial_fetch::simulation::arcos::{ServeAddress, ServerSettings};
use spatial_fetch::simulation::{self, Home, Served};

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
    /// sim, `serial:/dev/ttyUSB0[@38400]` or tcp:HOST:8101
    #[arg(long, value_name = "ADDRESS", default_value = "sim")]
    robot: Address,
    /// Frames of the real robot's camera: an MCAP file, FIFO or `-`, or kinect; none drives by odometry and sonar alone
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
    /// Print the commands the robot would get; touches no line
    #[arg(long)]
    dry_run: bool,
    /// Serve the simulated robot at tcp:127.0.0.1:8101 or `pty:PATH[@BAUD]`, to this or any ARCOS program
    #[arg(long, value_name = "ADDRESS", help_heading = "Serving the simulated robot")]
    serve: Option<ServeAddress>,
    /// Stream what its Kinect sees, MCAP, into this file or FIFO
    #[arg(long, value_name = "FILE", requires = "serve", help_heading = "Serving the simulated robot")]
    camera_out: Option<PathBuf>,
    /// Write where it truly is, JSON lines
    #[arg(long, value_name = "FILE", requires = "serve", help_heading = "Serving the simulated robot")]
    truth_out: Option<PathBuf>,
    /// Milliseconds without a command after which it stops by itself
    #[arg(long, value_name = "MS", default_value_t = 2000, value_parser = clap::value_parser!(u64).range(100..=65535), requires = "serve", help_heading = "Serving the simulated robot")]
    watchdog: u64,
}

impl Arguments {
    pub fn serves(&self) -> bool {
        self.serve.is_some()
    }

    pub fn is_real(&self) -> bool {
        self.robot != Address::Sim || self.dry_run
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
        let Some(address) = self.serve else { return Ok(Exit::Done) };
        let settings = ServerSettings { watchdog: Duration::from_millis(self.watchdog), ..ServerSettings::default() };
        for path in [&self.camera_out, &self.truth_out].into_iter().flatten() {
            spatial_fetch::files::refuse_existing(path, force)?;
        }
        let served = Served { address: address.clone(), settings, camera: self.camera_out, truth: self.truth_out, how };
        let stop = spatial_fetch::simulation::served_until_interrupted();
        let closing = stop.clone();
        on_interrupt(move || closing.stop());
        let run = served.run(home, || stop.goes_on(), |text| reporter.remark(text));
        stop.ended();
        run.map(|()| Exit::Done).map_err(|error| Failure::Failed(format!("--serve {address}: {error}")))
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
        let base = ArcosBase::connect(self.line(&reporter)?, self.settings(), start);
        let base: Box<dyn RealBase> = Box::new(base.map_err(|error| Failure::Failed(error.to_string()))?);
        let tell: Tell = Arc::new(move |text: &str| reporter.remark(text));
        let eyes = self.eyes(&map, base.as_ref(), &tell)?;
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
        tell: &Tell,
    ) -> Result<Box<dyn Eyes + Send>, Failure> {
        let (map, carrier, tell) = (map.clone(), base.remote(), Arc::clone(tell));
        let eyes = match self.camera.to_str() {
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

    fn line(&self, reporter: &Reporter) -> Result<Box<dyn Line + Send>, Failure> {
        if self.dry_run {
            return Ok(Box::new(DryLine::default()));
        }
        let failed = |error: std::io::Error| Failure::Failed(format!("{}: {error}", self.robot));
        let none = || Failure::Usage("the simulated robot has no line".to_string());
        let line = self.robot.open().map_err(failed)?.ok_or_else(none)?;
        let program = std::env::current_exe().map_err(failed)?;
        match GuardedLine::new(line, program.as_os_str()) {
            Ok(line) => Ok(Box::new(line)),
            Err(error) => {
                let left = "if this process is killed, only the robot's own watchdog stops it";
                reporter.remark(&format!("no second process to stand by ({error}): {left}"));
                self.robot.open().map_err(failed)?.ok_or_else(none)
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

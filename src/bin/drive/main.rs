//! Plans in, trials out.

mod executive;
mod outputs;
mod replay;
mod robot;

use std::process::ExitCode;

use clap::Parser;
use spatial_fetch::cli::{
    self, Common, Exit, EyeArguments, Failure, FromLog, HomeArguments, Intake, Program, Reporter,
};
use spatial_fetch::record::Trial;
use spatial_fetch::simulation::{Driver, NoiseLevel, TrialSettings};

/// Drives the robot by its plan, through furniture it has not seen before, and says what became of it.
///
/// Reads records that `plan` has read and adds "trial".
#[derive(Parser)]
#[command(
    name = "drive",
    version,
    after_help = "Example:\n  echo 'my mug is on the table by the chairs in the bedroom' | chunk | ground | plan | drive --format text"
)]
struct Arguments {
    #[command(flatten)]
    home: HomeArguments,
    /// How imperfect the simulated robot's wheels, sonars, compass and start are [default: default, with --serve off]
    #[arg(long, value_enum)]
    noise: Option<NoiseLevel>,
    /// Seconds after which the simulated robot does what it is told, where it is not what its world says
    #[arg(long, value_name = "SECONDS", value_parser = cli::within(cli::DELAY_S))]
    dead_time: Option<f64>,
    /// Up to so many seconds more, differently each time
    #[arg(long, value_name = "SECONDS", value_parser = cli::within(cli::DELAY_S))]
    jitter: Option<f64>,
    #[command(flatten)]
    eyes: EyeArguments,
    #[command(flatten)]
    executive: executive::Arguments,
    #[command(flatten)]
    robot: robot::Arguments,
    #[command(flatten)]
    outputs: outputs::Arguments,
    #[command(flatten)]
    log: FromLog,
    #[command(flatten)]
    common: Common,
}

impl Program for Arguments {
    const NAME: &'static str = "drive";
    fn common(&self) -> &Common {
        &self.common
    }
    fn schema() -> schemars::Schema {
        schemars::schema_for!(Trial)
    }
    fn reads_standard_input(&self) -> bool {
        !self.robot.serves() && self.log.from.is_none() && self.common.files.is_empty()
    }
    fn run(self) -> Result<Exit, Failure> {
        let reporter = Reporter::new(Self::NAME, &self.common);
        let arguments = self.with_recorded_options(&reporter)?;
        arguments.drive(reporter)
    }
}

impl Arguments {
    /// With the options of the log that is replayed, where none were given.
    fn with_recorded_options(self, reporter: &Reporter) -> Result<Self, Failure> {
        // What comes through a pipe is read once.
        let Some(log) = self.log.from.clone().filter(|log| log.is_file()) else { return Ok(self) };
        // A log may say how a robot is simulated, never how a real one is driven.
        if self.robot.serves() || self.robot.is_real() {
            return Ok(self);
        }
        self.as_recorded_in(&log, reporter)
    }

    fn drive(self, reporter: Reporter) -> Result<Exit, Failure> {
        if self.robot.serves() {
            let settings = self.settings(NoiseLevel::Off);
            return self.robot.run_served(&self.home.load()?, &reporter, settings, self.common.force);
        }
        if self.robot.is_real() {
            return self.drive_real(reporter);
        }
        let home = self.home.load()?;
        let settings = self.settings(NoiseLevel::Default);
        let recorded = self.trial_options().line();
        let watched = self.outputs.is_live();
        let outputs = self.outputs.outputs(self.common.force, recorded, &reporter)?;
        let mut lines = self.log.lines(&self.common.files, "/fetch/plan")?;
        // Nobody watches two trials at once.
        let common = if watched { Common { jobs: 1, ..self.common } } else { self.common };
        let driver = Driver { home, settings, outputs };
        cli::run_filter_on(Self::NAME, &common, lines.as_mut(), Intake::Records, &driver)
    }

    /// How the simulated robot is, with that noise where none is given.
    fn settings(&self, usual: NoiseLevel) -> TrialSettings {
        TrialSettings {
            options: self.executive.options(),
            perception: self.eyes.perception,
            kinect: self.eyes.kinect(),
            noise: self.noise.unwrap_or(usual),
            dead_time_s: self.dead_time,
            jitter_s: self.jitter,
            seed: self.common.seed,
        }
    }

    /// Drives a real robot, of whose home the rooms alone are known.
    fn drive_real(self, reporter: Reporter) -> Result<Exit, Failure> {
        let map = self.home.rooms()?;
        let options = self.executive.options();
        let outputs = self.outputs.outputs(self.common.force, String::new(), &reporter)?;
        let mut lines = self.log.lines(&self.common.files, "/fetch/plan")?;
        // One robot, one plan at a time.
        let common = Common { jobs: 1, ..self.common };
        let to_stdout = common.output.is_none();
        let driver = self.robot.driver(map, options, outputs, reporter)?;
        let driver = driver.while_heard(move || to_stdout && cli::is_output_closed());
        cli::run_filter_on(Self::NAME, &common, lines.as_mut(), Intake::Records, &driver)
    }
}

fn main() -> ExitCode {
    cli::main::<Arguments>()
}

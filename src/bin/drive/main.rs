//! Plans in, trials out.

mod executive;
mod outputs;
mod replay;
mod robot;
mod talk;

use std::process::ExitCode;

use clap::Parser;
use spatial_fetch::cli::{
    self, Common, DEAD_TIME_S, Exit, EyeArguments, Failure, FromLog, HomeArguments, Intake, JITTER_S, Program,
    Reporter, within,
};
use spatial_fetch::files::write_file;
use spatial_fetch::record::Trial;
use spatial_fetch::simulation::{Driver, Inventory, NoiseLevel, TrialSettings, drawn};

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
    #[arg(long, value_name = "SECONDS", value_parser = within(DEAD_TIME_S))]
    dead_time: Option<f64>,
    /// Up to so many seconds more, differently each time
    #[arg(long, value_name = "SECONDS", value_parser = within(JITTER_S))]
    jitter: Option<f64>,
    /// Say what there is in the home – rooms, doors, furniture, objects – and end; with --plot draw it, too
    #[arg(long, help_heading = "Home")]
    list: bool,
    /// Look for an object that the simulated home does not have, too, in place of saying so at once
    #[arg(long, help_heading = "Home")]
    search_anyway: bool,
    #[command(flatten)]
    eyes: EyeArguments,
    #[command(flatten)]
    executive: executive::Arguments,
    #[command(flatten)]
    talk: talk::Arguments,
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
        !self.list && !self.talk.talk && !self.robot.serves() && self.log.from.is_none() && self.common.files.is_empty()
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
        self.with_options_of(&log, reporter)
    }

    /// Says what there is in the home.
    fn list(self) -> Result<Exit, Failure> {
        let home = self.home.load()?;
        if let Some(path) = self.outputs.plot() {
            write_file(path, drawn(&home).as_bytes(), self.common.force)?;
        }
        let inventory = Inventory::of(&home);
        cli::write_report(&self.common, &inventory, || inventory.text())?;
        Ok(Exit::Done)
    }

    fn drive(self, reporter: Reporter) -> Result<Exit, Failure> {
        if self.list {
            return self.list();
        }
        if self.robot.serves() {
            let settings = self.settings(NoiseLevel::Off);
            return self.robot.run_served(&self.home.load()?, &reporter, settings, self.common.force);
        }
        if self.talk.talk {
            return self.talk(&reporter);
        }
        if self.robot.is_real() {
            return self.drive_real(reporter);
        }
        let home = self.home.load()?;
        let settings = self.settings(NoiseLevel::Default);
        let recorded = self.trial_options().line();
        let watched = self.outputs.is_live();
        let page = self.outputs.page(self.common.force)?;
        let outputs = self.outputs.outputs(&self.common, recorded, &reporter)?;
        let stories = outputs.stories.clone();
        let mut lines = self.log.lines(&self.common, "/fetch/plan")?;
        // Nobody watches two trials at once.
        let common = if watched { Common { jobs: 1, ..self.common } } else { self.common };
        let driver = Driver { home, settings, outputs, search_anyway: self.search_anyway };
        let exit = cli::run_filter_on(Self::NAME, &common, lines.as_mut(), Intake::Records, &driver)?;
        let written = outputs::write_page(page, stories, &driver.home.map, &driver.home.pieces(), common.force);
        Ok(ended(exit, written, &common))
    }

    /// Talks with a person, errand after errand.
    fn talk(self, reporter: &Reporter) -> Result<Exit, Failure> {
        if self.robot.is_real() {
            return Err(Failure::Usage("--talk drives the simulated robot only; leave --robot away".to_string()));
        }
        let home = self.home.load()?;
        let map = home.map.clone();
        let settings = self.settings(NoiseLevel::Default);
        let recorded = self.trial_options().line();
        let page = self.outputs.page(self.common.force)?;
        let outputs = self.outputs.outputs(&self.common, recorded, reporter)?;
        let stories = outputs.stories.clone();
        let driver = Driver { home, settings, outputs, search_anyway: self.search_anyway };
        let (exit, session) = self.talk.run(driver, &self.common, reporter)?;
        let written = outputs::write_page(page, stories, &map, &session.home().pieces(), self.common.force);
        Ok(ended(exit, written, &self.common))
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
        let page = self.outputs.page(self.common.force)?;
        let outputs = self.outputs.outputs(&self.common, String::new(), &reporter)?;
        let (stories, rooms) = (outputs.stories.clone(), map.clone());
        let mut lines = self.log.lines(&self.common, "/fetch/plan")?;
        // One robot, one plan at a time.
        let common = Common { jobs: 1, ..self.common };
        let to_stdout = common.output.is_none();
        let driver = self.robot.driver(map, options, outputs, reporter)?;
        let driver = driver.while_heard(move || to_stdout && cli::is_output_closed());
        let exit = cli::run_filter_on(Self::NAME, &common, lines.as_mut(), Intake::Records, &driver)?;
        Ok(ended(exit, outputs::write_page(page, stories, &rooms, &[], common.force), &common))
    }
}

/// The records are out by now: a page that cannot be written is said, and is no reason to call them failed.
fn ended(exit: Exit, page: Result<(), Failure>, common: &Common) -> Exit {
    let Err(error) = page else { return exit };
    Reporter::new(Arguments::NAME, common).fatal(&error.to_string());
    Exit::Lost
}

fn main() -> ExitCode {
    if robot::stands_by() {
        return robot::stand_by();
    }
    cli::main::<Arguments>()
}

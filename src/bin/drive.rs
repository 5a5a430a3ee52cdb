//! Plans in, trials out.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use spatial_fetch::behavior::Options;
use spatial_fetch::cli::{self, Common, Exit, Failure, Intake, Program};
use spatial_fetch::record::Trial;
use spatial_fetch::trial::{Driver, Home, Outputs};

/// Drives the robot by its plan, through furniture it has not seen before, and says what became of it.
///
/// Reads records that `plan` has read and adds "trial".
#[derive(Parser)]
#[command(
    name = "drive",
    version,
    after_help = "Example:\n  echo 'the mug is in the bedroom on the table' | chunk | ground | plan | drive --format text"
)]
struct Arguments {
    /// Room map [default: the apartment]
    #[arg(long, value_name = "FILE", requires = "scene")]
    map: Option<PathBuf>,
    /// Furniture and objects of the simulated home [default: the apartment as first furnished]
    #[arg(long, value_name = "FILE")]
    scene: Option<PathBuf>,
    /// What the robot's eyes report
    #[arg(long, value_enum, default_value = "truth")]
    perception: Perception,
    /// Room and object only, nearest table first: the yardstick for what the words are worth
    #[arg(long)]
    blind: bool,
    /// Read each relation in its likeliest frame of reference only
    #[arg(long)]
    one_frame: bool,
    /// Use the first reference-direction pair only
    #[arg(long)]
    first_pair_only: bool,
    /// Do not try furniture the words do not fit
    #[arg(long)]
    no_fallback: bool,
    /// Do not go straight to an object recognised in passing: let the words alone choose
    #[arg(long)]
    no_glance: bool,
    /// Seconds of robot time a trial may take
    #[arg(long, value_name = "SECONDS", default_value_t = 900.0)]
    time_limit: f64,
    /// Draw the way through the rooms; {id} stands for the record's id
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,
    /// Write what the camera shows at the end, ID.png, into this folder
    #[arg(long, value_name = "DIR")]
    picture: Option<PathBuf>,
    /// Log the trial; {id} stands for the record's id
    #[arg(long, value_name = "FILE.mcap")]
    record: Option<PathBuf>,
    #[command(flatten)]
    common: Common,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum Perception {
    /// Ideal detections of what a camera would show
    Truth,
}

impl Program for Arguments {
    const NAME: &'static str = "drive";
    fn common(&self) -> &Common {
        &self.common
    }
    fn schema() -> schemars::Schema {
        schemars::schema_for!(Trial)
    }
    fn run(self) -> Result<Exit, Failure> {
        let Perception::Truth = self.perception;
        let home =
            Home::load(self.map.as_deref(), self.scene.as_deref()).map_err(|e| Failure::Failed(e.to_string()))?;
        let options = Options {
            blind: self.blind,
            one_frame: self.one_frame,
            first_pair_only: self.first_pair_only,
            no_fallback: self.no_fallback,
            no_glance: self.no_glance,
            time_limit_s: self.time_limit,
        };
        let outputs = Outputs { plot: self.plot, picture: self.picture, record: self.record, force: self.common.force };
        cli::run_filter(Self::NAME, &self.common, Intake::Records, &Driver { home, options, outputs })
    }
}

fn main() -> ExitCode {
    cli::main::<Arguments>()
}

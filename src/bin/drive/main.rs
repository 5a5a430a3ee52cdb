//! Plans in, trials out.

mod executive;
mod outputs;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use spatial_fetch::cli::{self, Common, Exit, EyeArguments, Failure, FromLog, Intake, Program};
use spatial_fetch::record::Trial;
use spatial_fetch::trial::{Driver, Home, NoiseLevel, Settings};

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
    /// Room map [default: the apartment]
    #[arg(long, value_name = "FILE", requires = "scene")]
    map: Option<PathBuf>,
    /// Furniture and objects of the simulated home [default: the apartment as first furnished]
    #[arg(long, value_name = "FILE")]
    scene: Option<PathBuf>,
    /// How imperfect the robot's wheels, sonars, compass and start are
    #[arg(long, value_enum, default_value = "default")]
    noise: NoiseLevel,
    #[command(flatten)]
    eyes: EyeArguments,
    #[command(flatten)]
    executive: executive::Arguments,
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
        self.log.from.is_none() && self.common.files.is_empty()
    }
    fn run(self) -> Result<Exit, Failure> {
        let home =
            Home::load(self.map.as_deref(), self.scene.as_deref()).map_err(|e| Failure::Failed(e.to_string()))?;
        let settings = Settings {
            options: self.executive.options(),
            perception: self.eyes.perception,
            kinect: self.eyes.kinect(),
            noise: self.noise,
            seed: self.common.seed,
        };
        let outputs = self.outputs.outputs(self.common.force);
        let mut lines = self.log.lines(&self.common.files, "/fetch/plan")?;
        cli::run_filter_on(
            Self::NAME,
            &self.common,
            lines.as_mut(),
            Intake::Records,
            &Driver { home, settings, outputs },
        )
    }
}

fn main() -> ExitCode {
    cli::main::<Arguments>()
}

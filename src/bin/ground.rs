//! Chunk trees in, room, RDT nodes and object out.

use std::process::ExitCode;

use clap::Parser;
use spatial_fetch::cli::{self, Common, Exit, Failure, FromLog, Intake, Program};
use spatial_fetch::grounding::{GroundStage, Settings};
use spatial_fetch::record::Grounding;

/// Finds what a description means: room, reference–direction–target nodes, object.
///
/// Reads records that `chunk` has read and adds "grounding".
#[derive(Parser)]
#[command(
    name = "ground",
    version,
    after_help = "Example:\n  echo 'my mug is on the table by the chairs in the bedroom' | chunk | ground --format text"
)]
struct Arguments {
    #[command(flatten)]
    settings: Settings,
    #[command(flatten)]
    log: FromLog,
    #[command(flatten)]
    common: Common,
}

impl Program for Arguments {
    const NAME: &'static str = "ground";
    fn common(&self) -> &Common {
        &self.common
    }
    fn schema() -> schemars::Schema {
        schemars::schema_for!(Grounding)
    }
    fn reads_standard_input(&self) -> bool {
        self.settings.train.is_none() && self.log.from.is_none() && self.common.files.is_empty()
    }
    fn run(self) -> Result<Exit, Failure> {
        let failed = |error: spatial_fetch::grounding::SettingsError| Failure::Failed(error.to_string());
        if let Some(model) = self.settings.trained().map_err(failed)? {
            let sink = cli::open_output(&self.common)?;
            sink.write(format!("{model}\n").as_bytes())?;
            return sink.finish().map(|()| Exit::Done);
        }
        let stage = GroundStage { grounder: self.settings.grounder().map_err(failed)?, answer: self.settings.answer };
        let mut lines = self.log.lines(&self.common, "/fetch/chunk")?;
        cli::run_filter_on(Self::NAME, &self.common, lines.as_mut(), Intake::Records, &stage)
    }
}

fn main() -> ExitCode {
    cli::main::<Arguments>()
}

//! Chunk trees in, room, RDT nodes and object out.

use std::process::ExitCode;

use clap::Parser;
use spatial_fetch::cli::{self, Common, Exit, Failure, Intake, Program};
use spatial_fetch::grounding::{GroundStage, Grounder, Method};
use spatial_fetch::record::Grounding;

/// Finds what a description means: room, reference–direction–target nodes, object.
///
/// Reads records that `chunk` has read and adds "grounding".
#[derive(Parser)]
#[command(
    name = "ground",
    version,
    after_help = "Example:\n  echo 'the mug is in the bedroom on the table' | chunk | ground --format text"
)]
struct Arguments {
    /// How chunks get their meaning
    #[arg(long, value_enum, default_value = "composed")]
    method: MethodName,
    /// Leave out the reasons
    #[arg(long)]
    brief: bool,
    #[command(flatten)]
    common: Common,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum MethodName {
    /// From what the words mean
    Composed,
    /// From the nearest labelled example of the shipped corpus, by the published equations
    Paper,
}

impl Program for Arguments {
    const NAME: &'static str = "ground";
    fn common(&self) -> &Common {
        &self.common
    }
    fn schema() -> schemars::Schema {
        schemars::schema_for!(Grounding)
    }
    fn run(self) -> Result<Exit, Failure> {
        let method = match self.method {
            MethodName::Composed => Method::Composed,
            MethodName::Paper => Method::Composed,
        };
        let stage = GroundStage(Grounder::new(method, self.brief));
        cli::run_filter(Self::NAME, &self.common, Intake::Records, &stage)
    }
}

fn main() -> ExitCode {
    cli::main::<Arguments>()
}

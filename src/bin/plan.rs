//! Groundings in, plans for one room map out.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use spatial_fetch::cli::{self, Common, Exit, Failure, FromLog, Intake, Program};
use spatial_fetch::map::{RoomMap, load_map};
use spatial_fetch::planning::Planner;
use spatial_fetch::record::Plan;

/// Turns what was understood into actions on a room map: enter the room, navigate inside it, find the object.
///
/// Reads records that `ground` has read and adds "plan".
#[derive(Parser)]
#[command(
    name = "plan",
    version,
    after_help = "Example:\n  echo 'my mug is on the table by the chairs in the bedroom' | chunk | ground | plan --format text"
)]
struct Arguments {
    /// Room map: a file, or a shipped home by its name (studio, flat, …) [default: apartment]
    #[arg(long, value_name = "MAP")]
    map: Option<PathBuf>,
    #[command(flatten)]
    log: FromLog,
    #[command(flatten)]
    common: Common,
}

impl Program for Arguments {
    const NAME: &'static str = "plan";
    fn common(&self) -> &Common {
        &self.common
    }
    fn schema() -> schemars::Schema {
        schemars::schema_for!(Plan)
    }
    fn reads_standard_input(&self) -> bool {
        self.log.from.is_none() && self.common.files.is_empty()
    }
    fn run(self) -> Result<Exit, Failure> {
        let map = self.map.map_or_else(|| Ok(RoomMap::apartment()), |which| load_map(&which));
        let planner = Planner::new(map.map_err(|error| Failure::Failed(error.to_string()))?);
        let mut lines = self.log.lines(&self.common, "/fetch/ground")?;
        cli::run_filter_on(Self::NAME, &self.common, lines.as_mut(), Intake::Records, &planner)
    }
}

fn main() -> ExitCode {
    cli::main::<Arguments>()
}

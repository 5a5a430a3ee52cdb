//! Histograms of forces between two shapes, and what they say in words.

use std::process::ExitCode;

use clap::Parser;
use spatial_fetch::cli::{self, Common, Exit, Failure, Intake, Program};
use spatial_fetch::force::{Describer, ForceName};
use spatial_fetch::record::Hof;

/// Histogram of forces: where is A, seen from B?
///
/// Reads {"a": SHAPE, "b": SHAPE}, a SHAPE being a GeoJSON Polygon or MultiPolygon geometry, and adds "hof".
#[derive(Parser)]
#[command(name = "hof", version, after_help = "Example:\n  hof --format text fixtures/hof/table-and-couch.jsonl")]
struct Arguments {
    /// Forces, separated by commas: numbers r for d^-r, and `hybrid`
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "0,2,hybrid")]
    forces: Vec<ForceName>,
    /// Directions of the histogram; value i belongs to 360°·i/K, counter-clockwise from +x
    #[arg(long, value_name = "K", default_value_t = 16, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    directions: u32,
    #[command(flatten)]
    common: Common,
}

impl Program for Arguments {
    const NAME: &'static str = "hof";
    fn common(&self) -> &Common {
        &self.common
    }
    fn schema() -> schemars::Schema {
        schemars::schema_for!(Hof)
    }
    fn run(self) -> Result<Exit, Failure> {
        let stage = Describer { forces: self.forces, directions: self.directions as usize };
        cli::run_filter(Self::NAME, &self.common, Intake::Records, &stage)
    }
}

fn main() -> ExitCode {
    cli::main::<Arguments>()
}

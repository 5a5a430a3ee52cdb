//! Histograms of forces between two shapes, and what they say in words.

use clap::Parser;
use spatial_fetch::cli::{self, Common, Exit, Failure, Intake, Program};
use spatial_fetch::files::Claims;
use spatial_fetch::force::{AxesName, Describer, ForceName, Pictures, raster::Fuzzy};

/// Histogram of forces: where is A, seen from B?
///
/// Reads `{"a": SHAPE, "b": SHAPE}` and adds "hof". A SHAPE is a GeoJSON Polygon, MultiPolygon or Feature, a grid `{"grid":{"rows":["..##"],"cell_m":0.05}}` with digits for membership, or a mask `{"mask":"a.png","cell_m":0.05}`. A "name" is used in the sentence. With a third shape, "c", it is also told whether A lies between B and C.
#[derive(Parser)]
#[command(name = "hof", version, after_help = "Example:\n  hof --format text fixtures/hof/table-and-couch.jsonl")]
struct Arguments {
    /// Forces, separated by commas: numbers r for d^-r, and `hybrid`
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "0,2,hybrid", allow_hyphen_values = true)]
    forces: Vec<ForceName>,
    /// Directions of the histogram; value i belongs to 360°·i/K, counter-clockwise from +x
    #[arg(long, value_name = "K", default_value_t = 16, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    directions: u32,
    /// Frame that names directions: map, robot, intrinsic, viewer, facing; all but map read "heading" (radians)
    #[arg(long, value_name = "FRAME", default_value = "map")]
    frame: AxesName,
    /// How memberships of fuzzy cells combine: product or minimum
    #[arg(long, value_name = "HOW", default_value = "product")]
    fuzzy: Fuzzy,
    /// Draw each record's objects and histograms into FOLDER/ID.svg
    #[arg(long, value_name = "FOLDER")]
    svg: Option<std::path::PathBuf>,
    #[command(flatten)]
    common: Common,
}

impl Program for Arguments {
    const NAME: &'static str = "hof";
    fn common(&self) -> &Common {
        &self.common
    }
    fn schema() -> schemars::Schema {
        schemars::schema_for!(spatial_fetch::record::Hof)
    }
    fn run(self) -> Result<Exit, Failure> {
        let Self { forces, directions, frame, fuzzy, svg, common } = self;
        let pictures = svg.map(|folder| Pictures { folder, overwrite: common.force, claims: Claims::default() });
        let stage = Describer { forces, directions: directions as usize, frame, fuzzy, pictures };
        let intake = Intake::Own(r#"`hof` reads two shapes a line, {"a": …, "b": …}; see --help"#);
        cli::run_filter(Self::NAME, &common, intake, &stage)
    }
}

fn main() -> std::process::ExitCode {
    cli::main::<Arguments>()
}

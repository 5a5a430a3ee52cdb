//! Frames in, furniture out.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use spatial_fetch::cli::{self, Common, Exit, Failure, Intake, Program};
use spatial_fetch::perception::Perceiver;
use spatial_fetch::record::Detection;

/// Finds furniture with pose in RGB-D frames.
///
/// Reads records that name a depth picture with its intrinsics and camera pose, and adds "detections".
#[derive(Parser)]
#[command(name = "perceive", version, after_help = "Example:\n  perceive --format text fixtures/frames/frames.jsonl")]
struct Arguments {
    /// Where relative paths of pictures begin [default: the folder of the first FILE]
    #[arg(long, value_name = "DIR")]
    folder: Option<PathBuf>,
    #[command(flatten)]
    common: Common,
}

impl Program for Arguments {
    const NAME: &'static str = "perceive";
    fn common(&self) -> &Common {
        &self.common
    }
    fn schema() -> schemars::Schema {
        schemars::schema_for!(Vec<Detection>)
    }
    fn run(self) -> Result<Exit, Failure> {
        let beside = self.common.files.first().and_then(|file| file.parent().map(PathBuf::from));
        let folder = self.folder.or(beside).unwrap_or_default();
        cli::run_filter(Self::NAME, &self.common, Intake::Records, &Perceiver { folder, ..Perceiver::default() })
    }
}

fn main() -> ExitCode {
    cli::main::<Arguments>()
}

//! Frames in, furniture out.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use spatial_fetch::cli::{self, Common, Exit, Failure, FrameInput, FromLog, Intake, Program};
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
    log: FromLog,
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
    fn reads_standard_input(&self) -> bool {
        self.log.from.is_none() && self.common.files.is_empty()
    }
    fn run(self) -> Result<Exit, Failure> {
        let beside = self.common.files.first().and_then(|file| file.parent().map(PathBuf::from));
        let folder = self.folder.or(beside).unwrap_or_default();
        let perceiver = Perceiver { folder, ..Perceiver::default() };
        match FrameInput::open(&self.common.files, &self.log)? {
            FrameInput::Lines(mut lines) => {
                cli::run_filter_on(Self::NAME, &self.common, &mut lines, Intake::Records, &perceiver)
            }
            FrameInput::Logs(logs) => cli::run_frames(Self::NAME, &self.common, logs, &perceiver, &|frame, record| {
                perceiver.see(frame, record)
            }),
        }
    }
}

fn main() -> ExitCode {
    cli::main::<Arguments>()
}

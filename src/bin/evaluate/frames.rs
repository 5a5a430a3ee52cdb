//! `evaluate frames`: training frames as files.

use std::path::PathBuf;

use clap::Args;
use rayon::prelude::*;
use spatial_fetch::cli::{Common, Exit, Failure, Progress};
use spatial_fetch::evaluation::write_training_frame;
use spatial_fetch::files::write_file;

use crate::{Reads, Subcommand};

/// Frames of rooms furnished at random, seen by a simulated Kinect: colour, depth, mask, and
/// `index.jsonl` with the truth, which is also what `perceive` reads.
#[derive(Args)]
pub struct Arguments {
    /// How many
    #[arg(long, value_name = "N", default_value_t = 100)]
    count: u64,
    /// The folder they are written into; made where it is not there
    #[arg(long, value_name = "DIR", default_value = "frames")]
    into: PathBuf,
}

impl Subcommand for Arguments {
    const READS: Reads = Reads::Options;

    fn run(&self, common: &Common) -> Result<Exit, Failure> {
        if let Some(output) = &common.output {
            let message = format!("frames are many files: name their folder by --into {}", output.display());
            return Err(Failure::Usage(message));
        }
        let folder = self.into.as_path();
        let failed = |error: std::io::Error| Failure::Failed(format!("{}: {error}", folder.display()));
        std::fs::create_dir_all(folder).map_err(failed)?;
        let progress = Progress::new(common, Some(self.count));
        let mut index = String::new();
        for first in (0..self.count).step_by(64) {
            let numbers: Vec<u64> = (first..self.count.min(first + 64)).collect();
            let write = |&number: &u64| write_training_frame(folder, common.seed, number, common.force);
            let lines: Result<Vec<String>, _> = numbers.par_iter().map(write).collect();
            let lines = lines.map_err(|error| Failure::Failed(error.to_string()))?;
            progress.add(lines.len() as u64);
            lines.iter().for_each(|line| index.extend([line.as_str(), "\n"]));
        }
        write_file(&folder.join("index.jsonl"), index.as_bytes(), common.force)
            .map_err(|error| Failure::Failed(error.to_string()))?;
        Ok(Exit::Done)
    }
}

//! `evaluate train`: the detector's model from rendered rooms.

use std::path::Path;

use clap::Args;
use spatial_fetch::cli::{Common, Exit, Failure};
use spatial_fetch::files::write_file;
use spatial_fetch::simulation::training::learning::{Schooling, train};

use crate::{Reads, Subcommand};

/// Learns the furniture detector from rooms furnished at random and seen by a simulated Kinect; the same
/// count and seed give the same bytes. `--output` names the file, `perceive --model` reads it.
#[derive(Args)]
pub struct Arguments {
    /// Frames to learn the categories from; half as many again are rendered for joining and fronts
    #[arg(long, value_name = "N", default_value_t = 4000)]
    count: u64,
}

impl Subcommand for Arguments {
    const READS: Reads = Reads::Options;

    fn run(&self, common: &Common) -> Result<Exit, Failure> {
        let model = train(Schooling { frames: self.count, seed: common.seed });
        let path = common.output.as_deref().unwrap_or(Path::new("furniture.model"));
        write_file(path, &model.write(), common.force).map_err(|error| Failure::Failed(error.to_string()))?;
        Ok(Exit::Done)
    }
}

//! `evaluate train`: the detector's model from rendered rooms.

use std::path::Path;

use clap::Args;
use spatial_fetch::cli::{Common, Exit, Failure};
use spatial_fetch::files::write_file;
use spatial_fetch::perception::training::{Schooling, train};

use crate::Command;

/// Learns the furniture detector from rooms furnished at random and seen by a simulated Kinect; the same
/// count and seed give the same bytes. `--output` names the file, `perceive --model` reads it.
#[derive(Args)]
pub struct Arguments {
    /// Frames to learn the categories from; half as many again are rendered for joining and fronts
    #[arg(long, value_name = "N", default_value_t = 4000)]
    count: u64,
    #[command(flatten)]
    common: Common,
}

impl Command for Arguments {
    fn common(&self) -> &Common {
        &self.common
    }

    fn reads_files(&self) -> bool {
        false
    }

    fn run(&self) -> Result<Exit, Failure> {
        let model = train(Schooling { frames: self.count, seed: self.common.seed });
        let path = self.common.output.as_deref().unwrap_or(Path::new("furniture.model"));
        write_file(path, &model.write(), self.common.force).map_err(|error| Failure::Failed(error.to_string()))?;
        Ok(Exit::Done)
    }
}

//! What a trial leaves beside its record.

use std::path::PathBuf;

use clap::Args;
use spatial_fetch::trial::Outputs;

#[derive(Args)]
#[command(next_help_heading = "Outputs")]
pub struct Arguments {
    /// Draw the way through the rooms; {id} stands for the record's id
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,
    /// Write what the camera shows at the end, ID.png, into this folder
    #[arg(long, value_name = "DIR")]
    picture: Option<PathBuf>,
    /// Log the trial; {id} stands for the record's id
    #[arg(long, value_name = "FILE.mcap")]
    record: Option<PathBuf>,
}

impl Arguments {
    pub fn outputs(self, force: bool, options: String) -> Outputs {
        Outputs { plot: self.plot, picture: self.picture, record: self.record, force, options }
    }
}

//! `evaluate perception`: detections against frames whose furniture is known.

use std::path::PathBuf;

use clap::Args;
use spatial_fetch::cli::{self, Common, Exit, Failure, Format};
use spatial_fetch::evaluation::{furniture_tables, gold_frames, score_furniture};

use crate::{Reads, Subcommand};

/// Scores the detections of records (as `perceive` writes them) against the frames' `items`:
/// found, right among six kinds, right name, errors of place and heading, and what is not there.
#[derive(Args)]
pub struct Arguments {
    /// The frames with their items
    #[arg(long, value_name = "FILE")]
    gold: PathBuf,
    /// Score only frames of this `subset`
    #[arg(long, value_name = "NAME")]
    subset: Option<String>,
}

impl Subcommand for Arguments {
    const READS: Reads = Reads::FilesOrStandardInput;

    fn run(&self, common: &Common) -> Result<Exit, Failure> {
        let gold = cli::read_lines(std::slice::from_ref(&self.gold))?;
        let records = cli::read_lines(&common.files)?;
        let frames = gold_frames(&gold, &records, self.subset.as_deref()).map_err(Failure::Failed)?;
        let scores = score_furniture(&frames);
        let title = format!("{} frames of {}", frames.len(), self.gold.display());
        let text = match common.format {
            Format::Text => furniture_tables(&title, &scores),
            Format::Json | Format::Csv => serde_json::to_string(&scores).map_err(|e| Failure::Failed(e.to_string()))?,
        };
        let sink = cli::open_output(common)?;
        sink.write(format!("{text}\n").as_bytes())?;
        sink.finish()?;
        Ok(Exit::Done)
    }
}

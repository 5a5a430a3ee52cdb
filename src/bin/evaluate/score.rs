//! `evaluate score`: piped records against gold.

use std::path::PathBuf;

use clap::Args;
use spatial_fetch::cli::{self, Common, Exit, Failure, Table};
use spatial_fetch::evaluation::{only_with_records, score};

use crate::{Reads, Subcommand};

#[derive(Args)]
pub struct Arguments {
    /// Gold descriptions [default: the shipped templates]
    #[arg(long, value_name = "FILE")]
    gold: Option<PathBuf>,
    /// These are a part of a run: leave out descriptions without a record, and add the parts up with `merge`
    #[arg(long)]
    part: bool,
}

impl Subcommand for Arguments {
    const READS: Reads = Reads::FilesOrStandardInput;

    fn run(&self, common: &Common) -> Result<Exit, Failure> {
        let mut gold = cli::load_gold(self.gold.as_deref())?;
        let lines = cli::read_lines(&common.files)?;
        if self.part {
            gold = only_with_records(gold, &lines);
        }
        let scores = score(&gold, &lines).map_err(Failure::Failed)?;
        let title = format!("{} descriptions, {} records", gold.len(), lines.len());
        cli::write_scores(common, &Table { title, scores })
    }
}

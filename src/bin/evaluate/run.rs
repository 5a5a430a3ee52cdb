//! `evaluate run`: a corpus end to end.

use std::path::PathBuf;

use clap::Args;
use spatial_fetch::behavior::Options;
use spatial_fetch::cli::{self, Common, Exit, EyeArguments, Failure, HomeArguments, Table};
use spatial_fetch::evaluation::{run_corpus, score};
use spatial_fetch::simulation::TrialSettings;

use crate::{Reads, Subcommand};

#[derive(Args)]
pub struct Arguments {
    /// Gold descriptions [default: the shipped templates]
    #[arg(long, value_name = "FILE")]
    gold: Option<PathBuf>,
    #[command(flatten)]
    home: HomeArguments,
    /// Room and object only, nearest table first
    #[arg(long)]
    blind: bool,
    #[command(flatten)]
    eyes: EyeArguments,
}

impl Subcommand for Arguments {
    const READS: Reads = Reads::Options;

    fn run(&self, common: &Common) -> Result<Exit, Failure> {
        let gold = cli::load_gold(self.gold.as_deref())?;
        let home = self.home.load()?;
        let options = Options { blind: self.blind, ..Options::default() };
        let settings = TrialSettings { options, seed: common.seed, ..self.eyes.settings() };
        let lines = run_corpus(&gold, &home, &settings);
        let scores = score(&gold, &lines).map_err(Failure::Failed)?;
        let title = format!("{} descriptions, {} records", gold.len(), lines.len());
        cli::write_scores(common, &Table { title, scores })
    }
}

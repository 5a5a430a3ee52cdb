//! `evaluate blame`: each failed trial again, with gold in place of one stage at a time.

use std::path::PathBuf;

use clap::Args;
use spatial_fetch::cli::{self, Common, Exit, Failure, HomeArguments};
use spatial_fetch::evaluation::{Measure, Wanted, blame, blame_text};
use spatial_fetch::simulation::{Perception, TrialSettings};

use crate::{Reads, Subcommand};

#[derive(Args)]
pub struct Arguments {
    /// Gold descriptions with trees and meanings [default: the shipped templates]
    #[arg(long, value_name = "FILE")]
    gold: Option<PathBuf>,
    /// Gold meanings in a file of their own; descriptions without one are left out
    #[arg(long, value_name = "FILE", requires = "gold")]
    meanings: Option<PathBuf>,
    #[command(flatten)]
    home: HomeArguments,
    /// What a trial has to reach
    #[arg(long, value_enum, value_name = "WHAT", default_value = "right-first")]
    measure: Measure,
    /// What the furniture to go to first is taken from
    #[arg(long, value_enum, value_name = "BY", default_value_t)]
    wanted: Wanted,
    /// What the robot's eyes report
    #[arg(long, value_enum, default_value = "truth")]
    perception: Perception,
}

impl Subcommand for Arguments {
    const READS: Reads = Reads::Options;

    fn run(&self, common: &Common) -> Result<Exit, Failure> {
        let gold = cli::load_gold_with(self.gold.as_deref(), self.meanings.as_deref())?;
        let home = self.home.load()?;
        let settings = TrialSettings { perception: self.perception, seed: common.seed, ..TrialSettings::default() };
        let blames = cli::on_threads(common.jobs, || blame(&gold, &home, &settings, self.measure, self.wanted))?;
        cli::write_report(common, &blames, || blame_text(&blames))?;
        Ok(Exit::Done)
    }
}

//! `evaluate blame`: each failed trial again, with gold in place of one stage at a time.

use std::path::PathBuf;

use clap::Args;
use spatial_fetch::cli::{self, Common, Exit, Failure};
use spatial_fetch::evaluation::{Measure, Wanted, blame, blame_text};
use spatial_fetch::trial::{Home, Perception, Settings};

#[derive(Args)]
pub struct Arguments {
    /// Gold descriptions with trees and meanings [default: the shipped templates]
    #[arg(long, value_name = "FILE")]
    gold: Option<PathBuf>,
    /// Gold meanings in a file of their own; descriptions without one are left out
    #[arg(long, value_name = "FILE", requires = "gold")]
    meanings: Option<PathBuf>,
    /// Room map [default: the apartment]
    #[arg(long, value_name = "FILE", requires = "scene")]
    map: Option<PathBuf>,
    /// Furniture and objects of the simulated home
    #[arg(long, value_name = "FILE")]
    scene: Option<PathBuf>,
    /// What a trial has to reach
    #[arg(long, value_enum, value_name = "WHAT", default_value = "right-first")]
    measure: Measure,
    /// What the furniture to go to first is taken from
    #[arg(long, value_enum, value_name = "BY", default_value_t)]
    wanted: Wanted,
    /// What the robot's eyes report
    #[arg(long, value_enum, default_value = "truth")]
    perception: Perception,
    #[command(flatten)]
    pub common: Common,
}

impl Arguments {
    pub fn run(self) -> Result<Exit, Failure> {
        let gold = cli::load_gold_with(self.gold.as_deref(), self.meanings.as_deref())?;
        let home =
            Home::load(self.map.as_deref(), self.scene.as_deref()).map_err(|e| Failure::Failed(e.to_string()))?;
        let settings = Settings { perception: self.perception, seed: self.common.seed, ..Settings::default() };
        let blames = cli::on_threads(self.common.jobs, || blame(&gold, &home, &settings, self.measure, self.wanted))?;
        cli::write_report(&self.common, &blames, || blame_text(&blames))?;
        Ok(Exit::Done)
    }
}

//! `evaluate run`: a corpus end to end.

use std::path::PathBuf;

use clap::Args;
use spatial_fetch::behavior::Options;
use spatial_fetch::cli::{self, Common, Exit, EyeArguments, Failure, Table};
use spatial_fetch::evaluation::{run_corpus, score};
use spatial_fetch::trial::{Home, Settings};

#[derive(Args)]
pub struct Arguments {
    /// Gold descriptions [default: the shipped templates]
    #[arg(long, value_name = "FILE")]
    gold: Option<PathBuf>,
    /// Room map [default: the apartment]
    #[arg(long, value_name = "FILE", requires = "scene")]
    map: Option<PathBuf>,
    /// Furniture and objects of the simulated home
    #[arg(long, value_name = "FILE")]
    scene: Option<PathBuf>,
    /// Room and object only, nearest table first
    #[arg(long)]
    blind: bool,
    #[command(flatten)]
    eyes: EyeArguments,
    #[command(flatten)]
    pub common: Common,
}

impl Arguments {
    pub fn run(self) -> Result<Exit, Failure> {
        let gold = cli::load_gold(self.gold.as_deref())?;
        let home =
            Home::load(self.map.as_deref(), self.scene.as_deref()).map_err(|e| Failure::Failed(e.to_string()))?;
        let options = Options { blind: self.blind, ..Options::default() };
        let (perception, kinect) = (self.eyes.perception, self.eyes.kinect());
        let settings = Settings { options, perception, kinect, seed: self.common.seed, ..Settings::default() };
        let lines = run_corpus(&gold, &home, &settings);
        let scores = score(&gold, &lines).map_err(Failure::Failed)?;
        let title = format!("{} descriptions, {} records", gold.len(), lines.len());
        cli::write_scores(&self.common, &Table { title, scores })
    }
}

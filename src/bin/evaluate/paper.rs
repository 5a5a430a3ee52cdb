//! `evaluate paper`: Tables I, II and III in one command.

use std::path::PathBuf;

use clap::Args;
use spatial_fetch::cli::{self, Common, Exit, Failure, Reporter};
use spatial_fetch::evaluation::{Paper, paper, paper_csv, paper_text, write_report};
use spatial_fetch::trial::{Home, Perception, Settings};
use spatial_fetch::world::{RoomMap, Scene};

#[derive(Args)]
pub struct Arguments {
    /// Gold descriptions of the apartment [default: the shipped templates]
    #[arg(long, value_name = "FILE")]
    gold: Option<PathBuf>,
    /// Trials of each unique instruction, under seeds counted on from --seed
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u64).range(1..))]
    seeds: u64,
    /// What the robot's eyes report
    #[arg(long, value_enum, default_value = "truth")]
    perception: Perception,
    /// Write the tables as comma-separated values
    #[arg(long)]
    csv: bool,
    /// Write index.html into this folder: the tables, and every trial with way, picture and tree
    #[arg(long, value_name = "DIR")]
    report: Option<PathBuf>,
    #[command(flatten)]
    pub common: Common,
}

impl Arguments {
    pub fn run(self) -> Result<Exit, Failure> {
        let gold = cli::load_gold(self.gold.as_deref())?;
        let corpus = self.gold.as_ref().map_or("own templates".to_string(), |path| path.display().to_string());
        let homes =
            [Scene::apartment(), Scene::apartment_modified()].map(|scene| Home { map: RoomMap::apartment(), scene });
        let settings = Settings { perception: self.perception, seed: self.common.seed, ..Settings::default() };
        let result = cli::on_threads(self.common.jobs, || {
            let (result, cases) = paper(&corpus, &gold, &homes, settings, self.seeds);
            let write = |folder: &PathBuf| write_report(folder, &result, &cases, &homes, self.common.force);
            (self.report.as_ref().map(write).transpose(), result)
        })?;
        if let Some(path) = result.0? {
            Reporter::new("evaluate", &self.common).remark(&format!("the report is {}", path.display()));
        }
        self.write(&result.1)
    }

    fn write(&self, result: &Paper) -> Result<Exit, Failure> {
        if self.csv {
            cli::write_text(&self.common, &paper_csv(result))?;
        } else {
            cli::write_report(&self.common, result, || paper_text(result))?;
        }
        Ok(Exit::Done)
    }
}

//! `evaluate paper`: Tables I, II and III in one command.

use std::path::PathBuf;

use clap::Args;
use spatial_fetch::cli::{self, Common, Exit, Failure, Reporter};
use spatial_fetch::evaluation::{Experiments, Paper, paper_csv, paper_text, write_report};
use spatial_fetch::files::refuse_existing;
use spatial_fetch::map::RoomMap;
use spatial_fetch::simulation::Scene;
use spatial_fetch::simulation::{Home, Perception, TrialSettings};

use crate::{Reads, Subcommand};

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
}

impl Subcommand for Arguments {
    const READS: Reads = Reads::Options;

    fn run(&self, common: &Common) -> Result<Exit, Failure> {
        if let Some(folder) = &self.report {
            refuse_existing(&folder.join("index.html"), common.force)?;
        }
        let gold = cli::load_gold(self.gold.as_deref())?;
        let corpus = self.gold.as_ref().map_or("own templates".to_string(), |path| path.display().to_string());
        let homes =
            [Scene::apartment(), Scene::apartment_modified()].map(|scene| Home::new(RoomMap::apartment(), scene));
        let settings = TrialSettings { perception: self.perception, seed: common.seed, ..TrialSettings::default() };
        let experiments = Experiments { corpus, gold: &gold, homes: &homes, settings, seeds: self.seeds };
        let result = cli::counted_on_threads(common, experiments.trials(), |done| experiments.run(done))?;
        if let Some(folder) = &self.report {
            let write = || write_report(folder, &result, &experiments.cases(), &homes, common.force);
            let path = cli::on_threads(common.jobs, write)??;
            Reporter::new("evaluate", common).remark(&format!("the report is {}", path.display()));
        }
        self.write(common, &result)
    }
}

impl Arguments {
    fn write(&self, common: &Common, result: &Paper) -> Result<Exit, Failure> {
        if self.csv {
            cli::write_text(common, &paper_csv(result))?;
        } else {
            cli::write_report(common, result, || paper_text(result))?;
        }
        Ok(Exit::Done)
    }
}

//! `evaluate behavior`: the paper's Experiments 2 and 3.

use std::path::PathBuf;

use clap::Args;
use spatial_fetch::cli::{self, Common, Exit, EyeArguments, Failure, HomeArguments};
use spatial_fetch::evaluation::behavior::{Selection, Source, Study, behavior_tables, conditions, instructions};
use spatial_fetch::simulation::Scene;
use spatial_fetch::simulation::{Home, NoiseLevel, TrialSettings};

use crate::{Reads, Subcommand};

#[derive(Args)]
pub struct Arguments {
    /// Gold descriptions [default: the shipped templates]
    #[arg(long, value_name = "FILE")]
    gold: Option<PathBuf>,
    #[command(flatten)]
    home: HomeArguments,
    /// Where the instructions come from
    #[arg(long, value_enum, default_value = "gold")]
    instructions: Source,
    /// Which of them
    #[arg(long, value_enum, default_value = "all")]
    select: Selection,
    /// Trials of each instruction, each with its own errors of odometry, sonar and start pose
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u64).range(1..))]
    seeds: u64,
    #[command(flatten)]
    eyes: EyeArguments,
    /// How imperfect the robot's wheels, sonars, compass and start are
    #[arg(long, value_enum, default_value = "default")]
    noise: NoiseLevel,
    /// Also drive without each part of the executive, to tell what it is worth
    #[arg(long)]
    ablations: bool,
    /// Say of each instruction whose first furniture was wrong whether the words allow it
    #[arg(long)]
    explain: bool,
}

impl Subcommand for Arguments {
    const READS: Reads = Reads::Options;

    fn run(&self, common: &Common) -> Result<Exit, Failure> {
        let gold = cli::load_gold(self.gold.as_deref())?;
        let homes = self.homes()?;
        let instructions = instructions(&gold, &homes[0].1.map, self.instructions, self.select);
        if instructions.is_empty() {
            return Err(Failure::Failed("no description says what it means; --gold needs labels".to_string()));
        }
        let seed = common.seed;
        let study = Study {
            instructions,
            conditions: conditions(&homes, self.ablations),
            placements: homes.len(),
            settings: TrialSettings { noise: self.noise, seed, ..self.eyes.settings() },
            seeds: self.seeds,
            explained: self.explain,
        };
        let source = self.source();
        let report = cli::counted_on_threads(common, study.trials(), |done| study.run(&source, done))?;
        cli::write_report(common, &report, || behavior_tables(&report))?;
        Ok(Exit::Done)
    }
}

impl Arguments {
    fn homes(&self) -> Result<Vec<(&'static str, Home)>, Failure> {
        let home = self.home.load()?;
        if self.home.world.is_some() {
            return Ok(vec![("furniture of --world", home)]);
        }
        let moved = Home::new(home.map.clone(), Scene::apartment_modified());
        Ok(vec![("Table II: as first furnished", home), ("Table III: furniture moved", moved)])
    }

    fn source(&self) -> String {
        let source = match self.instructions {
            Source::Gold => "gold",
            Source::Text => "from their text",
        };
        let select = match self.select {
            Selection::All => "",
            Selection::Unique => ", each once",
            Selection::UniquePlaces => ", each once, bare targets aside",
        };
        format!("{source}{select}")
    }
}

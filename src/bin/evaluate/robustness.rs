//! `evaluate robustness`: furniture that moves, other homes, homes made for gold groundings.

use std::path::PathBuf;

use clap::Args;
use spatial_fetch::behavior::Options;
use spatial_fetch::cli::{self, Common, Exit, EyeArguments, Failure};
use spatial_fetch::evaluation::robustness::{
    Experiment, Robustness, gold_homes, homes, own_homes, placements, read_gold_lines, read_texts,
};
use spatial_fetch::simulation::arrange::Relations;
use spatial_fetch::simulation::{Home, TrialSettings};

use crate::{Reads, Subcommand};

#[derive(Args)]
pub struct Arguments {
    /// Random placements that keep the relations the words tell; 0 leaves the experiment out
    #[arg(long, value_name = "N", default_value_t = 100)]
    placements: usize,
    /// Random placements that break them
    #[arg(long, value_name = "N", default_value_t = 0)]
    broken: usize,
    /// Trials of each, with a seed each
    #[arg(long, value_name = "N", default_value_t = 1)]
    seeds: u64,
    /// Descriptions for the placements [default: the shipped templates]
    #[arg(long, value_name = "FILE")]
    corpus: Option<PathBuf>,
    /// The home whose furniture is placed anew: a scene file, or a shipped home by its name [default: apartment]
    #[arg(long, value_name = "WORLD")]
    world: Option<PathBuf>,
    /// Leave the other shipped homes out
    #[arg(long)]
    no_homes: bool,
    /// Gold groundings, one JSON object a line (id, object, room, nodes): each is driven in a home made so that it is true
    #[arg(long, value_name = "FILE")]
    gold: Option<PathBuf>,
    /// Their descriptions (id, text): each is driven by its text as well
    #[arg(long, value_name = "FILE", requires = "gold")]
    texts: Option<PathBuf>,
    /// Do not go straight to an object recognised in passing: let the words alone choose
    #[arg(long)]
    no_glance: bool,
    #[command(flatten)]
    eyes: EyeArguments,
}

impl Subcommand for Arguments {
    const READS: Reads = Reads::Options;

    fn run(&self, common: &Common) -> Result<Exit, Failure> {
        let total = self.total()?;
        let robustness = cli::counted_on_threads(common, total, |done| self.measure(common, done))??;
        cli::write_robustness(common, &robustness)
    }
}

impl Arguments {
    fn measure(&self, common: &Common, done: &(dyn Fn() + Sync)) -> Result<Robustness, Failure> {
        let options = Options { no_glance: self.no_glance, ..Options::default() };
        let settings = TrialSettings { options, seed: common.seed, ..self.eyes.settings() };
        let experiment = Experiment { settings, seeds: self.seeds, done };
        let corpus = cli::load_gold(self.corpus.as_deref())?;
        let home = Home::load(None, self.world.as_deref()).map_err(failed)?;
        let placed = |relations, count| (count > 0).then(|| placements(&corpus, &home, relations, count, &experiment));
        let mut robustness = Robustness {
            kept: placed(Relations::Kept, self.placements),
            broken: placed(Relations::Broken, self.broken),
            ..Robustness::default()
        };
        if !self.no_homes {
            robustness.homes = homes(&experiment).map_err(failed)?;
        }
        if let Some(path) = &self.gold {
            let gold = read_gold_lines(&cli::read_file(path)?, &path.display().to_string()).map_err(failed)?;
            robustness.gold = Some(gold_homes(&gold, None, &experiment));
            if let Some(path) = &self.texts {
                let texts = read_texts(&cli::read_file(path)?, &path.display().to_string()).map_err(failed)?;
                robustness.gold_from_text = Some(gold_homes(&gold, Some(&texts), &experiment));
            }
        }
        Ok(robustness)
    }

    /// How many trials there will be, about.
    fn total(&self) -> Result<u64, Failure> {
        let in_homes = if self.no_homes { 0 } else { own_homes().map_err(failed)?.iter().map(|h| h.gold.len()).sum() };
        let gold = self.gold.as_ref().map(|path| cli::read_file(path)).transpose()?;
        let gold = gold.map_or(0, |text| text.lines().count());
        let ways = 1 + usize::from(self.texts.is_some());
        Ok(self.seeds * (self.placements + self.broken + in_homes + gold * ways) as u64)
    }
}

fn failed(error: impl std::fmt::Display) -> Failure {
    Failure::Failed(error.to_string())
}

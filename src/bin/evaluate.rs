//! Scores records against gold, and runs a corpus end to end.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use spatial_fetch::behavior::Options;
use spatial_fetch::cli::{self, Common, Exit, Failure, Program, Table};
use spatial_fetch::evaluation::{Scores, run_corpus, score};
use spatial_fetch::trial::Home;

/// Holds what the stages say against gold: trees, groundings, trials, with counts and intervals.
#[derive(Parser)]
#[command(
    name = "evaluate",
    version,
    after_help = "Examples:\n  evaluate run --format text\n  jq -c '{id,text}' corpus/templates.jsonl | chunk | ground | evaluate score --format text"
)]
struct Arguments {
    #[command(subcommand)]
    what: What,
}

#[derive(Subcommand)]
enum What {
    /// Score records from files or standard input
    Score {
        /// Gold descriptions [default: the shipped templates]
        #[arg(long, value_name = "FILE")]
        gold: Option<PathBuf>,
        #[command(flatten)]
        common: Common,
    },
    /// Run a corpus end to end, from text to trial, and score it
    Run {
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
        common: Common,
    },
}

impl Program for Arguments {
    const NAME: &'static str = "evaluate";
    fn common(&self) -> &Common {
        match &self.what {
            What::Score { common, .. } | What::Run { common, .. } => common,
        }
    }
    fn schema() -> schemars::Schema {
        schemars::schema_for!(Scores)
    }
    fn reads_standard_input(&self) -> bool {
        matches!(&self.what, What::Score { common, .. } if common.files.is_empty())
    }
    fn run(self) -> Result<Exit, Failure> {
        let (gold, lines, common) = match self.what {
            What::Score { gold, common } => (cli::load_gold(gold.as_deref())?, cli::read_lines(&common.files)?, common),
            What::Run { gold, map, scene, blind, common } => {
                let gold = cli::load_gold(gold.as_deref())?;
                let home = Home::load(map.as_deref(), scene.as_deref()).map_err(|e| Failure::Failed(e.to_string()))?;
                let lines = run_corpus(&gold, &home, Options { blind, ..Options::default() });
                (gold, lines, common)
            }
        };
        let scores = score(&gold, &lines).map_err(Failure::Failed)?;
        let title = format!("{} descriptions, {} records", gold.len(), lines.len());
        cli::write_scores(&common, &Table { title, scores })
    }
}

fn main() -> ExitCode {
    cli::main::<Arguments>()
}

//! Scores records against gold, and runs the experiments: one file a subcommand.

mod frames;
mod run;
mod score;

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use spatial_fetch::cli::{self, Common, Exit, Failure, Program};
use spatial_fetch::evaluation::Scores;

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
    Score(score::Arguments),
    /// Run a corpus end to end, from text to trial, and score it
    Run(run::Arguments),
    /// Render frames of rooms furnished at random, with the truth, to train and test perception on
    Frames(frames::Arguments),
}

impl Program for Arguments {
    const NAME: &'static str = "evaluate";
    fn common(&self) -> &Common {
        match &self.what {
            What::Score(arguments) => &arguments.common,
            What::Run(arguments) => &arguments.common,
            What::Frames(arguments) => &arguments.common,
        }
    }
    fn schema() -> schemars::Schema {
        schemars::schema_for!(Scores)
    }
    fn reads_standard_input(&self) -> bool {
        matches!(&self.what, What::Score(arguments) if arguments.common.files.is_empty())
    }
    fn run(self) -> Result<Exit, Failure> {
        match self.what {
            What::Score(arguments) => arguments.run(),
            What::Run(arguments) => arguments.run(),
            What::Frames(arguments) => arguments.run(),
        }
    }
}

fn main() -> ExitCode {
    cli::main::<Arguments>()
}

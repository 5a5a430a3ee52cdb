//! Scores records against gold, and runs the experiments: one file a subcommand.

mod behavior;
mod frames;
mod perception;
mod run;
mod score;
mod train;

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
    /// Score detections against frames whose furniture is known
    Perception(perception::Arguments),
    /// Learn the furniture detector from such rooms
    Train(train::Arguments),
    /// Drive a corpus many times over: the paper's Tables II and III, ablations, and why it went wrong
    Behavior(behavior::Arguments),
}

impl Program for Arguments {
    const NAME: &'static str = "evaluate";
    fn common(&self) -> &Common {
        match &self.what {
            What::Score(arguments) => &arguments.common,
            What::Run(arguments) => &arguments.common,
            What::Frames(arguments) => &arguments.common,
            What::Perception(arguments) => &arguments.common,
            What::Train(arguments) => &arguments.common,
            What::Behavior(arguments) => &arguments.common,
        }
    }
    fn schema() -> schemars::Schema {
        schemars::schema_for!(Scores)
    }
    fn reads_standard_input(&self) -> bool {
        match &self.what {
            What::Score(arguments) => arguments.common.files.is_empty(),
            What::Perception(arguments) => arguments.common.files.is_empty(),
            _ => false,
        }
    }
    fn run(self) -> Result<Exit, Failure> {
        match self.what {
            What::Score(arguments) => arguments.run(),
            What::Run(arguments) => arguments.run(),
            What::Frames(arguments) => arguments.run(),
            What::Perception(arguments) => arguments.run(),
            What::Train(arguments) => arguments.run(),
            What::Behavior(arguments) => arguments.run(),
        }
    }
}

fn main() -> ExitCode {
    cli::main::<Arguments>()
}

//! Scores records against gold, and runs the experiments: one file a subcommand.

mod behavior;
mod blame;
mod chunking;
mod compare;
mod frames;
mod grounding;
mod import;
mod merge;
mod paper;
mod perception;
mod run;
mod score;
mod train;
mod what_if;

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
    /// Chunk corpora and score the trees
    Chunking(chunking::Arguments),
    /// Ground corpora by both methods and score the meanings
    Grounding(grounding::Arguments),
    /// Read the authors' public treebank and groundings into this project's format
    Import(import::Arguments),
    /// Run a corpus end to end, from text to trial, and score it
    Run(run::Arguments),
    /// Run the paper's three experiments: its figures beside ours
    Paper(paper::Arguments),
    /// Charge each failed trial to the stage whose gold mends it
    Blame(blame::Arguments),
    /// Compare two result files: fixed, broken, changed
    Compare(compare::Arguments),
    /// Find the smallest changes of words and furniture that change the outcome
    #[command(name = "what-if")]
    Counterfactual(what_if::Arguments),
    /// Add up the scores of the parts of a run
    Merge(merge::Arguments),
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
            What::Chunking(arguments) => &arguments.common,
            What::Grounding(arguments) => &arguments.common,
            What::Import(arguments) => &arguments.common,
            What::Run(arguments) => &arguments.common,
            What::Paper(arguments) => &arguments.common,
            What::Blame(arguments) => &arguments.common,
            What::Compare(arguments) => &arguments.common,
            What::Counterfactual(arguments) => &arguments.common,
            What::Merge(arguments) => &arguments.common,
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
            What::Merge(arguments) => arguments.common.files.is_empty(),
            What::Counterfactual(arguments) => arguments.reads_standard_input(),
            What::Perception(arguments) => arguments.common.files.is_empty(),
            _ => false,
        }
    }
    fn run(self) -> Result<Exit, Failure> {
        match self.what {
            What::Score(arguments) => arguments.run(),
            What::Chunking(arguments) => arguments.run(),
            What::Grounding(arguments) => arguments.run(),
            What::Import(arguments) => arguments.run(),
            What::Run(arguments) => arguments.run(),
            What::Paper(arguments) => arguments.run(),
            What::Blame(arguments) => arguments.run(),
            What::Compare(arguments) => arguments.run(),
            What::Counterfactual(arguments) => arguments.run(),
            What::Merge(arguments) => arguments.run(),
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

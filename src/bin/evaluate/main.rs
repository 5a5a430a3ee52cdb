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
mod robustness;
mod run;
mod scene;
mod score;
mod train;
mod what_if;

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use spatial_fetch::cli::{self, Common, Exit, Failure, Program};
use spatial_fetch::evaluation::Scores;
use spatial_fetch::files::refuse_existing;

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
    /// Moved furniture, other homes, and homes made for gold groundings
    Robustness(robustness::Arguments),
    /// Make one scene: furniture placed anew, or a whole new home
    Scene(scene::Arguments),
    /// Render frames of rooms furnished at random, with the truth, to train and test perception on
    Frames(frames::Arguments),
    /// Score detections against frames whose furniture is known
    Perception(perception::Arguments),
    /// Learn the furniture detector from such rooms
    Train(train::Arguments),
    /// Drive a corpus many times over: the paper's Tables II and III, ablations, and why it went wrong
    Behavior(behavior::Arguments),
}

/// What every subcommand can do.
trait Command {
    /// The shared options.
    fn common(&self) -> &Common;

    /// Whether it reads the files named.
    fn reads_files(&self) -> bool {
        true
    }

    /// Whether it waits for standard input when no file is named.
    fn reads_standard_input(&self) -> bool {
        false
    }

    /// Does the work.
    fn run(&self) -> Result<Exit, Failure>;
}

impl Arguments {
    fn command(&self) -> &dyn Command {
        match &self.what {
            What::Score(arguments) => arguments,
            What::Chunking(arguments) => arguments,
            What::Grounding(arguments) => arguments,
            What::Import(arguments) => arguments,
            What::Run(arguments) => arguments,
            What::Paper(arguments) => arguments,
            What::Blame(arguments) => arguments,
            What::Compare(arguments) => arguments,
            What::Counterfactual(arguments) => arguments,
            What::Merge(arguments) => arguments,
            What::Robustness(arguments) => arguments,
            What::Scene(arguments) => arguments,
            What::Frames(arguments) => arguments,
            What::Perception(arguments) => arguments,
            What::Train(arguments) => arguments,
            What::Behavior(arguments) => arguments,
        }
    }
}

impl Program for Arguments {
    const NAME: &'static str = "evaluate";
    fn common(&self) -> &Common {
        self.command().common()
    }
    fn schema() -> schemars::Schema {
        schemars::schema_for!(Scores)
    }
    fn reads_standard_input(&self) -> bool {
        self.command().reads_standard_input() && self.common().files.is_empty()
    }
    fn run(self) -> Result<Exit, Failure> {
        let (command, common) = (self.command(), self.common());
        if let Some(file) = common.files.first().filter(|_| !command.reads_files()) {
            let message = format!(
                "{}: this subcommand takes no FILE; what it reads is named by options, as --gold",
                file.display()
            );
            return Err(Failure::Usage(message));
        }
        if let Some(path) = &common.output {
            refuse_existing(path, common.force)?;
        }
        // Whatever it does, an interrupt ends it tidily.
        cli::on_interrupt(|| ());
        command.run()
    }
}

fn main() -> ExitCode {
    cli::main::<Arguments>()
}

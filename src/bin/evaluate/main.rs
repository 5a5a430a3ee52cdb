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

use clap::Parser;
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

#[derive(clap::Subcommand)]
enum What {
    /// Score records from files or standard input
    Score(With<score::Arguments>),
    /// Chunk corpora and score the trees
    Chunking(With<chunking::Arguments>),
    /// Ground corpora by both methods and score the meanings
    Grounding(With<grounding::Arguments>),
    /// Read the authors' public treebank and groundings into this project's format
    Import(With<import::Arguments>),
    /// Run a corpus end to end, from text to trial, and score it
    Run(With<run::Arguments>),
    /// Run the paper's three experiments: its figures beside ours
    Paper(With<paper::Arguments>),
    /// Charge each failed trial to the stage whose gold mends it
    Blame(With<blame::Arguments>),
    /// Compare two result files: fixed, broken, changed
    Compare(With<compare::Arguments>),
    /// Find the smallest changes of words and furniture that change the outcome
    #[command(name = "what-if")]
    Counterfactual(With<what_if::Arguments>),
    /// Add up the scores of the parts of a run
    Merge(With<merge::Arguments>),
    /// Moved furniture, other homes, and homes made for gold groundings
    Robustness(With<robustness::Arguments>),
    /// Make one scene: furniture placed anew, or a whole new home
    Scene(With<scene::Arguments>),
    /// Render frames of rooms furnished at random, with the truth, to train and test perception on
    Frames(With<frames::Arguments>),
    /// Score detections against frames whose furniture is known
    Perception(With<perception::Arguments>),
    /// Learn the furniture detector from such rooms
    Train(With<train::Arguments>),
    /// Drive a corpus many times over: the paper's Tables II and III, ablations, and why it went wrong
    Behavior(With<behavior::Arguments>),
}

/// What a subcommand reads.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Reads {
    /// Only what its options name.
    Options,
    /// The files named.
    Files,
    /// The same, or standard input when no file is named.
    FilesOrStandardInput,
}

/// A subcommand, by its own options.
trait Subcommand: clap::Args {
    /// What it reads.
    const READS: Reads = Reads::Files;

    /// The same, with these options.
    fn reads(&self) -> Reads {
        Self::READS
    }

    /// Does the work.
    fn run(&self, common: &Common) -> Result<Exit, Failure>;
}

/// A subcommand's own options and those that all share.
#[derive(clap::Args)]
struct With<A: Subcommand> {
    #[command(flatten)]
    own: A,
    #[command(flatten)]
    common: Common,
}

/// A subcommand with all its options.
trait Command {
    fn common(&self) -> &Common;
    fn reads(&self) -> Reads;
    fn run(&self) -> Result<Exit, Failure>;
}

impl<A: Subcommand> Command for With<A> {
    fn common(&self) -> &Common {
        &self.common
    }

    fn reads(&self) -> Reads {
        self.own.reads()
    }

    fn run(&self) -> Result<Exit, Failure> {
        self.own.run(&self.common)
    }
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
        self.command().reads() == Reads::FilesOrStandardInput && self.common().files.is_empty()
    }
    fn run(self) -> Result<Exit, Failure> {
        let (command, common) = (self.command(), self.common());
        if let Some(file) = common.files.first().filter(|_| command.reads() == Reads::Options) {
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

//! `evaluate chunking`: the chunker against gold trees.

use clap::Args;
use spatial_fetch::cli::{self, Common, Exit, Failure};
use spatial_fetch::evaluation::{chunking_table, score_chunking};

use crate::Subcommand;

/// FILEs are gold corpora; without one, the shipped templates and speech.
#[derive(Args)]
pub struct Arguments {}

impl Subcommand for Arguments {
    fn run(&self, common: &Common) -> Result<Exit, Failure> {
        let corpora = cli::load_corpora(&common.files)?;
        let scores: Vec<_> = corpora.iter().map(|(name, gold)| score_chunking(name, gold)).collect();
        let table = || scores.iter().map(chunking_table).collect::<Vec<_>>().join("\n\n");
        cli::write_report(common, &scores, table).map(|()| Exit::Done)
    }
}

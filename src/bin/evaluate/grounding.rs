//! `evaluate grounding`: both methods against gold meanings.

use std::collections::HashMap;
use std::path::PathBuf;

use clap::Args;
use spatial_fetch::cli::{self, Common, Exit, Failure};
use spatial_fetch::evaluation::{Experiment, evaluate_grounding, grounding_table};

use crate::Subcommand;

/// FILEs are gold corpora; without one, the shipped templates and speech.
#[derive(Args)]
pub struct Arguments {
    /// Corpus that has the texts of gold without them, by id
    #[arg(long, value_name = "FILE")]
    texts: Option<PathBuf>,
    /// Train the paper's method on this many random sets of 36, and ground the corpus by each
    #[arg(long, value_name = "N", default_value_t = 0)]
    splits: usize,
    /// Share of the words that a recogniser gets wrong
    #[arg(long, value_name = "P", default_value_t = 0.0, value_parser = share)]
    noise: f64,
    /// List every disagreement in the text table
    #[arg(long)]
    list: bool,
}

fn share(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| format!("`{text}` is no number"))?;
    if (0.0..=1.0).contains(&value) { Ok(value) } else { Err("a share lies from 0 to 1".to_string()) }
}

impl Subcommand for Arguments {
    fn run(&self, common: &Common) -> Result<Exit, Failure> {
        let mut corpora = cli::load_corpora(&common.files)?;
        if let Some(path) = &self.texts {
            let texts = cli::load_corpora(std::slice::from_ref(path))?;
            let texts: HashMap<_, _> = texts.into_iter().flat_map(|(_, gold)| gold).map(|g| (g.id, g.text)).collect();
            let bare = corpora.iter_mut().flat_map(|(_, gold)| gold).filter(|gold| gold.text.is_empty());
            bare.for_each(|gold| gold.text = texts.get(&gold.id).cloned().unwrap_or_default());
        }
        let experiment = Experiment { splits: self.splits, noise: self.noise, seed: common.seed };
        let scores = corpora.iter().map(|(name, gold)| evaluate_grounding(name, gold, &experiment));
        let scores: Vec<_> = scores.collect::<Result<_, _>>().map_err(Failure::Failed)?;
        let table = || scores.iter().map(|s| grounding_table(s, self.list)).collect::<Vec<_>>().join("\n\n");
        cli::write_report(common, &scores, table).map(|()| Exit::Done)
    }
}

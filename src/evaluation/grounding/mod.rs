//! Grounding against gold: from plain text and from gold trees, by both methods, in every variant, and with noise.

mod counts;
mod noise;
mod splits;
mod table;
mod trees;

use std::collections::BTreeMap;
use std::sync::Arc;

use rayon::prelude::*;
use serde::Serialize;

use super::Gold;
use crate::grounding::paper::{Model, Options};
use crate::grounding::{Grounder, Method};
use crate::language::chunk_text;
use crate::record::Grounding;

pub use counts::{Bin, Disagreement, MeaningRates, judge, said_side};
pub use noise::{Kept, Noise, misheard};
pub use splits::{SplitScores, Spread};
pub use table::grounding_table;
pub use trees::TreeRates;

/// What to run on a corpus.
#[derive(Clone, Debug, Default)]
pub struct Experiment {
    /// Random training sets for the paper's method; none when 0.
    pub splits: usize,
    /// Share of words a recogniser gets wrong; none when 0.
    pub noise: f64,
    /// Seed of everything random.
    pub seed: u64,
}

/// The scores of one corpus.
#[derive(Clone, Debug, Default, Serialize)]
pub struct GroundingScores {
    /// What was read.
    pub corpus: String,
    /// Descriptions with labels.
    pub descriptions: usize,
    /// From plain text, by method.
    pub from_text: BTreeMap<&'static str, MeaningRates>,
    /// From gold trees, by method.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub from_gold_trees: BTreeMap<&'static str, TreeRates>,
    /// `composed` from plain text, by "how" and "where".
    pub by_form: BTreeMap<&'static str, MeaningRates>,
    /// `composed` from plain text, by the furniture named.
    pub by_names: BTreeMap<&'static str, MeaningRates>,
    /// `paper` from gold trees, trained on random choices, each variant.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub splits: Vec<SplitScores>,
    /// `composed` from what a recogniser makes of the text.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub noise: Option<Noise>,
    /// Scores held against what they promise: in each bin of scores, how many commands were right.
    pub calibration: Vec<counts::Bin>,
    /// Where `composed` from plain text and gold differ.
    pub disagreements: Vec<Disagreement>,
}

/// Runs the experiments on the descriptions of `gold` that are labelled.
///
/// # Errors
/// When a labelled description has no text.
pub fn evaluate_grounding(corpus: &str, gold: &[Gold], experiment: &Experiment) -> Result<GroundingScores, String> {
    let gold: Vec<&Gold> = gold.iter().filter(|gold| gold.is_labelled()).collect();
    if let Some(bare) = gold.iter().find(|gold| gold.text.is_empty()) {
        return Err(format!("{corpus}: record \"{}\" has no text; name the file that has it with --texts", bare.id));
    }
    let model = Arc::new(Model::embedded(Options::default()));
    let composed = Grounder::new(Method::Composed, true);
    let paper = Grounder::new(Method::Paper(model), true);
    let mut scores =
        GroundingScores { corpus: corpus.to_string(), descriptions: gold.len(), ..GroundingScores::default() };
    let understood = from_text(&composed, &gold);
    for (gold, grounding) in gold.iter().zip(&understood) {
        scores.count(gold, grounding);
    }
    scores.from_text.insert("paper", counts::rates(&gold, &from_text(&paper, &gold)));
    let labelled: Vec<&Gold> = gold.iter().copied().filter(|gold| trees::is_labelled(gold)).collect();
    if !labelled.is_empty() {
        scores.from_gold_trees.insert("composed", trees::rates(&composed, &labelled));
        scores.from_gold_trees.insert("paper", trees::rates(&paper, &labelled));
    }
    if experiment.splits > 0 {
        scores.splits = splits::score(corpus, &labelled, experiment.splits, experiment.seed)?;
    }
    if experiment.noise > 0.0 {
        scores.noise = Some(noise::score(&composed, &gold, &understood, experiment));
    }
    Ok(scores)
}

fn from_text(grounder: &Grounder, gold: &[&Gold]) -> Vec<Grounding> {
    gold.par_iter().map(|gold| understand(grounder, &gold.text)).collect()
}

fn understand(grounder: &Grounder, text: &str) -> Grounding {
    let (tokens, chunks) = chunk_text(text);
    grounder.ground(text, &tokens, &chunks)
}

impl GroundingScores {
    fn count(&mut self, gold: &Gold, grounding: &Grounding) {
        let verdict = counts::judge(gold, grounding);
        self.from_text.entry("composed").or_default().add(&verdict);
        if !gold.brackets.is_empty() {
            self.by_form.entry(gold.form()).or_default().add(&verdict);
            self.by_names.entry(gold.names()).or_default().add(&verdict);
        }
        counts::add_to_bins(&mut self.calibration, grounding.score.0, verdict.command());
        self.disagreements.extend(verdict.disagreement(gold, grounding));
    }
}

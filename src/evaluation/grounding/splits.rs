//! The paper's experiment: train on 36 descriptions, six for each of six objects, ground all of them.

use std::collections::BTreeMap;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;
use serde::Serialize;

use super::super::Gold;
use crate::grounding::paper::{Distance, Factors, LabelledTree, Model, Options};
use crate::record::Rounded;

/// Descriptions of each object in a training set.
const OF_EACH: usize = 6;

/// Mean, smallest and largest of several values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Spread {
    /// Mean.
    pub mean: Rounded,
    /// Smallest.
    pub min: Rounded,
    /// Largest.
    pub max: Rounded,
}

/// The rates of one variant over all random training sets.
#[derive(Clone, Debug, Default, Serialize)]
pub struct SplitScores {
    /// Which factors of the product.
    pub factors: Factors,
    /// Which distance.
    pub distance: Distance,
    /// Training sets.
    pub splits: usize,
    /// Descriptions in each training set.
    pub trained_on: usize,
    /// Descriptions grounded.
    pub tested_on: usize,
    /// Share of chunks right.
    pub chunks: Spread,
    /// Share of descriptions with all chunks right.
    pub commands: Spread,
}

/// Every variant over `splits` random training sets; the same sets for each variant.
pub(super) fn score(corpus: &str, gold: &[&Gold], splits: usize, seed: u64) -> Result<Vec<SplitScores>, String> {
    let mut by_object: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (i, gold) in gold.iter().enumerate() {
        by_object.entry(gold.object.as_deref().unwrap_or("")).or_default().push(i);
    }
    by_object.retain(|object, members| !object.is_empty() && members.len() >= OF_EACH);
    if by_object.is_empty() {
        return Err(format!(
            "{corpus}: --splits needs labelled trees with an object that {OF_EACH} or more descriptions name"
        ));
    }
    let trees: Vec<LabelledTree> = gold.iter().map(|gold| tree_of(gold)).collect();
    let sets: Vec<Vec<usize>> = (0..splits).map(|split| training_set(&by_object, seed, split)).collect();
    let variants = [Factors::Similarity, Factors::Prior, Factors::All]
        .into_iter()
        .flat_map(|factors| [Distance::Plain, Distance::Weighted].map(|distance| Options { factors, distance }));
    Ok(variants.map(|options| score_variant(&trees, &sets, options)).collect())
}

fn tree_of(gold: &Gold) -> LabelledTree {
    let mut tree = LabelledTree::unlabelled(&gold.text, &gold.tokens, &gold.chunks);
    tree.chunks.iter_mut().zip(&gold.labels).for_each(|(chunk, label)| chunk.label = label.clone());
    tree
}

/// Six descriptions of each object, drawn without putting back.
fn training_set(by_object: &BTreeMap<&str, Vec<usize>>, seed: u64, split: usize) -> Vec<usize> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(split as u64);
    let mut chosen = Vec::new();
    for members in by_object.values() {
        let mut left = members.clone();
        for _ in 0..OF_EACH {
            let at = random.next_u64() % left.len() as u64;
            chosen.push(left.swap_remove(at as usize));
        }
    }
    chosen.sort_unstable();
    chosen
}

fn score_variant(trees: &[LabelledTree], sets: &[Vec<usize>], options: Options) -> SplitScores {
    let rates: Vec<(f64, f64)> = sets.par_iter().map(|set| rates_of(trees, set, options)).collect();
    SplitScores {
        factors: options.factors,
        distance: options.distance,
        splits: sets.len(),
        trained_on: sets.first().map_or(0, Vec::len),
        tested_on: trees.len(),
        chunks: spread(rates.iter().map(|(chunks, _)| *chunks)),
        commands: spread(rates.iter().map(|(_, commands)| *commands)),
    }
}

/// Share of chunks and of whole descriptions right.
fn rates_of(trees: &[LabelledTree], set: &[usize], options: Options) -> (f64, f64) {
    let training: Vec<LabelledTree> = set.iter().map(|&i| trees[i].clone()).collect();
    let model = Model::train(&training, options);
    let (mut chunks, mut right, mut commands) = (0, 0, 0);
    for tree in trees {
        let labels = model.labels(tree);
        let hits = tree.chunks.iter().zip(&labels).filter(|(chunk, label)| chunk.label == **label).count();
        chunks += labels.len();
        right += hits;
        commands += usize::from(hits == labels.len());
    }
    (right as f64 / chunks.max(1) as f64, commands as f64 / trees.len().max(1) as f64)
}

fn spread(values: impl Iterator<Item = f64> + Clone) -> Spread {
    let count = values.clone().count().max(1) as f64;
    Spread {
        mean: Rounded(values.clone().sum::<f64>() / count),
        min: Rounded(values.clone().fold(f64::INFINITY, f64::min)),
        max: Rounded(values.fold(f64::NEG_INFINITY, f64::max)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_training_set_has_six_different_ones_of_each_and_depends_on_the_seed() {
        let by_object = BTreeMap::from([("mug", (0..20).collect::<Vec<_>>()), ("fork", (20..40).collect())]);
        let set = training_set(&by_object, 1, 0);
        let mut unique = set.clone();
        unique.dedup();
        assert_eq!((set.len(), unique.len()), (12, 12));
        assert_eq!(set.iter().filter(|&&i| i < 20).count(), 6);
        assert_eq!(set, training_set(&by_object, 1, 0));
        assert_ne!(set, training_set(&by_object, 1, 1));
    }

    #[test]
    fn the_spread_of_values() {
        let spread = spread([0.5, 1.0].into_iter());
        assert_eq!((spread.mean.0, spread.min.0, spread.max.0), (0.75, 0.5, 1.0));
    }
}

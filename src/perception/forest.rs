//! A small random forest: extremely randomised trees (Geurts, Ernst & Wehenkel 2006) over dense features.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;

/// A node's feature when it is a leaf.
const LEAF: u8 = u8::MAX;

/// Trees that vote with class frequencies.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Forest {
    /// Classes.
    pub classes: usize,
    /// Votes are raised to this power, which makes them calibrated probabilities.
    pub sharpness: f32,
    trees: Vec<Tree>,
}

#[derive(Clone, Debug, Default, PartialEq)]
struct Tree {
    nodes: Vec<Node>,
    /// Class frequencies of each leaf, of 255.
    leaves: Vec<u8>,
}

/// Left below the threshold; the right child follows the left one. In a leaf `next` counts leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Node {
    feature: u8,
    threshold: f32,
    next: u16,
}

/// One example to learn from.
#[derive(Clone, Debug)]
pub struct Example {
    /// Its features.
    pub features: Vec<f32>,
    /// Its class.
    pub class: usize,
    /// What it counts.
    pub weight: f32,
}

/// How a forest is grown.
#[derive(Clone, Copy, Debug)]
pub struct Growth {
    /// Trees.
    pub trees: usize,
    /// Splits from root to leaf.
    pub depth: usize,
    /// Examples in a leaf, at least.
    pub leaf: usize,
    /// Random stream.
    pub seed: u64,
}

impl Forest {
    /// Probability of each class.
    pub fn probabilities(&self, features: &[f32]) -> Vec<f32> {
        let mut votes = vec![0_u32; self.classes];
        let mut vote = |tree: &Tree, leaf: usize| {
            let leaf = leaf * self.classes;
            votes.iter_mut().zip(&tree.leaves[leaf..leaf + self.classes]).for_each(|(v, f)| *v += u32::from(*f));
        };
        let (groups, rest) = self.trees.as_chunks();
        for trees in groups {
            trees.iter().zip(leaves(trees, features)).for_each(|(tree, leaf)| vote(tree, leaf));
        }
        rest.iter().for_each(|tree| vote(tree, tree.leaf(features)));
        sharpened(&votes, self.trees.len(), self.sharpness)
    }

    /// Grows a forest and calibrates it on the examples each tree did not see; the same examples give the same forest.
    pub fn grow(examples: &[Example], classes: usize, growth: Growth) -> Self {
        let grown: Vec<(Tree, Vec<bool>)> =
            (0..growth.trees).into_par_iter().map(|i| grow_tree(examples, classes, growth, i as u64)).collect();
        let mut forest = Self { classes, sharpness: 1.0, trees: Vec::new() };
        let mut votes = vec![vec![0_u32; classes]; examples.len()];
        for (tree, seen) in &grown {
            for (i, example) in examples.iter().enumerate().filter(|(i, _)| !seen[*i]) {
                let leaf = tree.leaf(&example.features) * classes;
                (0..classes).for_each(|c| votes[i][c] += u32::from(tree.leaves[leaf + c]));
            }
        }
        forest.trees = grown.into_iter().map(|(tree, _)| tree).collect();
        let loss = |sharpness: f32| {
            let voters = growth.trees / 3;
            let of =
                |(v, e): (&Vec<u32>, &Example)| -f64::from(sharpened(v, voters, sharpness)[e.class].ln() * e.weight);
            votes.iter().zip(examples).map(of).sum::<f64>()
        };
        let candidates = (4..=20).map(|i| i as f32 * 0.15);
        forest.sharpness = candidates.min_by(|a, b| loss(*a).total_cmp(&loss(*b))).unwrap_or(1.0);
        forest
    }

    /// Appends the forest's bytes.
    pub fn write(&self, bytes: &mut Vec<u8>) {
        bytes.extend((self.classes as u16).to_le_bytes());
        bytes.extend(self.sharpness.to_le_bytes());
        bytes.extend((self.trees.len() as u16).to_le_bytes());
        for tree in &self.trees {
            bytes.extend((tree.nodes.len() as u16).to_le_bytes());
            for node in &tree.nodes {
                bytes.push(node.feature);
                if node.feature != LEAF {
                    bytes.extend(node.threshold.to_le_bytes());
                }
                bytes.extend(node.next.to_le_bytes());
            }
            bytes.extend((tree.leaves.len() as u32).to_le_bytes());
            bytes.extend(&tree.leaves);
        }
    }

    /// Reads a forest; nothing when the bytes are no forest.
    pub fn read(bytes: &mut &[u8]) -> Option<Self> {
        let classes = usize::from(u16::from_le_bytes(take(bytes)?));
        let sharpness = f32::from_le_bytes(take(bytes)?);
        let trees = u16::from_le_bytes(take(bytes)?);
        let trees: Option<Vec<Tree>> = (0..trees).map(|_| Tree::read(bytes, classes)).collect();
        Some(Self { classes, sharpness, trees: trees? })
    }
}

/// The leaf of each of a few trees. They are gone down side by side: one alone waits at every node for the last.
fn leaves(trees: &[Tree; 8], features: &[f32]) -> [usize; 8] {
    let mut at = [0; 8];
    loop {
        let mut deeper = false;
        for (at, tree) in at.iter_mut().zip(trees) {
            let node = tree.nodes[*at];
            let is_inner = node.feature != LEAF;
            // In a leaf there is no such feature, and what is reckoned goes unused.
            let value = features.get(usize::from(node.feature)).copied().unwrap_or_default();
            let next = usize::from(node.next) + usize::from(value >= node.threshold);
            *at = if is_inner { next } else { *at };
            deeper |= is_inner;
        }
        if !deeper {
            return std::array::from_fn(|i| usize::from(trees[i].nodes[at[i]].next));
        }
    }
}

/// Probabilities from the votes of some trees.
fn sharpened(votes: &[u32], trees: usize, sharpness: f32) -> Vec<f32> {
    // A class no tree voted for stays possible.
    let floor = 0.4 * trees as f32;
    let all = 255.0 * trees.max(1) as f32;
    let sharp: Vec<f32> = votes.iter().map(|v| ((*v as f32 + floor) / all).powf(sharpness)).collect();
    let sum: f32 = sharp.iter().sum();
    sharp.iter().map(|v| v / sum.max(f32::MIN_POSITIVE)).collect()
}

/// The next bytes.
pub fn take<const N: usize>(bytes: &mut &[u8]) -> Option<[u8; N]> {
    let (first, rest) = bytes.split_first_chunk::<N>()?;
    *bytes = rest;
    Some(*first)
}

impl Tree {
    fn leaf(&self, features: &[f32]) -> usize {
        let mut at = 0;
        loop {
            let node = self.nodes[at];
            if node.feature == LEAF {
                return usize::from(node.next);
            }
            at = usize::from(node.next) + usize::from(features[usize::from(node.feature)] >= node.threshold);
        }
    }

    /// Children lie behind their parents, so that no walk can run in a circle.
    fn read(bytes: &mut &[u8], classes: usize) -> Option<Self> {
        let count = usize::from(u16::from_le_bytes(take(bytes)?));
        let mut tree = Self::default();
        let mut most_leaf = 0;
        for at in 0..count {
            let [feature] = take(bytes)?;
            let threshold = if feature == LEAF { 0.0 } else { f32::from_le_bytes(take(bytes)?) };
            let next = u16::from_le_bytes(take(bytes)?);
            if feature == LEAF {
                most_leaf = most_leaf.max(usize::from(next) + 1);
            } else if usize::from(next) <= at || usize::from(next) + 1 >= count {
                return None;
            }
            tree.nodes.push(Node { feature, threshold, next });
        }
        let length = u32::from_le_bytes(take(bytes)?) as usize;
        let (leaves, rest) = bytes.split_at_checked(length)?;
        *bytes = rest;
        tree.leaves = leaves.to_vec();
        (count > 0 && most_leaf * classes <= length).then_some(tree)
    }
}

/// One tree over two thirds of the examples, and which those were.
fn grow_tree(examples: &[Example], classes: usize, growth: Growth, number: u64) -> (Tree, Vec<bool>) {
    let mut rng = ChaCha8Rng::seed_from_u64(growth.seed);
    rng.set_stream(number);
    let seen: Vec<bool> = examples.iter().map(|_| !rng.next_u32().is_multiple_of(3)).collect();
    let chosen: Vec<u32> = (0..examples.len() as u32).filter(|i| seen[*i as usize]).collect();
    let mut grower = Grower { examples, classes, growth, rng, tree: Tree::default() };
    grower.tree.nodes.push(Node { feature: LEAF, threshold: 0.0, next: 0 });
    let mut waiting = vec![(0_usize, chosen, 0_usize)];
    while let Some((at, members, depth)) = waiting.pop() {
        match grower.split(&members, depth) {
            Some((feature, threshold)) if grower.tree.nodes.len() + 2 < usize::from(u16::MAX) => {
                let next = grower.tree.nodes.len();
                grower.tree.nodes[at] = Node { feature: feature as u8, threshold, next: next as u16 };
                grower.tree.nodes.extend([Node { feature: LEAF, threshold: 0.0, next: 0 }; 2]);
                let right = |i: &u32| examples[*i as usize].features[feature] >= threshold;
                let (right, left): (Vec<u32>, Vec<u32>) = members.into_iter().partition(right);
                waiting.push((next, left, depth + 1));
                waiting.push((next + 1, right, depth + 1));
            }
            _ => grower.close(at, &members),
        }
    }
    (grower.tree, seen)
}

struct Grower<'a> {
    examples: &'a [Example],
    classes: usize,
    growth: Growth,
    rng: ChaCha8Rng,
    tree: Tree,
}

impl Grower<'_> {
    fn below(&mut self, count: usize) -> usize {
        (self.rng.next_u64() % count as u64) as usize
    }

    /// Class weights of some examples.
    fn weights<'i>(&self, members: impl Iterator<Item = &'i u32>) -> Vec<f64> {
        let mut weights = vec![0.0; self.classes];
        for example in members.map(|i| &self.examples[*i as usize]) {
            weights[example.class] += f64::from(example.weight);
        }
        weights
    }

    fn close(&mut self, at: usize, members: &[u32]) {
        let weights = self.weights(members.iter());
        let sum: f64 = weights.iter().sum::<f64>().max(1e-12);
        self.tree.nodes[at].next = (self.tree.leaves.len() / self.classes) as u16;
        self.tree.leaves.extend(weights.iter().map(|w| (w / sum * 255.0).round() as u8));
    }

    /// The best of some random splits, by Gini impurity; nothing when the node is pure, small or deep.
    fn split(&mut self, members: &[u32], depth: usize) -> Option<(usize, f32)> {
        const THRESHOLDS: usize = 10;
        let whole = self.weights(members.iter());
        let pure = whole.iter().filter(|w| **w > 0.0).count() < 2;
        if depth >= self.growth.depth || members.len() < 2 * self.growth.leaf || pure {
            return None;
        }
        let features = self.examples[members[0] as usize].features.len();
        let tried = ((features as f64).sqrt() * 1.5).ceil() as usize;
        let mut best: Option<(f64, usize, f32)> = None;
        for _ in 0..tried {
            let feature = self.below(features);
            let mut thresholds: Vec<f32> = (0..THRESHOLDS)
                .map(|_| self.examples[members[self.below(members.len())] as usize].features[feature])
                .collect();
            thresholds.sort_by(f32::total_cmp);
            thresholds.dedup();
            for (impurity, threshold) in self.impurities(members, feature, &thresholds) {
                if best.is_none_or(|b| impurity < b.0) {
                    best = Some((impurity, feature, threshold));
                }
            }
        }
        best.map(|(_, feature, threshold)| (feature, threshold))
    }

    /// Impurity of the split at each threshold that leaves enough on both sides.
    fn impurities(&self, members: &[u32], feature: usize, thresholds: &[f32]) -> Vec<(f64, f32)> {
        // Class weights and counts between one threshold and the next.
        let bins = thresholds.len() + 1;
        let (mut weights, mut counts) = (vec![0.0; bins * self.classes], vec![0_usize; bins]);
        for example in members.iter().map(|i| &self.examples[*i as usize]) {
            let bin = thresholds.partition_point(|t| *t <= example.features[feature]);
            weights[bin * self.classes + example.class] += f64::from(example.weight);
            counts[bin] += 1;
        }
        let gini = |weights: &[f64]| {
            let sum: f64 = weights.iter().sum();
            sum - weights.iter().map(|w| w * w).sum::<f64>() / sum.max(1e-12)
        };
        let mut right: Vec<f64> =
            (0..self.classes).map(|c| (0..bins).map(|b| weights[b * self.classes + c]).sum()).collect();
        let mut left = vec![0.0; self.classes];
        let mut on_left = 0;
        let mut found = Vec::new();
        for (bin, threshold) in thresholds.iter().enumerate() {
            for c in 0..self.classes {
                left[c] += weights[bin * self.classes + c];
                right[c] -= weights[bin * self.classes + c];
            }
            on_left += counts[bin];
            if on_left >= self.growth.leaf && members.len() - on_left >= self.growth.leaf {
                found.push((gini(&left) + gini(&right), *threshold));
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Class 1 inside a ring, else class 0.
    fn examples() -> Vec<Example> {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let mut unit = || rng.next_u32() as f32 / u32::MAX as f32 * 2.0 - 1.0;
        let point = |_| {
            let (x, y, idle) = (unit(), unit(), unit());
            Example { features: vec![x, y, idle], class: usize::from(x.hypot(y) < 0.7), weight: 1.0 }
        };
        (0..1500).map(point).collect()
    }

    const GROWTH: Growth = Growth { trees: 15, depth: 10, leaf: 3, seed: 3 };

    #[test]
    fn a_ring_is_learned_and_survives_writing_and_reading() {
        let forest = Forest::grow(&examples(), 2, GROWTH);
        assert!(forest.probabilities(&[0.1, 0.1, 0.0])[1] > 0.9);
        assert!(forest.probabilities(&[0.9, 0.8, 0.0])[0] > 0.9);
        let mut bytes = Vec::new();
        forest.write(&mut bytes);
        assert_eq!(Forest::read(&mut bytes.as_slice()), Some(forest));
    }

    #[test]
    fn the_same_examples_grow_the_same_forest() {
        assert_eq!(Forest::grow(&examples(), 2, GROWTH), Forest::grow(&examples(), 2, GROWTH));
    }

    #[test]
    fn cut_bytes_are_no_forest() {
        let mut bytes = Vec::new();
        Forest::grow(&examples(), 2, GROWTH).write(&mut bytes);
        assert_eq!(Forest::read(&mut &bytes[..bytes.len() - 3]), None);
    }

    #[test]
    fn trees_gone_down_side_by_side_end_in_the_leaves_they_end_in_alone() {
        let example = |i: u32| {
            let value = |k: u32| (i.wrapping_mul(k) >> 20) as f32 / 4096.0;
            let features = vec![value(0x9E37_79B1), value(0x85EB_CA77), value(0xC2B2_AE35)];
            Example { class: usize::from(features[0] > features[1]), features, weight: 1.0 }
        };
        let examples: Vec<Example> = (0..400).map(example).collect();
        let forest = Forest::grow(&examples, 2, Growth { trees: 8, depth: 9, leaf: 2, seed: 5 });
        let trees: &[Tree; 8] = forest.trees.first_chunk().expect("eight trees");
        for example in &examples {
            assert_eq!(
                leaves(trees, &example.features),
                [0, 1, 2, 3, 4, 5, 6, 7].map(|i| trees[i].leaf(&example.features))
            );
        }
    }
}

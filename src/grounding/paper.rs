//! The published grounding (Huo et al. 2014, section IV; equations 1 and 2): the nearest labelled example decides.
//!
//! Similarity is one less the weighted Levenshtein distance over words,
//! divided by the longer length. Of the published factors only similarity is
//! used here: taken literally, the priors P(g | tag) drown rarer groundings.

use std::collections::HashMap;

use super::meaning::Meaning;
use super::words::ChunkWords;
use crate::record::Tag;

/// What a stop word or a word never seen in training weighs.
const LIGHT: f64 = 0.01;
const STOP_WORDS: [&str; 11] = ["will", "to", "the", "on", "of", "is", "in", "'ll", "be", "a", "at"];

/// A chunk with its label, to learn from.
#[derive(Clone, Debug)]
pub struct Example {
    /// The kind of phrase.
    pub tag: Tag,
    /// The chunk's own words in lower case.
    pub words: Vec<String>,
    /// What they mean.
    pub meaning: Meaning,
}

/// Labelled examples with the weights of their words.
#[derive(Clone, Debug, Default)]
pub struct Model {
    examples: Vec<Example>,
    /// Share of the examples of a tag and grounding in which a word stands.
    weights: HashMap<(Tag, String, String), f64>,
    weighted: bool,
}

impl Model {
    /// A model of these examples; `weighted` uses word weights, else every word weighs one.
    pub fn train(examples: Vec<Example>, weighted: bool) -> Self {
        let mut totals: HashMap<(Tag, String), f64> = HashMap::new();
        let mut counts: HashMap<(Tag, String, String), f64> = HashMap::new();
        for example in &examples {
            let label = label(&example.meaning);
            *totals.entry((example.tag, label.clone())).or_default() += 1.0;
            let mut words = example.words.clone();
            words.sort_unstable();
            words.dedup();
            for word in words {
                *counts.entry((example.tag, label.clone(), word)).or_default() += 1.0;
            }
        }
        for ((tag, label, _), count) in &mut counts {
            *count /= totals[&(*tag, label.clone())];
        }
        Self { examples, weights: counts, weighted }
    }

    /// The meaning of each chunk.
    pub fn meanings(&self, chunks: &[ChunkWords]) -> Vec<Meaning> {
        chunks.iter().map(|chunk| self.meaning(chunk)).collect()
    }

    fn meaning(&self, chunk: &ChunkWords) -> Meaning {
        let words: Vec<&str> = chunk.words.iter().map(|word| word.lower.as_ref()).collect();
        let mut best: Option<(f64, &Example)> = None;
        for example in self.examples.iter().filter(|example| example.tag == chunk.tag) {
            let similarity = self.similarity(&words, example);
            if best.is_none_or(|(known, _)| similarity > known) {
                best = Some((similarity, example));
            }
        }
        let Some((similarity, example)) = best else {
            return Meaning {
                because: format!("no example of {} to learn from", chunk.tag.name()),
                ..Meaning::default()
            };
        };
        let because = format!("like \"{}\" ({similarity:.2})", example.words.join(" "));
        Meaning { score: similarity, because, ..example.meaning.clone() }
    }

    fn similarity(&self, words: &[&str], example: &Example) -> f64 {
        let label = label(&example.meaning);
        let weight = |word: &str| {
            if !self.weighted {
                return 1.0;
            }
            if STOP_WORDS.contains(&word) {
                return LIGHT;
            }
            self.weights.get(&(example.tag, label.clone(), word.to_string())).copied().unwrap_or(LIGHT)
        };
        let other: Vec<&str> = example.words.iter().map(String::as_str).collect();
        1.0 - weighted_distance(words, &other, weight)
    }
}

/// What tells one grounding from another.
fn label(meaning: &Meaning) -> String {
    let pairs: Vec<String> =
        meaning.pairs.iter().map(|pair| format!("{}/{}", pair.reference, pair.direction.name())).collect();
    format!("{:?} {:?} {:?} {:?} {pairs:?}", meaning.room, meaning.side, meaning.object, meaning.target)
}

/// Levenshtein distance over words: a substitution costs the heavier word, an insertion or deletion the word's
/// weight; divided by the longer length, so that it lies in 0 to 1 for weights up to one.
pub fn weighted_distance(a: &[&str], b: &[&str], weight: impl Fn(&str) -> f64) -> f64 {
    let longer = a.len().max(b.len());
    if longer == 0 {
        return 0.0;
    }
    let mut row: Vec<f64> = std::iter::once(0.0)
        .chain(b.iter().scan(0.0, |sum, word| {
            *sum += weight(word);
            Some(*sum)
        }))
        .collect();
    for word in a {
        let mut diagonal = row[0];
        row[0] += weight(word);
        for (j, other) in b.iter().enumerate() {
            let substitute = diagonal + if word == other { 0.0 } else { weight(word).max(weight(other)) };
            diagonal = row[j + 1];
            row[j + 1] = substitute.min(row[j + 1] + weight(word)).min(row[j] + weight(other));
        }
    }
    row[b.len()] / longer as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn with_all_weights_one_it_is_strsims_levenshtein() {
        let (a, b) = (["go", "to", "the", "left", "wall"], ["go", "left", "then", "wall"]);
        let plain = strsim::generic_levenshtein(&a, &b) as f64;
        assert!((weighted_distance(&a, &b, |_| 1.0) - plain / 5.0).abs() < 1e-12);
    }

    #[test]
    fn light_words_hardly_count() {
        let weight = |word: &str| if word == "the" { LIGHT } else { 1.0 };
        assert!(weighted_distance(&["on", "the", "right"], &["on", "right"], weight) < 0.01);
    }
}

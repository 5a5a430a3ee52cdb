//! Training and the two argmax steps.

use std::collections::{BTreeMap, HashMap, HashSet};

use serde::{Deserialize, Serialize};

use super::distance::weighted_distance;
use super::example::{Label, LabelledChunk, LabelledTree};
use crate::grounding::meaning::{Kind, Meaning};
use crate::record::Direction;

/// What a stop word, or a word never seen with a grounding, weighs.
const LIGHT: f64 = 0.01;
/// Words that tell nothing (the authors' list).
const STOP_WORDS: [&str; 11] = ["will", "to", "the", "on", "of", "is", "in", "'ll", "be", "a", "at"];
/// Version of the model file.
const VERSION: u32 = 1;

/// Which factors of the published product are used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "snake_case")]
pub enum Factors {
    /// S alone: what reproduces the published rate.
    #[default]
    Similarity,
    /// S · P(g | tag).
    Prior,
    /// S · P(g | tag) · P(g | parent) · P(g | children).
    All,
}

/// How heavy words are in the distance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "snake_case")]
pub enum Distance {
    /// Every word weighs one: Levenshtein's distance.
    #[default]
    Plain,
    /// A word weighs its share of the training chunks with the same tag and grounding.
    Weighted,
}

/// A variant of the method.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Options {
    /// The factors used.
    pub factors: Factors,
    /// The distance used.
    pub distance: Distance,
}

/// Labelled chunks, and how to compare with them.
#[derive(Clone, Debug, Default)]
pub struct Model {
    options: Options,
    examples: Vec<LabelledChunk>,
    kinds: Vec<Kind>,
    /// Weight of each word of each example, by the example's tag and label.
    shares: HashMap<usize, HashMap<String, f64>>,
    group_of: Vec<usize>,
}

/// A model file that cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum ModelError {
    /// No JSON of the right shape.
    #[error("not a model file: {0}; make one with `ground --train FILE -o model.json`")]
    Malformed(#[from] serde_json::Error),
    /// A version this program does not know.
    #[error("model version {0} is not known to this program, which reads version 1; train it again")]
    Version(u32),
}

#[derive(Serialize, Deserialize)]
struct ModelFile {
    version: u32,
    #[serde(flatten)]
    options: Options,
    examples: Vec<LabelledChunk>,
}

/// The best value of a slot, how similar, and the example it came from.
struct Choice<V> {
    value: V,
    score: f64,
    example: usize,
}

impl Model {
    /// Learns from labelled trees, any number of them.
    pub fn train(trees: &[LabelledTree], options: Options) -> Self {
        Self::of_examples(trees.iter().flat_map(|tree| tree.chunks.iter().cloned()).collect(), options)
    }

    /// The model trained on the descriptions this program ships, with the default options.
    pub fn embedded(options: Options) -> Self {
        let lines = include_str!("../../../corpus/training/descriptions.jsonl").lines();
        let trees = lines.filter_map(|line| crate::record::Record::parse(line).ok());
        let trees: Vec<LabelledTree> = trees.filter_map(|record| LabelledTree::from_record(&record).ok()).collect();
        Self::train(&trees, options)
    }

    fn of_examples(examples: Vec<LabelledChunk>, options: Options) -> Self {
        let mut groups: BTreeMap<(crate::record::Tag, Label), Vec<usize>> = BTreeMap::new();
        for (i, example) in examples.iter().enumerate() {
            groups.entry((example.tag, example.label.clone())).or_default().push(i);
        }
        let mut group_of = vec![0; examples.len()];
        let mut shares = HashMap::new();
        for (group, members) in groups.values().enumerate() {
            shares.insert(group, word_shares(&examples, members));
            members.iter().for_each(|&member| group_of[member] = group);
        }
        let kinds = examples.iter().map(|example| example.label.kind(example.tag)).collect();
        Self { options, examples, kinds, shares, group_of }
    }

    /// The model as JSON.
    ///
    /// # Errors
    /// When it cannot be written as JSON, which does not happen to a model of finite numbers.
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        let examples = self.examples.clone();
        serde_json::to_string(&ModelFile { version: VERSION, options: self.options, examples })
    }

    /// A model from its JSON.
    ///
    /// # Errors
    /// When the text is no model, or one of another version.
    pub fn from_json(text: &str) -> Result<Self, ModelError> {
        let file: ModelFile = serde_json::from_str(text)?;
        if file.version != VERSION {
            return Err(ModelError::Version(file.version));
        }
        Ok(Self::of_examples(file.examples, file.options))
    }

    /// The variant.
    pub fn options(&self) -> Options {
        self.options
    }

    /// The same examples read by another variant.
    pub fn with_options(mut self, options: Options) -> Self {
        self.options = options;
        self
    }

    /// The label of each chunk of a tree; the labels the tree has are not looked at.
    pub fn labels(&self, tree: &LabelledTree) -> Vec<Label> {
        tree.chunks.iter().map(|chunk| self.label(chunk).0).collect()
    }

    /// The meaning of each chunk, with the reasons.
    pub fn meanings(&self, tree: &LabelledTree) -> Vec<Meaning> {
        let meaning = |chunk: &LabelledChunk| {
            let (label, kind, score, because) = self.label(chunk);
            Meaning { kind: Some(kind), ..label.meaning(score, because) }
        };
        tree.chunks.iter().map(meaning).collect()
    }

    /// Both steps for one chunk.
    fn label(&self, chunk: &LabelledChunk) -> (Label, Kind, f64, String) {
        let near = self.similarities(chunk);
        if near.is_empty() {
            let because = format!("no example of {} to learn from", chunk.tag.name());
            return (Label::default(), Label::default().kind(chunk.tag), 0.0, because);
        }
        let kind = self.choose(chunk, &near, |i| self.kinds[i]);
        let within: Vec<(usize, f64)> = near.iter().copied().filter(|(i, _)| self.kinds[*i] == kind.value).collect();
        let label = |i: usize| &self.examples[i].label;
        let room = self.choose(chunk, &within, |i| label(i).room.as_ref());
        let object = self.choose(chunk, &within, |i| label(i).object.as_ref());
        let reference = self.choose(chunk, &within, |i| label(i).reference.as_ref());
        let direction: Choice<Option<Direction>> = self.choose(chunk, &within, |i| label(i).direction);
        let target = self.choose(chunk, &within, |i| label(i).target.as_ref());
        let chosen = Label {
            room: room.value.cloned(),
            object: object.value.cloned(),
            reference: reference.value.cloned(),
            direction: direction.value,
            target: target.value.cloned(),
        };
        let because = self.because(&kind, &near);
        (chosen, kind.value, kind.score.clamp(0.0, 1.0), because)
    }

    /// The nearest example, its similarity, and the nearest of another meaning.
    fn because(&self, kind: &Choice<Kind>, near: &[(usize, f64)]) -> String {
        let words =
            |i: usize| self.examples[i].words.iter().map(|(word, _)| word.as_str()).collect::<Vec<_>>().join(" ");
        let nearest = near.iter().copied().reduce(|a, b| if b.1 > a.1 { b } else { a });
        let Some((best, similarity)) = nearest else { return String::new() };
        let rival = near
            .iter()
            .copied()
            .filter(|(i, _)| self.group_of[*i] != self.group_of[best])
            .reduce(|a, b| if b.1 > a.1 { b } else { a });
        let rival = rival.map_or(String::new(), |(i, s)| format!("; next \"{}\" ({s:.2})", words(i)));
        let typed = words(kind.example);
        format!("{} by \"{typed}\"; nearest \"{}\" ({similarity:.2}){rival}", kind.value.name(), words(best))
    }

    /// Similarity with every example of the chunk's tag.
    fn similarities(&self, chunk: &LabelledChunk) -> Vec<(usize, f64)> {
        let same_tag = self.examples.iter().enumerate().filter(|(_, example)| example.tag == chunk.tag);
        same_tag.map(|(i, _)| (i, self.similarity(chunk, i))).collect()
    }

    fn similarity(&self, chunk: &LabelledChunk, index: usize) -> f64 {
        let example = &self.examples[index];
        let shares = &self.shares[&self.group_of[index]];
        let weight = |word: &str| match self.options.distance {
            Distance::Plain => 1.0,
            Distance::Weighted => shares.get(word).copied().unwrap_or(LIGHT),
        };
        let distance = weighted_distance(
            &chunk.words,
            &example.words,
            |a, b| a == b,
            |i| weight(&chunk.words[i].0),
            |j| weight(&example.words[j].0),
        );
        1.0 - distance
    }

    /// argmax over the values that `value_of` gives to the examples; the first example's value of equals.
    fn choose<V: PartialEq + Copy>(
        &self,
        chunk: &LabelledChunk,
        near: &[(usize, f64)],
        value_of: impl Fn(usize) -> V,
    ) -> Choice<V> {
        let mut candidates: Vec<Choice<V>> = Vec::new();
        for &(example, score) in near {
            let value = value_of(example);
            match candidates.iter_mut().find(|known| known.value == value) {
                Some(known) if score > known.score => (known.score, known.example) = (score, example),
                Some(_) => {}
                None => candidates.push(Choice { value, score, example }),
            }
        }
        for candidate in &mut candidates {
            candidate.score *= self.prior(chunk, near, |i| value_of(i) == candidate.value);
        }
        let best = candidates.into_iter().reduce(|best, next| if next.score > best.score { next } else { best });
        best.unwrap_or(Choice { value: value_of(near[0].0), score: 0.0, example: near[0].0 })
    }

    /// The product of the priors in use for the value that `has` recognises.
    fn prior(&self, chunk: &LabelledChunk, near: &[(usize, f64)], has: impl Fn(usize) -> bool) -> f64 {
        let share = |fits: &dyn Fn(&LabelledChunk) -> bool| {
            let all = near.iter().filter(|(i, _)| fits(&self.examples[*i])).count();
            let with = near.iter().filter(|(i, _)| fits(&self.examples[*i]) && has(*i)).count();
            (with + 1) as f64 / (all + 2) as f64
        };
        let by_tag = || share(&|_| true);
        match self.options.factors {
            Factors::Similarity => 1.0,
            Factors::Prior => by_tag(),
            Factors::All => by_tag() * share(&|e| e.parent == chunk.parent) * share(&|e| e.children == chunk.children),
        }
    }
}

/// The share of a group's chunks in which each word stands; stop words are light.
fn word_shares(examples: &[LabelledChunk], members: &[usize]) -> HashMap<String, f64> {
    let mut shares: HashMap<String, f64> = HashMap::new();
    for &member in members {
        let words: HashSet<&String> = examples[member].words.iter().map(|(word, _)| word).collect();
        for word in words {
            *shares.entry(word.clone()).or_default() += 1.0 / members.len() as f64;
        }
    }
    for (word, share) in &mut shares {
        if STOP_WORDS.contains(&word.as_str()) {
            *share = LIGHT;
        }
    }
    shares
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_example_seen_in_training_is_found_again() {
        let model = Model::embedded(Options::default());
        for (i, example) in model.examples.iter().enumerate() {
            let twins = model.examples.iter().filter(|e| e.words == example.words && e.tag == example.tag);
            if twins.clone().all(|twin| twin.label == example.label) {
                assert_eq!(model.label(example).0, example.label, "example {i}");
            }
        }
    }

    #[test]
    fn a_model_survives_its_file() {
        let model = Model::embedded(Options { factors: Factors::All, distance: Distance::Weighted });
        let again = Model::from_json(&model.to_json().expect("serializes")).expect("reads");
        assert_eq!(again.options, model.options);
        assert_eq!(again.examples, model.examples);
    }

    #[test]
    fn a_model_of_another_version_is_refused() {
        let text = r#"{"version":9,"factors":"similarity","distance":"plain","examples":[]}"#;
        assert!(matches!(Model::from_json(text), Err(ModelError::Version(9))));
    }

    #[test]
    fn an_empty_model_says_that_it_has_nothing_to_learn_from() {
        let model = Model::train(&[], Options::default());
        let chunk = Model::embedded(Options::default()).examples[0].clone();
        assert!(model.label(&chunk).3.contains("no example"));
    }
}

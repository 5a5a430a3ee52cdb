//! How sure a reading is: what makes it doubtful, weighed by what doubts were worth on the project's own corpus.
//!
//! The weights stand in `corpus/grammar/confidence.tsv`; `corpus/grammar/learn_confidence.py` learns them from labelled
//! lines by logistic regression.

use std::collections::{BTreeMap, HashMap};
use std::sync::OnceLock;

use super::doubts::left_out;
use crate::language::{Act, Class, Kind, Phrase, Reading, Role, Unit};
use crate::record::{Grounding, Node, Reference};

/// A doubt counts at most so often.
const MOST: f64 = 4.0;

/// What makes the reading doubtful, and how often.
pub type Doubts = BTreeMap<String, f64>;

/// What is left of the confidence for each word that is unknown or was mended.
const STRANGE_WORD: f64 = 0.95;

/// Sets the confidence in the whole reading; returns what it was charged for.
pub fn score(grounding: &mut Grounding, reading: &Reading) -> Doubts {
    let doubts = doubts(grounding, reading);
    let weights = weights();
    let sum: f64 = doubts.iter().filter_map(|(name, count)| Some(weights.get(name.as_str())? * count)).sum();
    let constant = weights.get("constant").copied().unwrap_or(0.0);
    // Whatever else the weights say, a word that nobody knows and one that was mended never make a reading surer.
    let strange: f64 = ["unknown_word", "mended"].iter().filter_map(|name| doubts.get(*name)).sum();
    grounding.score = (STRANGE_WORD.powf(strange) / (1.0 + (-constant - sum).exp())).into();
    doubts
}

fn weights() -> &'static HashMap<&'static str, f64> {
    static WEIGHTS: OnceLock<HashMap<&'static str, f64>> = OnceLock::new();
    WEIGHTS.get_or_init(|| {
        let lines = include_str!("../../corpus/grammar/confidence.tsv").lines().filter(|line| !line.starts_with('#'));
        lines.map(|line| weight(line).unwrap_or_else(|| panic!("corpus/grammar/confidence.tsv: {line:?}"))).collect()
    })
}

/// A line that cannot be read is a fault of the file that was built in, and ends the program.
fn weight(line: &str) -> Option<(&str, f64)> {
    let (name, weight) = line.split_once('\t')?;
    let weight: f64 = weight.parse().ok()?;
    (!name.is_empty() && weight.is_finite()).then_some((name, weight))
}

fn doubts(grounding: &Grounding, reading: &Reading) -> Doubts {
    let mut counts = Counts::default();
    for at in left_out(reading) {
        counts.add(left_out_as(&reading.units[at]), 1.0);
    }
    for unit in &reading.units {
        counts.count("mended", unit.mended && unit.noun.is_some());
        counts.count("person_named", unit.capital);
        counts.count("unknown_word", unit.is_unknown() && !unit.foreign && !unit.capital);
    }
    reading.phrases.iter().for_each(|phrase| counts.phrase(phrase, reading));
    counts.grounding(grounding);
    let units = reading.units.len().max(1) as f64;
    counts.add("length", units.ln());
    counts.add("cost", 10.0 * f64::from(reading.cost) / units);
    counts.0
}

fn left_out_as(unit: &Unit) -> &'static str {
    let verb = [Role::Turn, Role::Motion, Role::Bring, Role::Give, Role::Put, Role::Act, Role::Find];
    match unit.noun {
        Some(noun) if noun.class == Class::Object => "lost_object",
        Some(noun) if noun.class == Class::Person => "lost_person",
        Some(_) => "lost_furniture",
        None if unit.is_unknown() && unit.foreign => "lost_english",
        None if unit.is_unknown() => "lost_unknown",
        None if unit.has(Role::Side) => "lost_side",
        None if verb.iter().any(|role| unit.has(*role)) => "lost_verb",
        None => "lost_other",
    }
}

#[derive(Default)]
struct Counts(Doubts);

impl Counts {
    fn add(&mut self, name: &str, value: f64) {
        let sum = self.0.entry(name.to_string()).or_default();
        *sum = (*sum + value).min(if matches!(name, "cost" | "length") { 40.0 } else { MOST });
    }

    fn count(&mut self, name: &str, applies: bool) {
        if applies {
            self.add(name, 1.0);
        }
    }

    fn phrase(&mut self, phrase: &Phrase, reading: &Reading) {
        for noun in &phrase.nouns {
            self.count("unknown_noun", !noun.is_known());
            self.count("inferred_noun", noun.inferred);
            self.count("generic", noun.generic);
        }
        self.count("correction", phrase.kind == Kind::Corrected);
        self.count("ruled_out", phrase.kind == Kind::RuledOut);
        self.count("not_unused", phrase.kind == Kind::Not);
        self.count("act_other", phrase.act == Act::Other);
        self.count("held", phrase.held);
        self.count("it", phrase.from == crate::language::From::It);
        self.count("view", phrase.kind == Kind::Perspective);
        self.count("turns", phrase.kind == Kind::Turn);
        self.count("sides", phrase.kind == Kind::Side);
        let named = phrase.noun().is_some_and(|noun| !noun.generic);
        self.count("objects_named", phrase.kind == Kind::Object && named);
        self.count(
            "bare_furniture",
            phrase.kind == Kind::Target && phrase.relation.is_none() && phrase.act == Act::None,
        );
        let _ = reading;
    }

    fn grounding(&mut self, grounding: &Grounding) {
        let targets = grounding.nodes.iter().filter(|node| node.target.is_some()).count();
        self.add("more_targets", targets.saturating_sub(1) as f64);
        self.count("no_target", targets == 0);
        self.count("no_object", grounding.object.is_none());
        self.count("no_room", grounding.room.is_none());
        self.count("nothing", grounding.object.is_none() && targets == 0);
        self.count("delivery", grounding.destination.is_some());
        self.count("delivery_target", grounding.destination.as_ref().is_some_and(|goal| goal.target.is_some()));
        self.add("errands", grounding.then.len() as f64);
        self.add("also", grounding.also.len() as f64);
        self.count("doubtful_object", grounding.object.as_ref().is_some_and(|object| object.score.0 < 0.7));
        let loose =
            |node: &&Node| node.target.is_none() && node.pairs.iter().all(|pair| pair.reference != Reference::Move);
        self.add("loose_places", grounding.nodes.iter().filter(loose).count() as f64);
        let pairs: usize = grounding.nodes.iter().map(|node| node.pairs.len()).sum();
        self.add("pairs", pairs as f64);
    }
}

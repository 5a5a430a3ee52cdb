//! Scores records against gold, stage by stage.

use std::collections::hash_map::Entry;
use std::collections::{BTreeMap, BTreeSet, HashMap};

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::brackets::brackets_of;
use super::grounding::judge;
use super::{Gold, Pipeline, Rate};
use crate::record::{Chunk, Grounding, Outcome, Record, Rounded, Tag, Trial};
use crate::simulation::{Home, TrialSettings};

/// The scores of one group of descriptions. A stage that no record has reached is not counted.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
pub struct Group {
    /// Descriptions.
    pub descriptions: usize,
    /// Labelled brackets: found of gold.
    pub bracket_recall: Rate,
    /// Labelled brackets: gold of found.
    pub bracket_precision: Rate,
    /// Whole trees right.
    pub exact_trees: Rate,
    /// Side of the room right, where gold has one.
    pub room: Rate,
    /// Object right.
    pub object: Rate,
    /// Target furniture named or not, as in gold.
    pub targets: Rate,
    /// All references and directions right.
    pub pairs: Rate,
    /// All of these right: the paper's command rate.
    pub command: Rate,
    /// The object is recognisable in the last picture.
    pub found: Rate,
    /// The first furniture approached holds the object.
    pub right_first: Rate,
    /// The first furniture approached is one that the words allow.
    pub expected_first: Rate,
    /// Sum of success weighted by path length.
    pub spl_sum: Rounded,
    /// How often the robot touched something.
    pub collisions: u32,
}

/// All scores of a corpus.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
pub struct Scores {
    /// All descriptions.
    pub all: Group,
    /// By "how" and "where".
    pub by_form: BTreeMap<String, Group>,
    /// By the furniture named.
    pub by_names: BTreeMap<String, Group>,
    /// By tag: found of gold, gold of found.
    pub by_tag: BTreeMap<String, (Rate, Rate)>,
    /// Gold descriptions without a record: they count as wrong.
    pub missing: Vec<String>,
    /// Ids with more than one record: the first counts.
    pub doubled: Vec<String>,
    /// Records that gold does not have.
    pub unknown: Vec<String>,
}

/// What a record says that gold can be held against.
#[derive(Debug, Default)]
struct Answer {
    chunks: Option<Vec<Chunk>>,
    grounding: Option<Grounding>,
    trial: Option<Trial>,
}

/// Scores JSON lines of records against gold; `Err` names a record that is none.
///
/// # Errors
/// When a line is no record.
pub fn score(gold: &[Gold], lines: &[String]) -> Result<Scores, String> {
    let mut scores = Scores::default();
    let mut answers: HashMap<String, Answer> = HashMap::new();
    let known: BTreeSet<&str> = gold.iter().map(|g| g.id.as_str()).collect();
    for (i, line) in lines.iter().enumerate() {
        let record = Record::parse(line).map_err(|error| format!("record {}: {error}", i + 1))?;
        let id = record.id().unwrap_or_default();
        let answer = read(&record).map_err(|error| format!("record {}: {error}", i + 1))?;
        if !known.contains(id.as_str()) {
            scores.unknown.push(id);
            continue;
        }
        match answers.entry(id) {
            Entry::Occupied(first) => scores.doubled.push(first.key().clone()),
            Entry::Vacant(place) => {
                place.insert(answer);
            }
        }
    }
    // A stage is scored when any record has come that far; records without it then count as wrong.
    let reached = Reached {
        chunks: answers.values().any(|a| a.chunks.is_some()),
        grounding: answers.values().any(|a| a.grounding.is_some()),
        trial: answers.values().any(|a| a.trial.is_some()),
    };
    let nothing = Answer::default();
    for gold in gold {
        let answer = answers.get(&gold.id).unwrap_or_else(|| {
            scores.missing.push(gold.id.clone());
            &nothing
        });
        scores.all.add(gold, answer, reached);
        scores.by_form.entry(gold.form().to_string()).or_default().add(gold, answer, reached);
        scores.by_names.entry(gold.names().to_string()).or_default().add(gold, answer, reached);
        if reached.chunks {
            scores.add_tags(gold, answer);
        }
    }
    Ok(scores)
}

#[derive(Clone, Copy)]
struct Reached {
    chunks: bool,
    grounding: bool,
    trial: bool,
}

fn read(record: &Record) -> Result<Answer, crate::record::FieldError> {
    Ok(Answer { chunks: record.part()?, grounding: record.part()?, trial: record.part()? })
}

impl Scores {
    fn add_tags(&mut self, gold: &Gold, answer: &Answer) {
        let found = brackets_of(&gold.text, answer.chunks.as_deref().unwrap_or_default());
        for tag in Tag::ALL {
            let of_tag = |bracket: &&(Tag, usize, usize)| bracket.0 == tag;
            let rates = self.by_tag.entry(tag.name().to_string()).or_default();
            gold.brackets.iter().filter(of_tag).for_each(|bracket| rates.0.count(found.contains(bracket)));
            found.iter().filter(of_tag).for_each(|bracket| rates.1.count(gold.brackets.contains(bracket)));
        }
    }
}

impl Group {
    /// F1 of the labelled brackets.
    pub fn bracket_f1(&self) -> f64 {
        let sum = self.bracket_recall.of + self.bracket_precision.of;
        if sum == 0 { 0.0 } else { 2.0 * self.bracket_recall.hit as f64 / sum as f64 }
    }

    fn add(&mut self, gold: &Gold, answer: &Answer, reached: Reached) {
        self.descriptions += 1;
        if reached.chunks && !gold.brackets.is_empty() {
            let found = brackets_of(&gold.text, answer.chunks.as_deref().unwrap_or_default());
            gold.brackets.iter().for_each(|bracket| self.bracket_recall.count(found.contains(bracket)));
            found.iter().for_each(|bracket| self.bracket_precision.count(gold.brackets.contains(bracket)));
            self.exact_trees.count(found == gold.brackets);
        }
        if reached.grounding && gold.is_labelled() {
            self.add_grounding(gold, answer.grounding.as_ref());
        }
        if reached.trial {
            self.add_trial(gold, answer.trial.as_ref());
        }
    }

    fn add_grounding(&mut self, gold: &Gold, grounding: Option<&Grounding>) {
        let nothing = Grounding::default();
        let verdict = judge(gold, grounding.unwrap_or(&nothing));
        let [room, object, pairs] = verdict.parts();
        self.room.count(room);
        self.object.count(object);
        self.targets.count(verdict.target());
        self.pairs.count(pairs);
        self.command.count(verdict.command());
    }

    fn add_trial(&mut self, gold: &Gold, trial: Option<&Trial>) {
        self.found.count(trial.is_some_and(|trial| trial.outcome == Outcome::Found));
        self.right_first.count(trial.is_some_and(|trial| trial.right_first == Some(true)));
        if !gold.expect.is_empty() {
            let first = trial.and_then(|trial| trial.approached.first());
            self.expected_first.count(first.is_some_and(|first| gold.expect.contains(first)));
        }
        self.spl_sum.0 += trial.and_then(|trial| trial.spl).map_or(0.0, |spl| spl.0);
        self.collisions += trial.map_or(0, |trial| trial.collisions);
    }
}

/// Runs a corpus end to end in `home`, from the text, and returns the records as JSON lines in the corpus's order.
pub fn run_corpus(gold: &[Gold], home: &Home, settings: &TrialSettings) -> Vec<String> {
    gold.par_iter().map_init(|| Pipeline::new(home, *settings), |pipeline, gold| pipeline.record(gold)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluation::read_gold;
    use crate::language::chunk_text;

    fn own() -> Vec<Gold> {
        read_gold(include_str!("../../corpus/templates.jsonl"), "templates.jsonl").expect("a sound corpus")
    }

    #[test]
    fn a_missing_record_counts_as_wrong_and_is_named() {
        let gold = &own()[..2];
        let (_, chunks) = chunk_text(&gold[0].text);
        let mut record = Record::from_text(&gold[0].id, &gold[0].text);
        record.put(&chunks);
        let line = serde_json::to_string(&record).expect("serializes");
        let scores = score(gold, &[line.clone(), line]).expect("scored");
        assert_eq!(scores.missing, [gold[1].id.clone()]);
        assert_eq!(scores.doubled, [gold[0].id.clone()]);
        assert_eq!(scores.all.exact_trees.of, 2);
        assert_eq!(scores.all.found.of, 0);
    }

    #[test]
    fn the_own_templates_end_to_end_find_what_they_name_without_a_collision() {
        // A third of them: each is a drive.
        let gold: Vec<Gold> = own().into_iter().step_by(3).collect();
        let home = Home::load(None, None).expect("the apartment");
        let scores = score(&gold, &run_corpus(&gold, &home, &TrialSettings::default())).expect("scored");
        assert!(scores.all.found.hit + 1 >= gold.len(), "found {} of {}", scores.all.found.hit, gold.len());
        assert_eq!(scores.all.collisions, 0);
        assert!(scores.all.command.share() > 0.9 && scores.all.right_first.share() > 0.85);
    }
}

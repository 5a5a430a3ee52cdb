//! Which stage a failed trial is to be charged to: gold is put in place of one stage at a time.
//!
//! The first stage, in the order of the pipeline, whose gold mends the trial
//! is charged. A plan's gold enters the room where the furniture truly
//! stands, and reads each relation in the one frame of reference that holds;
//! perception's gold is ideal eyes.

mod oracle;
mod text;

pub use text::{blame_text, meaning_phrase};

use std::collections::BTreeMap;

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;

use super::{Gold, Measure, Pipeline};
use crate::behavior::Run;
use crate::record::{Grounding, Plan};
use crate::simulation::{Home, Perception, TrialSettings};

/// A stage that can be replaced by gold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Stage {
    /// The chunk tree.
    Chunk,
    /// Room, nodes and object.
    Ground,
    /// The room on the map and the frames of reference.
    Plan,
    /// What the robot sees.
    Perceive,
    /// No stage's gold mends it: the executive errs, or the words fit another piece as well.
    Drive,
}

/// One failed trial.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Blame {
    /// The description's id.
    pub id: String,
    /// The description.
    pub text: String,
    /// What it is charged to.
    pub charged: Stage,
    /// Every stage whose gold, alone, mends it.
    pub mended_by: Vec<Stage>,
    /// The furniture approached first.
    pub first: Option<String>,
    /// The furniture that would have been right.
    pub wanted: Vec<String>,
    /// How the trial ended, in words.
    pub ended: String,
    /// What was understood.
    pub understood: String,
    /// What gold says it means.
    pub meant: String,
}

/// All failures of a corpus.
#[derive(Clone, Debug, Default, Serialize, JsonSchema)]
pub struct Blames {
    /// Descriptions that can be judged.
    pub descriptions: usize,
    /// Descriptions without a gold meaning: nothing can be put in place of a stage.
    pub unjudged: usize,
    /// Failed trials.
    pub failed: usize,
    /// Failures by the stage charged.
    pub charged: BTreeMap<Stage, usize>,
    /// The failures, in the corpus's order.
    pub failures: Vec<Blame>,
}

/// What the furniture that a trial should go to first is taken from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Wanted {
    /// What the corpus expects, else what holds the object in this home
    #[default]
    Object,
    /// What the gold meaning leads to: for descriptions of another home
    Meaning,
}

/// Runs a corpus, and every failure again with the gold of one stage at a time.
pub fn blame(gold: &[Gold], home: &Home, settings: &TrialSettings, measure: Measure, by: Wanted) -> Blames {
    let judged: Vec<&Gold> = gold.iter().filter(|gold| gold.grounding.is_some()).collect();
    let failures: Vec<Option<Blame>> = judged
        .par_iter()
        .map_init(|| Pipeline::new(home, *settings), |pipeline, gold| Trial::of(pipeline, gold, measure, by).blame())
        .collect();
    let failures: Vec<Blame> = failures.into_iter().flatten().collect();
    let mut charged = BTreeMap::new();
    for failure in &failures {
        *charged.entry(failure.charged).or_default() += 1;
    }
    let unjudged = gold.len() - judged.len();
    Blames { descriptions: judged.len(), unjudged, failed: failures.len(), charged, failures }
}

/// One description under trial.
struct Trial<'a, 'h> {
    pipeline: &'a Pipeline<'h>,
    gold: &'a Gold,
    meaning: Grounding,
    wanted: Vec<String>,
    measure: Measure,
}

impl<'a, 'h> Trial<'a, 'h> {
    fn of(pipeline: &'a Pipeline<'h>, gold: &'a Gold, measure: Measure, by: Wanted) -> Self {
        let meaning = gold.grounding.clone().unwrap_or_default();
        let wanted = wanted(pipeline, gold, &meaning, by);
        Self { pipeline, gold, meaning, wanted, measure }
    }

    fn blame(&self) -> Option<Blame> {
        let understood = self.pipeline.understand(&self.gold.text);
        let run = self.drive(&understood.plan);
        if self.good(&run) {
            return None;
        }
        let mended_by = self.mended_by(&understood.plan);
        Some(Blame {
            id: self.gold.id.clone(),
            text: self.gold.text.clone(),
            charged: mended_by.first().copied().unwrap_or(Stage::Drive),
            mended_by,
            first: run.trial.approached.first().cloned(),
            wanted: self.wanted.clone(),
            ended: run.trial.why,
            understood: text::meaning_phrase(&understood.grounding),
            meant: text::meaning_phrase(&self.meaning),
        })
    }

    /// The stages whose gold mends the trial, in the order of the pipeline.
    fn mended_by(&self, plan: &Plan) -> Vec<Stage> {
        let mut stages = Vec::new();
        let (text, chunks) = (&self.gold.text, &self.gold.chunks);
        if !chunks.is_empty() && self.mends(&self.pipeline.from_tree(text, Vec::new(), chunks.clone()).plan) {
            stages.push(Stage::Chunk);
        }
        if self.mends(&self.pipeline.plan(&self.meaning)) {
            stages.push(Stage::Ground);
        }
        let plans = oracle::plans(self.pipeline.home, &self.pipeline.plan(&self.meaning), &self.wanted);
        if plans.iter().any(|plan| self.mends(plan)) {
            stages.push(Stage::Plan);
        }
        if self.pipeline.settings.perception != Perception::Truth {
            let settings = TrialSettings { perception: Perception::Truth, ..self.pipeline.settings };
            let run = Pipeline::new(self.pipeline.home, settings).drive(&self.gold.id, plan);
            if self.good(&run) {
                stages.push(Stage::Perceive);
            }
        }
        stages
    }

    fn mends(&self, plan: &Plan) -> bool {
        self.good(&self.drive(plan))
    }

    fn drive(&self, plan: &Plan) -> Run {
        self.pipeline.drive(&self.gold.id, plan)
    }

    fn good(&self, run: &Run) -> bool {
        let first = run.trial.approached.first();
        match self.measure {
            Measure::Found => self.measure.reached(Some(&run.trial)),
            Measure::RightFirst => match first {
                Some(first) => self.wanted.contains(first),
                None => self.wanted.is_empty(),
            },
        }
    }
}

/// The furniture that is right; what the gold meaning leads to also where the home lacks the object.
fn wanted(pipeline: &Pipeline, gold: &Gold, meaning: &Grounding, by: Wanted) -> Vec<String> {
    if by == Wanted::Object {
        if !gold.expect.is_empty() {
            return gold.expect.clone();
        }
        let holders = gold.object.as_ref().map(|object| pipeline.home.scene.holders_of(object)).unwrap_or_default();
        if !holders.is_empty() {
            return holders.iter().map(|item| item.id.clone()).collect();
        }
    }
    let run = pipeline.drive(&gold.id, &pipeline.plan(meaning));
    run.trial.approached.into_iter().take(1).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluation::read_gold;

    fn blamed(tree: &str, text: &str, expect: &str) -> Blames {
        let grounding = r#"{"room":{"name":"bedroom","side":null},"object":{"name":"mug"},"nodes":[{"target":"table","pairs":[{"reference":"chair","direction":"side","frame":"viewer"}]}]}"#;
        let line =
            format!(r#"{{"id":"1","text":"{text}","tree":"{tree}","grounding":{grounding},"expect":["{expect}"]}}"#);
        let gold = read_gold(&line, "gold.jsonl").expect("gold");
        let home = Home::load(None, None).expect("the apartment");
        blame(&gold, &home, &TrialSettings::default(), Measure::RightFirst, Wanted::Object)
    }

    #[test]
    fn words_that_were_not_understood_are_charged_to_grounding() {
        let text = "you sip from it in the chamber where folk doze";
        let blames = blamed(&format!("[OBTP {text}]"), text, "hexagon-table-1");
        assert_eq!((blames.failed, blames.charged.get(&Stage::Ground)), (1, Some(&1)), "{blames:?}");
    }

    #[test]
    fn what_succeeds_is_not_charged() {
        let text = "the mug is in the bedroom on the table by the chairs";
        assert_eq!(blamed(text, text, "hexagon-table-1").failed, 0);
    }

    #[test]
    fn what_no_gold_mends_is_charged_to_driving() {
        let text = "the mug is in the bedroom on the table by the chairs";
        let blames = blamed(text, text, "coffee-table-1");
        assert_eq!(blames.failures[0].charged, Stage::Drive, "{blames:?}");
    }
}

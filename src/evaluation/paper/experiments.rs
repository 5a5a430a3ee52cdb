//! The experiments behind the three tables.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::Arc;

use rayon::prelude::*;

use super::figures;
use super::{Cell, Column, Paper, PaperTable, Row, Source};
use crate::behavior::Options;
use crate::behavior::Run;
use crate::evaluation::behavior::{
    Condition, Score, Selection, Source as Instructions, drive_all, instructions, lacking,
};
use crate::evaluation::{Gold, Pipeline, Rate, Scores, Understood, score};
use crate::grounding::paper::{Model, Options as ModelOptions};
use crate::grounding::{Grounder, Method};
use crate::language::chunk_text;
use crate::record::Record;
use crate::simulation::{Home, TrialSettings};

/// One trial from the text, to be shown.
pub struct Case<'g> {
    /// The description.
    pub gold: &'g Gold,
    /// What was made of it.
    pub understood: Understood,
    /// What became of it.
    pub run: Run,
    /// Which arrangement of the furniture, counted from 0.
    pub arrangement: usize,
}

/// What the three experiments are run on.
#[derive(Clone, Debug)]
pub struct Experiments<'g> {
    /// What the corpus is called.
    pub corpus: String,
    /// Its descriptions.
    pub gold: &'g [Gold],
    /// The furniture as it was, and moved.
    pub homes: &'g [Home; 2],
    /// Eyes, noise, first seed.
    pub settings: TrialSettings,
    /// Trials of each instruction.
    pub seeds: u64,
}

impl<'g> Experiments<'g> {
    /// The first description of each instruction.
    fn unique(&self) -> Vec<&'g Gold> {
        let said = instructions(self.gold, &self.homes[0].map, Instructions::Gold, Selection::Unique);
        let ids: BTreeSet<&str> = said.iter().map(|said| said.id.as_str()).collect();
        self.gold.iter().filter(|gold| ids.contains(gold.id.as_str())).collect()
    }

    /// Trials in all.
    pub fn trials(&self) -> u64 {
        let variants = 2 * main_variants().len() + lacking().len();
        self.seeds * (self.unique().len() * variants) as u64
    }

    /// Grounding, the home as it is, the home with its furniture moved; `done` hears of every trial that ends.
    pub fn run(&self, done: &(dyn Fn() + Sync)) -> Paper {
        let perception = clap::ValueEnum::to_possible_value(&self.settings.perception);
        Paper {
            corpus: self.corpus.clone(),
            descriptions: self.gold.len(),
            unique: self.unique().len(),
            seeds: self.seeds,
            perception: perception.map_or(String::new(), |value| value.get_name().to_string()),
            tables: vec![table_one(self.gold), self.table_two(done), self.table_three(done)],
            notes: NOTES.iter().map(|note| (*note).to_string()).collect(),
        }
    }

    /// Each instruction once from its text in both arrangements of the furniture, to be shown.
    pub fn cases(&self) -> Vec<Case<'g>> {
        let unique = self.unique();
        let tasks: Vec<(usize, &Gold)> = (0..2).flat_map(|i| unique.iter().map(move |gold| (i, *gold))).collect();
        let case = |&(arrangement, gold): &(usize, &'g Gold)| {
            let pipeline = Pipeline::new(&self.homes[arrangement], self.settings);
            let understood = pipeline.understand(&gold.text);
            let run = pipeline.drive(&gold.id, &understood.plan);
            Case { gold, understood, run, arrangement }
        };
        tasks.par_iter().map(case).collect()
    }

    fn table_two(&self, done: &(dyn Fn() + Sync)) -> PaperTable {
        let lacking = lacking().map(|(name, options)| (name, Instructions::Gold, options));
        let variants = main_variants().into_iter().chain(lacking);
        let ours = variants.flat_map(|variant| self.trial_rows(variant, &self.homes[0], done));
        let title = "Table II: the fetch task, furniture as it was".to_string();
        PaperTable { title, rows: figures::table_two().into_iter().chain(ours).collect() }
    }

    fn table_three(&self, done: &(dyn Fn() + Sync)) -> PaperTable {
        let ours = main_variants().into_iter().flat_map(|variant| self.trial_rows(variant, &self.homes[1], done));
        let title = "Table III: the fetch task, furniture moved".to_string();
        PaperTable { title, rows: figures::table_three().into_iter().chain(ours).collect() }
    }

    /// Two rows: found, and right first.
    fn trial_rows(&self, (name, source, options): Variant, home: &Home, done: &(dyn Fn() + Sync)) -> [Row; 2] {
        let said = instructions(self.gold, &home.map, source, Selection::Unique);
        let condition = Condition { name: name.to_string(), home, options };
        let scores = drive_all(&said, &condition, &self.settings, self.seeds, done);
        let by_id: HashMap<&str, &Gold> = self.gold.iter().map(|gold| (gold.id.as_str(), gold)).collect();
        let scored = said.iter().zip(&scores);
        let trials: Vec<(&Gold, &Score)> = scored
            .flat_map(|(said, scores)| scores.iter().filter_map(|score| Some((*by_id.get(said.id.as_str())?, score))))
            .collect();
        ["found", "right first"].map(|measure| row_of(name, measure, &trials))
    }
}

const NOTES: [&str; 6] = [
    "`paper: robot` is a real robot whose eyes erred; all rows of ours are simulated, their eyes as told above",
    "the executive goes straight to an object that it recognises in passing; without that glance shows what pairs, frames and fall-back are worth",
    "the paper groups by what a landmark is for (none, on the path, at the goal) by a rule that is not known; ours by the furniture named (none, the table alone, other as well): the groups are not the same",
    "the paper counts a trial a success when the object is recognisable in the robot's last picture: `found`; a robot that ignores the words finds nearly everything as well, later: what words are worth shows in `right first`, whether the first furniture approached holds the object, and in the way's length (SPL)",
    "the paper's simulation starts from gold instructions; `from text` reads the words first",
    "trials of one instruction under several seeds are not independent: the intervals are too narrow by up to the root of the number of seeds",
];

fn table_one(gold: &[Gold]) -> PaperTable {
    let composed = Grounder::new(Method::Composed, true);
    let published = Grounder::new(Method::Paper(Arc::new(Model::embedded(ModelOptions::default()))), true);
    let on_gold: Vec<Gold> = gold.iter().filter(|gold| !gold.chunks.is_empty()).cloned().collect();
    let rows = [
        ("from text", gold, &composed, false),
        ("from gold trees", &on_gold, &composed, true),
        ("published method trained on the own templates, gold trees", &on_gold, &published, true),
    ];
    let ours = rows.into_iter().filter(|(_, gold, _, _)| !gold.is_empty()).map(|(name, gold, grounder, trees)| {
        let lines: Vec<String> = gold.par_iter().map(|gold| grounded(gold, grounder, trees)).collect();
        // Records of our own always read.
        command_row(name, &score(gold, &lines).unwrap_or_default())
    });
    let title = "Table I: descriptions understood, all chunks right".to_string();
    PaperTable { title, rows: std::iter::once(figures::table_one()).chain(ours).collect() }
}

fn grounded(gold: &Gold, grounder: &Grounder, gold_tree: bool) -> String {
    let (tokens, chunks) = chunk_text(&gold.text);
    let chunks = if gold_tree { gold.chunks.clone() } else { chunks };
    let mut record = Record::from_text(&gold.id, &gold.text);
    record.put(&grounder.ground(&gold.text, &tokens, &chunks));
    serde_json::to_string(&record).unwrap_or_default()
}

fn command_row(name: &str, scores: &Scores) -> Row {
    let group = |column: Column| match column {
        Column::All => Some(&scores.all),
        Column::None => scores.by_names.get("none"),
        Column::Path => scores.by_names.get("table only"),
        Column::Goal => scores.by_names.get("other"),
        Column::How => scores.by_form.get("how"),
        Column::Where => scores.by_form.get("where"),
    };
    let cells = Column::ALL.into_iter().filter_map(|column| Some((column, Cell::from(group(column)?.command))));
    let cells = cells.filter(|(_, cell)| cell.count.is_some_and(|count| count.of > 0)).collect();
    Row { name: name.to_string(), source: Source::Ours, measure: "command".to_string(), cells, spl: None }
}

/// What the executive may do in a pair of rows.
type Variant = (&'static str, Instructions, Options);

fn main_variants() -> Vec<Variant> {
    vec![
        ("gold instructions", Instructions::Gold, Options::default()),
        ("from text", Instructions::Text, Options::default()),
    ]
}

/// How many of the trials reached what is measured.
fn row_of(name: &str, measure: &str, trials: &[(&Gold, &Score)]) -> Row {
    let spl: f64 = trials.iter().map(|(_, score)| score.spl).sum::<f64>() / trials.len().max(1) as f64;
    let reached = |score: &Score| if measure == "found" { score.found } else { score.right_first };
    let mut rates: BTreeMap<Column, Rate> = BTreeMap::new();
    for (gold, score) in trials {
        columns_of(gold).iter().for_each(|column| rates.entry(*column).or_default().count(reached(score)));
    }
    Row {
        name: name.to_string(),
        source: Source::Ours,
        measure: measure.to_string(),
        cells: rates.into_iter().map(|(column, rate)| (column, rate.into())).collect(),
        spl: (measure == "found").then(|| spl.into()),
    }
}

fn columns_of(gold: &Gold) -> [Column; 3] {
    let form = if gold.form() == "where" { Column::Where } else { Column::How };
    let names = match gold.names() {
        "none" => Column::None,
        "other" => Column::Goal,
        _ => Column::Path,
    };
    [Column::All, names, form]
}

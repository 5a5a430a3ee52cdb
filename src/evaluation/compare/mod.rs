//! Two runs of the same descriptions, record by record: what one mended, what it broke, what it changed.

mod changes;
mod mcnemar;
mod text;

pub use mcnemar::mcnemar_exact;
pub use text::comparison_text;

use std::collections::HashMap;

use schemars::JsonSchema;
use serde::Serialize;

use self::changes::changes_between;
use super::Rate;
use crate::record::{FieldError, Outcome, Record, Rounded, Trial};

/// What a trial has to reach to count as a success.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, JsonSchema, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Measure {
    /// The object is recognisable in the last picture
    #[default]
    Found,
    /// The first furniture approached holds the object
    RightFirst,
}

impl Measure {
    /// Whether a trial reaches it; a record without a trial does not.
    pub fn reached(self, trial: Option<&Trial>) -> bool {
        trial.is_some_and(|trial| match self {
            Self::Found => trial.outcome == Outcome::Found,
            Self::RightFirst => trial.right_first == Some(true),
        })
    }
}

/// One value that differs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Change {
    /// The record.
    pub id: String,
    /// Where in the record: `grounding.nodes.0.pairs.1.direction`.
    pub field: String,
    /// Its value in the first file, as JSON; null where it is absent.
    pub from: serde_json::Value,
    /// Its value in the second.
    pub to: serde_json::Value,
}

/// How the second run differs from the first.
#[derive(Clone, Debug, Default, Serialize, JsonSchema)]
pub struct Comparison {
    /// What counts as a success; nothing does when neither file has trials.
    pub measure: Option<Measure>,
    /// Successes of the first run, over the records both have.
    pub first: Rate,
    /// Successes of the second.
    pub second: Rate,
    /// Ids that failed before and succeed now.
    pub fixed: Vec<String>,
    /// Ids that succeeded before and fail now.
    pub broken: Vec<String>,
    /// Two-sided exact p of McNemar's test: how likely so uneven a split of fixed and broken is by chance.
    pub mcnemar_p: Rounded,
    /// Records in which something differs.
    pub differing: usize,
    /// Every value that differs, in the first file's order.
    pub changes: Vec<Change>,
    /// Ids of the first file that the second lacks.
    pub missing: Vec<String>,
    /// Ids of the second file that the first lacks.
    pub extra: Vec<String>,
    /// Ids that stand more than once in one file: the first counts.
    pub doubled: Vec<String>,
}

/// A line of a results file that cannot be compared.
#[derive(Debug, thiserror::Error)]
#[error("{file}:{line}: {message}")]
pub struct CompareError {
    /// The file.
    pub file: String,
    /// 1-based.
    pub line: usize,
    /// What is wrong.
    pub message: String,
}

/// A run's records by id.
struct Run<'l> {
    order: Vec<String>,
    records: HashMap<String, (usize, Record<'l>)>,
    doubled: Vec<String>,
}

/// A run's name and its lines.
pub type NamedLines<'l> = (&'l str, &'l [String]);

/// Compares two runs by the keys the stages add. `everything` counts measurements and reasons as changes as well.
///
/// # Errors
/// When a line is no record, or a record has no id or stands twice.
pub fn compare(
    first: NamedLines,
    second: NamedLines,
    measure: Measure,
    everything: bool,
) -> Result<Comparison, CompareError> {
    let (a, b) = (Run::read(first)?, Run::read(second)?);
    let mut comparison = Comparison { doubled: [a.doubled.clone(), b.doubled.clone()].concat(), ..Default::default() };
    comparison.extra = b.order.iter().filter(|id| !a.records.contains_key(*id)).cloned().collect();
    for id in &a.order {
        let Some((line, record)) = b.records.get(id) else {
            comparison.missing.push(id.clone());
            continue;
        };
        let added = comparison.add(id, &a.records[id].1, record, measure, everything);
        // What cannot be read may stand in either file; the second is the likelier suspect.
        added.map_err(|error| CompareError { file: second.0.to_string(), line: *line, message: error.to_string() })?;
    }
    comparison.mcnemar_p = mcnemar_exact(comparison.fixed.len(), comparison.broken.len()).into();
    Ok(comparison)
}

impl Comparison {
    /// Whether something is worse than before: a record that fails now, or is gone.
    pub fn regressed(&self) -> bool {
        !self.broken.is_empty() || !self.missing.is_empty()
    }

    fn add(&mut self, id: &str, a: &Record, b: &Record, measure: Measure, everything: bool) -> Result<(), FieldError> {
        let changes = changes_between(id, a, b, everything)?;
        self.differing += usize::from(!changes.is_empty());
        self.changes.extend(changes);
        let (before, after): (Option<Trial>, Option<Trial>) = (a.part()?, b.part()?);
        if before.is_none() && after.is_none() {
            return Ok(());
        }
        self.measure = Some(measure);
        let (before, after) = (measure.reached(before.as_ref()), measure.reached(after.as_ref()));
        self.first.count(before);
        self.second.count(after);
        match (before, after) {
            (false, true) => self.fixed.push(id.to_string()),
            (true, false) => self.broken.push(id.to_string()),
            _ => {}
        }
        Ok(())
    }
}

impl<'l> Run<'l> {
    fn read((file, lines): NamedLines<'l>) -> Result<Self, CompareError> {
        let mut run = Self { order: Vec::new(), records: HashMap::new(), doubled: Vec::new() };
        for (i, line) in lines.iter().enumerate() {
            let wrong = |message: String| CompareError { file: file.to_string(), line: i + 1, message };
            let record = Record::parse(line).map_err(|error| wrong(error.to_string()))?;
            let id = record.id().ok_or_else(|| wrong("a record without `id` cannot be compared".to_string()))?;
            if run.records.contains_key(&id) {
                run.doubled.push(id);
            } else {
                run.order.push(id.clone());
                run.records.insert(id, (i + 1, record));
            }
        }
        Ok(run)
    }
}

#[cfg(test)]
mod tests;

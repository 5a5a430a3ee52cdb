//! Tables I, II and III of the paper, its figures beside ours.

mod csv;
mod experiments;
mod figures;
mod text;

pub use csv::paper_csv;
pub use experiments::{Case, Experiments};
pub(super) use text::name_of;
pub use text::paper_text;

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Serialize;

use super::Rate;
use crate::record::Rounded;

/// A group of descriptions.
///
/// The paper groups by what a landmark is for; its rule is not known. Ours
/// group by the furniture named: none, the table alone (beside `path`), other
/// furniture as well (beside `goal`). The groups are not the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Column {
    /// All descriptions.
    All,
    /// No furniture named; in the paper, no landmark.
    None,
    /// The table alone is named; in the paper, a landmark on the path.
    Path,
    /// Other furniture is named as well; in the paper, a landmark at the goal.
    Goal,
    /// Descriptions that begin with the way.
    How,
    /// Descriptions that begin with the object.
    Where,
}

impl Column {
    /// All, in the order of the tables.
    pub const ALL: [Self; 6] = [Self::All, Self::None, Self::Path, Self::Goal, Self::How, Self::Where];

    /// The column's heading.
    pub const fn heading(self) -> &'static str {
        match self {
            Self::All => "all",
            Self::None => "none",
            Self::Path => "table (path)",
            Self::Goal => "other (goal)",
            Self::How => "how",
            Self::Where => "where",
        }
    }
}

/// One figure: a percentage, with its count and Wilson interval where they are known.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Cell {
    /// Per cent.
    pub percent: Rounded,
    /// The count behind it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub count: Option<Rate>,
}

impl Cell {
    fn of(hit: usize, of: usize) -> Self {
        Self::from(Rate { hit, of })
    }

    fn percent(percent: f64) -> Self {
        Self { percent: percent.into(), count: None }
    }
}

impl From<Rate> for Cell {
    fn from(rate: Rate) -> Self {
        Self { percent: (100.0 * rate.share()).into(), count: Some(rate) }
    }
}

/// Whose figures they are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Source {
    /// Published.
    Paper,
    /// Measured now.
    Ours,
}

/// A row of figures.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Row {
    /// What was run.
    pub name: String,
    /// Whose figures they are.
    pub source: Source,
    /// What counts as a success; the paper's measure is the table's own.
    pub measure: String,
    /// The figures.
    pub cells: BTreeMap<Column, Cell>,
    /// Mean success weighted by path length.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spl: Option<Rounded>,
}

/// A table of the paper.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct PaperTable {
    /// `Table I: …`.
    pub title: String,
    /// The paper's rows, then ours.
    pub rows: Vec<Row>,
}

/// All three tables.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Paper {
    /// The corpus's name.
    pub corpus: String,
    /// Its descriptions.
    pub descriptions: usize,
    /// Those that mean something different from all before them: the instructions that are driven.
    pub unique: usize,
    /// Seeds each is driven with.
    pub seeds: u64,
    /// What the robot's eyes report.
    pub perception: String,
    /// Tables I, II, III.
    pub tables: Vec<PaperTable>,
    /// What has to be known to read them.
    pub notes: Vec<String>,
}

#[cfg(test)]
mod tests;

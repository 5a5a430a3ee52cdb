//! Experiments with the robot: the paper's Tables II and III, ablations, and why the first furniture was wrong.

mod experiment;
mod explain;
mod instructions;
mod report;
mod study;
mod table;

pub use experiment::{Condition, Score, drive_all};
pub use explain::{Explanation, Fault, explain};
pub use instructions::{Instruction, Selection, Source, instructions};
pub use report::{BehaviorReport, Cell, ConditionReport, Fall};
pub use study::{Study, conditions, lacking};
pub use table::behavior_tables;

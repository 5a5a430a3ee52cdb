//! The figures of an experiment.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Serialize;

use super::{Explanation, Instruction, Score};
use crate::evaluation::Rate;
use crate::record::Rounded;

/// An experiment with the robot.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct BehaviorReport {
    /// Instructions.
    pub instructions: usize,
    /// Where they come from, and which of them.
    pub source: String,
    /// Trials of each, each with its own errors of odometry, sonar and start pose.
    pub seeds: u64,
    /// The figures, condition by condition.
    pub conditions: Vec<ConditionReport>,
    /// What the second placement costs, when there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fall: Option<Fall>,
    /// Why the first furniture was wrong, instruction by instruction.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub explanations: Vec<Explanation>,
}

/// The figures of one condition.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct ConditionReport {
    /// What it is called.
    pub name: String,
    /// All trials.
    pub all: Cell,
    /// By the furniture named.
    pub by_names: BTreeMap<String, Cell>,
}

/// The figures of some trials.
#[derive(Clone, Debug, Default, Serialize, JsonSchema)]
pub struct Cell {
    /// Trials in which the object was recognisable in the last picture.
    pub found: Rate,
    /// Trials in which the first furniture approached holds the object.
    pub right_first: Rate,
    /// Instructions whose first furniture was right in most of their trials: trials of one instruction are alike.
    pub instructions_right_first: Rate,
    /// Mean success weighted by path length.
    pub spl: Rounded,
    /// Mean way, metres.
    pub distance_m: Rounded,
    /// Mean robot time, seconds.
    pub duration_s: Rounded,
    /// Times the robot touched something, in all trials together.
    pub collisions: u32,
    /// The least distance to anything solid in any trial, metres.
    pub min_clearance_m: Rounded,
}

/// How many points of `right_first` are lost from one placement to the next.
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
pub struct Fall {
    /// Percentage points.
    pub points: Rounded,
    /// Lower end of the 95 % interval over instructions, each compared with itself.
    pub low: Rounded,
    /// Upper end.
    pub high: Rounded,
}

impl ConditionReport {
    /// The figures of all scores, one list for each instruction.
    pub fn new(name: &str, instructions: &[Instruction], scores: &[Vec<Score>]) -> Self {
        let mut groups: BTreeMap<String, Vec<&[Score]>> = BTreeMap::new();
        for (instruction, scores) in instructions.iter().zip(scores) {
            groups.entry(instruction.names.to_string()).or_default().push(scores);
        }
        let all: Vec<&[Score]> = scores.iter().map(Vec::as_slice).collect();
        let by_names = groups.into_iter().map(|(name, scores)| (name, Cell::new(&scores))).collect();
        Self { name: name.to_string(), all: Cell::new(&all), by_names }
    }
}

impl Cell {
    fn new(scores: &[&[Score]]) -> Self {
        let mut cell = Self { min_clearance_m: f64::INFINITY.into(), ..Self::default() };
        for instruction in scores {
            let right = instruction.iter().filter(|score| score.right_first).count();
            cell.instructions_right_first.count(2 * right > instruction.len());
            instruction.iter().for_each(|score| cell.add(score));
        }
        let trials = cell.found.of.max(1) as f64;
        for sum in [&mut cell.spl, &mut cell.distance_m, &mut cell.duration_s] {
            sum.0 /= trials;
        }
        cell
    }

    fn add(&mut self, score: &Score) {
        self.found.count(score.found);
        self.right_first.count(score.right_first);
        self.spl.0 += score.spl;
        self.distance_m.0 += score.distance_m;
        self.duration_s.0 += score.duration_s;
        self.collisions += score.collisions;
        self.min_clearance_m.0 = self.min_clearance_m.0.min(score.min_clearance_m);
    }
}

impl Fall {
    /// From the first scores to the second, instruction by instruction; normal approximation.
    pub fn between(first: &[Vec<Score>], second: &[Vec<Score>]) -> Option<Self> {
        let share = |scores: &Vec<Score>| {
            scores.iter().filter(|score| score.right_first).count() as f64 / scores.len().max(1) as f64
        };
        let differences: Vec<f64> = first.iter().zip(second).map(|(a, b)| 100.0 * (share(a) - share(b))).collect();
        let n = differences.len() as f64;
        if n < 2.0 {
            return None;
        }
        let mean = differences.iter().sum::<f64>() / n;
        let variance = differences.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / (n - 1.0);
        let half = 1.96 * (variance / n).sqrt();
        Some(Self { points: mean.into(), low: (mean - half).into(), high: (mean + half).into() })
    }
}

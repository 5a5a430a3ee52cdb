//! Instructions driven under several conditions, and all figures of it.

use super::{BehaviorReport, Condition, ConditionReport, Fall, Instruction, drive_all, explain};
use crate::behavior::Options;
use crate::simulation::{Home, TrialSettings};

/// What is driven.
#[derive(Clone, Debug)]
pub struct Study<'h> {
    /// What the robot is told.
    pub instructions: Vec<Instruction>,
    /// Where, and what the executive may do; the placements of the furniture come first.
    pub conditions: Vec<Condition<'h>>,
    /// How many of the conditions are placements with the whole executive.
    pub placements: usize,
    /// Eyes, noise, first seed.
    pub settings: TrialSettings,
    /// Trials of each instruction.
    pub seeds: u64,
    /// Say of each instruction that went wrong whether its words allow it.
    pub explained: bool,
}

/// The whole executive in each home, then, in the first, blind and – with `ablations` – without each of its parts.
pub fn conditions<'h>(homes: &'h [(&str, Home)], ablations: bool) -> Vec<Condition<'h>> {
    let condition = |name: &str, home, options| Condition { name: name.to_string(), home, options };
    let placements = homes.iter().map(|(name, home)| condition(name, home, Options::default()));
    let shown = if ablations { usize::MAX } else { 1 };
    let lacking = homes.iter().take(1).flat_map(|(_, home)| {
        lacking().into_iter().take(shown).map(move |(name, options)| condition(name, home, options))
    });
    placements.chain(lacking).collect()
}

/// The executive without each of its parts, blind first.
///
/// It goes straight to an object that it recognises in passing, and so makes good what a poor reading of the words
/// costs: what the pairs, the frames and the fall-back are worth shows without that glance.
pub fn lacking() -> [(&'static str, Options); 9] {
    let usual = Options::default();
    let no_glance = Options { no_glance: true, ..usual };
    [
        ("blind: nearest table first", Options { blind: true, ..usual }),
        ("first pair, as previous system", Options { first_pair_only: true, ..usual }),
        ("one frame of reference", Options { one_frame: true, ..usual }),
        ("no fall-back", Options { no_fallback: true, ..usual }),
        ("no localization", Options { no_localization: true, ..usual }),
        ("no glance: words alone choose", no_glance),
        ("no glance, first pair only", Options { first_pair_only: true, ..no_glance }),
        ("no glance, one frame of reference", Options { one_frame: true, ..no_glance }),
        ("no glance, no fall-back", Options { no_fallback: true, ..no_glance }),
    ]
}

impl Study<'_> {
    /// Trials in all.
    pub fn trials(&self) -> u64 {
        self.seeds * (self.instructions.len() * self.conditions.len()) as u64
    }

    /// Drives everything; `done` hears of every trial that ends.
    pub fn run(&self, source: &str, done: &(dyn Fn() + Sync)) -> BehaviorReport {
        let mut report = BehaviorReport {
            instructions: self.instructions.len(),
            source: source.to_string(),
            seeds: self.seeds,
            conditions: Vec::new(),
            fall: None,
            explanations: Vec::new(),
        };
        let mut placements = Vec::new();
        for (i, condition) in self.conditions.iter().enumerate() {
            let scores = drive_all(&self.instructions, condition, &self.settings, self.seeds, done);
            report.conditions.push(ConditionReport::new(&condition.name, &self.instructions, &scores));
            if i >= self.placements {
                continue;
            }
            if self.explained {
                let explanations = explain(&condition.name, condition.home, &self.instructions, &scores);
                report.explanations.extend(explanations);
            }
            placements.push(scores);
        }
        if let [first, second] = placements.as_slice() {
            report.fall = Fall::between(first, second);
        }
        report
    }
}

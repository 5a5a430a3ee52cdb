//! What trials of one experiment came to.

use schemars::JsonSchema;
use serde::Serialize;

use crate::evaluation::Rate;
use crate::record::{Outcome, Rounded, Trial};

/// Counts of one experiment.
#[derive(Clone, Debug, Default, Serialize, JsonSchema)]
pub struct Tally {
    /// What was tried.
    pub name: String,
    /// Trials driven.
    pub trials: usize,
    /// The object is recognisable in the last picture; for gold homes, on the right furniture, or arrived there.
    pub found: Rate,
    /// The first furniture approached holds the object.
    pub right_first: Rate,
    /// How often the robot touched something.
    pub collisions: u32,
    /// The least distance to anything solid in all trials, metres.
    pub min_clearance_m: Option<Rounded>,
    /// Worlds that could not be made; their trials count as not found.
    pub not_made: Vec<String>,
    /// Trials that did not find it, with the reason.
    pub failures: Vec<String>,
}

/// What one trial counts.
#[derive(Clone, Debug)]
pub struct Counted {
    pub id: String,
    pub found: bool,
    pub right_first: bool,
    pub trial: Trial,
}

impl Counted {
    /// A trial that is good when it found the object.
    pub fn found(id: String, trial: Trial) -> Self {
        let (found, right_first) = (trial.outcome == Outcome::Found, trial.right_first == Some(true));
        Self { id, found, right_first, trial }
    }
}

impl Tally {
    /// Adds up trials in their order; `Err` names a world that could not be made.
    pub fn of(name: &str, results: Vec<Result<Counted, String>>) -> Self {
        let mut tally = Self { name: name.to_string(), ..Self::default() };
        for result in results {
            match result {
                Ok(counted) => tally.add(&counted),
                Err(id) => {
                    tally.found.count(false);
                    tally.right_first.count(false);
                    tally.not_made.push(id);
                }
            }
        }
        tally
    }

    fn add(&mut self, counted: &Counted) {
        let trial = &counted.trial;
        self.trials += 1;
        self.found.count(counted.found);
        self.right_first.count(counted.right_first);
        self.collisions += trial.collisions;
        if let Some(clearance) = trial.min_clearance_m {
            let least = self.min_clearance_m.map_or(clearance.0, |least| least.0.min(clearance.0));
            self.min_clearance_m = Some(least.into());
        }
        if !counted.found {
            self.failures.push(format!("{}: {}", counted.id, trial.why));
        }
    }
}

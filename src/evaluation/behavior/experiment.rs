//! Instructions driven many times over, and what each trial was worth.

use rayon::prelude::*;

use super::Instruction;
use crate::behavior::{Options, Silent};
use crate::geometry::Pose;
use crate::record::{Outcome, Trial};
use crate::simulation::{Home, TrialSettings, run, stream_of};

/// One column of figures: a home, and what the executive may do in it.
#[derive(Clone, Debug)]
pub struct Condition<'h> {
    /// What it is called.
    pub name: String,
    /// Where.
    pub home: &'h Home,
    /// What the executive may do.
    pub options: Options,
}

/// What is kept of a trial.
#[derive(Clone, Debug)]
pub struct Score {
    /// The object is recognisable in the last picture.
    pub found: bool,
    /// The first furniture approached holds the object.
    pub right_first: bool,
    /// Success weighted by path length.
    pub spl: f64,
    /// Metres driven.
    pub distance_m: f64,
    /// Seconds of robot time.
    pub duration_s: f64,
    /// Times it touched something.
    pub collisions: u32,
    /// Least distance to anything solid, metres.
    pub min_clearance_m: f64,
    /// The first furniture approached.
    pub first: Option<String>,
    /// Where the robot believed to be when the search began.
    pub arrived: Option<Pose>,
    /// Why it ended as it did.
    pub why: String,
}

/// Drives every instruction with `seeds` seeds from the settings' own on; scores by instruction, then by seed.
///
/// `done` hears of every trial that ends. The scores are the same for any number of threads.
pub fn drive_all(
    instructions: &[Instruction],
    condition: &Condition,
    settings: &TrialSettings,
    seeds: u64,
    done: &(dyn Fn() + Sync),
) -> Vec<Vec<Score>> {
    let trial = |instruction: &Instruction, seed: u64| {
        let settings = TrialSettings { options: condition.options, seed: settings.seed + seed, ..*settings };
        let stream = stream_of(&instruction.id);
        let ran = run(condition.home, &instruction.plan, &settings, stream, &mut Silent);
        done();
        Score::of(ran.trial)
    };
    let pairs: Vec<(&Instruction, u64)> = instructions.iter().flat_map(|i| (0..seeds).map(move |s| (i, s))).collect();
    let scores: Vec<Score> = pairs.par_iter().map(|(instruction, seed)| trial(instruction, *seed)).collect();
    let mut scores = scores.into_iter();
    instructions.iter().map(|_| scores.by_ref().take(seeds as usize).collect()).collect()
}

impl Score {
    fn of(trial: Trial) -> Self {
        let search = trial.actions.iter().find(|action| action.action == "search").map(|action| action.start_s.0);
        let reached = |start: f64| trial.path.iter().rfind(|point| point.0.0 <= start + 1e-6).map(|point| point.pose());
        Self {
            found: trial.outcome == Outcome::Found,
            right_first: trial.right_first == Some(true),
            spl: trial.spl.map_or(0.0, |spl| spl.0),
            distance_m: trial.distance_m.0,
            duration_s: trial.duration_s.0,
            collisions: trial.collisions,
            min_clearance_m: trial.min_clearance_m.map_or(f64::INFINITY, |metres| metres.0),
            arrived: search.and_then(reached),
            first: trial.approached.into_iter().next(),
            why: trial.why,
        }
    }
}

//! The experiments: each a list of trials run in parallel, counted in order.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::gold_home::{GoldHome, home_for};
use super::own_homes::OwnHome;
use super::tally::{Counted, Tally};
use super::{GoldLine, own_homes};
use crate::behavior::Silent;
use crate::evaluation::{Gold, GoldError};
use crate::grounding::{Grounder, Method};
use crate::language::{Lexicon, chunk_text};
use crate::planning::Planner;
use crate::record::{Grounding, Outcome, Plan, Trial};
use crate::simulation::arrange::{Relations, rearranged};
use crate::simulation::{Dice, Home, TrialSettings, run, stream_of};

/// How an experiment is run.
#[derive(Clone, Copy)]
pub struct Experiment<'a> {
    /// How each trial is run; its seed is the first.
    pub settings: TrialSettings,
    /// Trials of each description, with a seed each.
    pub seeds: u64,
    /// Told of each trial that is done.
    pub done: &'a (dyn Fn() + Sync),
}

impl Experiment<'_> {
    fn trial(&self, home: &Home, plan: &Plan, id: &str, seed: u64) -> Trial {
        let settings = TrialSettings { seed: self.settings.seed.wrapping_add(seed), ..self.settings };
        let trial = run(home, plan, &settings, stream_of(id), &mut Silent).trial;
        (self.done)();
        trial
    }
}

/// Random placements of a home's furniture, a description of `gold` in each, in turn.
pub fn placements(gold: &[Gold], home: &Home, relations: Relations, count: usize, experiment: &Experiment) -> Tally {
    let name = match relations {
        Relations::Kept => "placements that keep the relations",
        Relations::Broken => "placements that break the relations",
    };
    let plans = plans_of(gold, home);
    let one = |i: usize| -> Vec<Result<Counted, String>> {
        let (gold, plan) = &plans[i % plans.len()];
        let id = format!("{}-{i}", gold.id);
        let mut dice = Dice::new(experiment.settings.seed, i as u64);
        let Some(scene) = rearranged(&home.map, &home.scene, relations, &mut dice) else { return vec![Err(id)] };
        let home = Home::new(home.map.clone(), scene);
        (0..experiment.seeds)
            .map(|seed| Ok(Counted::found(id.clone(), experiment.trial(&home, plan, &id, seed))))
            .collect()
    };
    let count = if plans.is_empty() { 0 } else { count };
    Tally::of(name, (0..count).into_par_iter().flat_map_iter(one).collect())
}

/// The other shipped homes, each with its own descriptions.
///
/// # Errors
/// When the shipped descriptions of a home are no gold, which a test refuses.
pub fn homes(experiment: &Experiment) -> Result<Vec<Tally>, GoldError> {
    let tally = |OwnHome { name, home, gold }: OwnHome| {
        let one = |(gold, plan): &(&Gold, Plan)| {
            let trial = |seed| Ok(Counted::found(gold.id.clone(), experiment.trial(&home, plan, &gold.id, seed)));
            (0..experiment.seeds).map(trial).collect::<Vec<_>>()
        };
        Tally::of(name, plans_of(&gold, &home).par_iter().flat_map_iter(one).collect())
    };
    Ok(own_homes()?.into_iter().map(tally).collect())
}

/// For each gold grounding a home in which it is true, driven by the gold grounding or, where `texts` are given, by the text.
pub fn gold_homes(gold: &[GoldLine], texts: Option<&BTreeMap<String, String>>, experiment: &Experiment) -> Tally {
    let grounder = Grounder::new(Method::Composed, true);
    let one = |line: &GoldLine| -> Vec<Result<Counted, String>> {
        let mut dice = Dice::new(experiment.settings.seed, stream_of(&line.id));
        let made = home_for(&line.grounding, Lexicon::embedded(), &mut dice);
        let text = texts.map(|texts| texts.get(&line.id));
        let (Some(GoldHome { home, target }), None | Some(Some(_))) = (made, text) else {
            return vec![Err(line.id.clone())];
        };
        let grounding = text.flatten().map_or_else(|| line.grounding.clone(), |text| understood(&grounder, text));
        let plan = Planner::new(home.map.clone()).plan(&grounding);
        (0..experiment.seeds)
            .map(|seed| {
                let trial = experiment.trial(&home, &plan, &line.id, seed);
                let there = trial.target_id.as_ref() == Some(&target)
                    || (trial.outcome == Outcome::Arrived && trial.approached.last() == Some(&target));
                let found = there && matches!(trial.outcome, Outcome::Found | Outcome::Arrived);
                let right_first = trial.approached.first() == Some(&target);
                Ok(Counted { id: line.id.clone(), found, right_first, trial })
            })
            .collect()
    };
    let name = if texts.is_some() { "gold homes, from the text" } else { "gold homes, gold instructions" };
    Tally::of(name, gold.par_iter().flat_map_iter(one).collect())
}

fn plans_of<'g>(gold: &'g [Gold], home: &Home) -> Vec<(&'g Gold, Plan)> {
    let (grounder, planner) = (Grounder::new(Method::Composed, true), Planner::new(home.map.clone()));
    gold.iter().map(|gold| (gold, planner.plan(&understood(&grounder, &gold.text)))).collect()
}

fn understood(grounder: &Grounder, text: &str) -> Grounding {
    let (tokens, chunks) = chunk_text(text);
    grounder.ground(text, &tokens, &chunks)
}

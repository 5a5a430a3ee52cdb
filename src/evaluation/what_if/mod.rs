//! The smallest changes that would have led elsewhere: of the words, and of where the furniture stands.

mod shifts;
mod text;
mod words;

pub use shifts::Shift;
pub use text::what_if_text;
pub use words::Wording;

use schemars::JsonSchema;
use serde::Serialize;

use super::Pipeline;
use crate::record::{Outcome, Plan};
use crate::simulation::{Home, TrialSettings};

/// What a trial comes to: where it goes first, and how it ends.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Upshot {
    /// The furniture approached first.
    pub first: Option<String>,
    /// How it ends.
    pub outcome: Outcome,
}

/// What would change the upshot of one description.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct WhatIf {
    /// The description's id.
    pub id: String,
    /// The description.
    pub text: String,
    /// What it comes to as it is.
    pub now: Upshot,
    /// Changes of as few words as possible that change it: one word, or two where no single one does.
    pub words: Vec<Wording>,
    /// For each piece of furniture the smallest shift that changes it.
    pub shifts: Vec<Shift>,
}

/// Tries words, and shifts of the pieces of furniture named, or of all when none is.
pub fn what_if(id: &str, text: &str, home: &Home, settings: &TrialSettings, pieces: &[String]) -> WhatIf {
    let pipeline = Pipeline::new(home, *settings);
    let plan = pipeline.understand(text).plan;
    let now = upshot(&pipeline, id, &plan);
    let words = words::changes(&pipeline, id, text, &now);
    let shifts = shifts::Trial { home, settings, id, plan: &plan, now: &now }.changes(pieces);
    WhatIf { id: id.to_string(), text: text.to_string(), now, words, shifts }
}

fn upshot(pipeline: &Pipeline, id: &str, plan: &Plan) -> Upshot {
    let trial = pipeline.drive(id, plan).trial;
    Upshot { first: trial.approached.first().cloned(), outcome: trial.outcome }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_side_that_picks_the_room_and_the_table_that_is_chosen_are_found_out() {
        let text = "the mug is in the room on the left on the table with the chairs";
        let home = Home::load(None, None).expect("the apartment");
        let found = what_if("1", text, &home, &TrialSettings::default(), &["hexagon-table-1".to_string()]);
        assert_eq!(found.now.first.as_deref(), Some("hexagon-table-1"));
        let side = found.words.iter().find(|w| w.change == "left → right").expect("the side matters");
        assert_ne!(side.then.first.as_deref(), Some("hexagon-table-1"));
        assert_eq!(found.shifts.len(), 1);
        assert!(found.shifts[0].metres.is_none_or(|metres| metres.0 > 0.0), "{:?}", found.shifts);
    }
}

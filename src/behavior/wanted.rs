//! What a search asks for.

use crate::record::{Action, Plan, SearchPair};

/// What is searched.
#[derive(Clone, Debug, Default)]
pub struct Wanted {
    /// Noun of the target furniture; any table-like furniture when none was said.
    pub target: Option<String>,
    /// Colour, size, shape, as said.
    pub attributes: Vec<String>,
    /// "The second table", counted from 1 in the order of distance.
    pub ordinal: Option<u32>,
    /// The pairs, in the order spoken.
    pub pairs: Vec<SearchPair>,
    /// Only readings in each pair's first frame.
    pub one_frame: bool,
    /// By distance alone, whatever the heading.
    pub nearest_first: bool,
}

impl Wanted {
    /// What the plan's search asks for.
    pub fn of_plan(plan: &Plan) -> Option<Self> {
        plan.actions.iter().find_map(|action| match action {
            Action::Search { target, attributes, ordinal, pairs } => Some(Self {
                target: target.clone(),
                attributes: attributes.clone(),
                ordinal: *ordinal,
                pairs: pairs.clone(),
                ..Self::default()
            }),
            _ => None,
        })
    }
}

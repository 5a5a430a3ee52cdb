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
    /// Furniture that is not looked at.
    pub not: Vec<String>,
    /// Only readings in each pair's first frame.
    pub one_frame: bool,
    /// By distance alone, whatever the heading.
    pub nearest_first: bool,
}

impl Wanted {
    /// Anything table-like, but for what is not looked at.
    pub fn anything(&self) -> Self {
        Self { not: self.not.clone(), ..Self::default() }
    }

    /// What the plan's first search asks for.
    pub fn of_plan(plan: &Plan) -> Option<Self> {
        Self::of(&plan.actions)
    }

    /// What the first search among actions asks for.
    pub fn of(actions: &[Action]) -> Option<Self> {
        actions.iter().find_map(|action| match action {
            Action::Search { target, attributes, ordinal, pairs, not } => Some(Self {
                target: target.clone(),
                attributes: attributes.clone(),
                ordinal: *ordinal,
                pairs: pairs.clone(),
                not: not.clone(),
                ..Self::default()
            }),
            _ => None,
        })
    }
}

//! What was lost, told once when it first happens, and counted.

use std::collections::BTreeMap;

use super::Loss;

/// Counts of losses by kind.
#[derive(Clone, Debug, Default)]
pub(super) struct Losses {
    counts: BTreeMap<&'static str, u64>,
}

impl Losses {
    /// Counts a loss; the first of its kind comes back to be told at once.
    pub(super) fn note(&mut self, kind: &'static str, what: String) -> Option<Loss> {
        let count = self.counts.entry(kind).or_default();
        *count += 1;
        (*count == 1).then_some(Loss(what))
    }

    /// What happened more than once, with the counts.
    pub(super) fn totals(&mut self) -> impl Iterator<Item = Loss> {
        let counts = std::mem::take(&mut self.counts);
        counts.into_iter().filter(|(_, n)| *n > 1).map(|(kind, n)| Loss(format!("in all {n} {kind}")))
    }
}

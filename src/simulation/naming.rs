//! One name for one piece: what the robot tells of furniture, by the names of the scene.
//!
//! The robot counts what it sees – "table 1" is the first table that it saw –, so that a piece has another name in
//! every trial. Those who look on know the truth and want one name for one piece. Only the words change, after the
//! robot has decided.

use std::collections::{BTreeMap, HashMap};

use super::Scene;
use crate::behavior::{Furniture, Report, Watcher};
use crate::frame::RgbdFrame;
use crate::geometry::{ClearanceGrid, Pose};
use crate::perception::View;
use crate::recording::spoken;
use crate::robot::MobileBase;

/// Renames furniture in all that is passed on.
pub(super) struct Naming<'a> {
    scene: &'a Scene,
    inner: &'a mut dyn Watcher,
    /// From the robot's names to those of the scene.
    names: BTreeMap<String, String>,
    /// What was said, and how it reads with the names of that time.
    said: HashMap<String, String>,
}

impl<'a> Naming<'a> {
    /// Passes on to `inner`.
    pub fn new(scene: &'a Scene, inner: &'a mut dyn Watcher) -> Self {
        Self { scene, inner, names: BTreeMap::new(), said: HashMap::new() }
    }

    /// Renames the furniture in a report, as it was told while it was made.
    pub fn rename(&self, report: &mut Report) {
        let told = |text: &str| self.said.get(text).cloned().unwrap_or_else(|| renamed(text, &self.names));
        for action in &mut report.journal.actions {
            action.result = told(&action.result);
            action.why = action.why.split("; ").map(told).collect::<Vec<_>>().join("; ");
        }
        report.why = told(&report.why);
    }

    /// The scene's name of a piece; one that is not there is said to be supposed only.
    fn name_of(&self, piece: &Furniture) -> String {
        let item = self.scene.furniture_at(piece.centre());
        item.map_or_else(|| format!("supposed {}", piece.label()), |item| spoken(&item.id))
    }
}

impl Watcher for Naming<'_> {
    fn sensed(&mut self, base: &dyn MobileBase) {
        self.inner.sensed(base);
    }

    fn frame(&mut self, time_s: f64, believed: Pose, frame: &RgbdFrame) {
        self.inner.frame(time_s, believed, frame);
    }

    fn seen(&mut self, time_s: f64, view: &View) {
        self.inner.seen(time_s, view);
    }

    fn grid(&mut self, time_s: f64, grid: &ClearanceGrid) {
        self.inner.grid(time_s, grid);
    }

    fn said(&mut self, time_s: f64, text: &str) {
        let new = renamed(text, &self.names);
        self.inner.said(time_s, &new);
        if new != text {
            self.said.insert(text.to_string(), new);
        }
    }

    fn told(&mut self, time_s: f64, plain: &str) {
        self.inner.told(time_s, &renamed(plain, &self.names));
    }

    fn furniture(&mut self, time_s: f64, furniture: &[Furniture]) {
        self.names.clear();
        let named: Vec<Furniture> = furniture.iter().map(|piece| piece.named(self.name_of(piece))).collect();
        self.names.extend(furniture.iter().map(Furniture::label).zip(named.iter().map(Furniture::label)));
        self.inner.furniture(time_s, &named);
    }

    fn wants_stop(&self) -> bool {
        self.inner.wants_stop()
    }
}

/// The text with each of `names` put in place of its key, the longest first, whole words only.
fn renamed(text: &str, names: &BTreeMap<String, String>) -> String {
    let mut new = String::with_capacity(text.len());
    let mut rest = text;
    let mut is_start = true;
    while let Some(c) = rest.chars().next() {
        let fits = |label: &&String| {
            let after = rest.strip_prefix(label.as_str()).map(|after| after.chars().next());
            after.is_some_and(|next| next.is_none_or(|c| !c.is_alphanumeric()))
        };
        let longest = names.keys().filter(fits).max_by_key(|label| label.len()).filter(|_| is_start);
        let length = longest.map_or(c.len_utf8(), String::len);
        new.push_str(longest.map_or(&rest[..length], |label| names[label].as_str()));
        is_start = !c.is_alphanumeric() && longest.is_none();
        rest = &rest[length..];
    }
    new
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_names_are_replaced_and_the_longest_first() {
        let names = [("table 1", "hexagon table 1"), ("coffee table 1", "coffee table 2"), ("table 10", "desk 1")];
        let names = names.map(|(old, new)| (old.to_string(), new.to_string())).into();
        let text = "coffee table 1 0.72 before table 1 0.63, table 10; portable 1 and table 12";
        let want = "coffee table 2 0.72 before hexagon table 1 0.63, desk 1; portable 1 and table 12";
        assert_eq!(renamed(text, &names), want);
    }
}

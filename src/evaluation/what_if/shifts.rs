//! Furniture shifted until the trial comes to something else.

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;

use super::{Upshot, upshot};
use crate::evaluation::Pipeline;
use crate::record::{Plan, Rounded};
use crate::simulation::check;
use crate::simulation::{Home, TrialSettings};

/// The smallest shift of one piece that changes the upshot.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Shift {
    /// The piece.
    pub id: String,
    /// How far it has to be shifted; null when no shift that was tried and leaves the home possible changes anything.
    pub metres: Option<Rounded>,
    /// Whereto, degrees counter-clockwise from east.
    pub heading_deg: Option<f64>,
    /// What the trial comes to then.
    pub then: Option<Upshot>,
}

/// East, north, west, south.
const HEADINGS_DEG: [f64; 4] = [0.0, 90.0, 180.0, 270.0];
/// Tried in turn; between the last without and the first with a change it is halved.
const LADDER_M: [f64; 8] = [0.1, 0.2, 0.4, 0.6, 0.8, 1.2, 1.6, 2.4];
/// Fine enough: a centimetre.
const FINE_M: f64 = 0.01;

/// The trial whose upshot is to change.
pub(super) struct Trial<'a> {
    pub home: &'a Home,
    pub settings: &'a TrialSettings,
    pub id: &'a str,
    pub plan: &'a Plan,
    pub now: &'a Upshot,
}

impl Trial<'_> {
    /// The smallest shift of each piece of furniture named, or of all when none is.
    pub fn changes(&self, pieces: &[String]) -> Vec<Shift> {
        let furniture = &self.home.scene.furniture;
        let wanted = |item: &usize| pieces.is_empty() || pieces.contains(&furniture[*item].id);
        let items: Vec<usize> = (0..furniture.len()).filter(wanted).collect();
        let tasks: Vec<(usize, f64)> =
            items.iter().flat_map(|&item| HEADINGS_DEG.map(move |heading| (item, heading))).collect();
        let found: Vec<Option<Shift>> = tasks.par_iter().map(|&(item, heading)| self.smallest(item, heading)).collect();
        let least = |(shifts, item): (&[Option<Shift>], &usize)| {
            let none = Shift { id: furniture[*item].id.clone(), metres: None, heading_deg: None, then: None };
            shifts.iter().flatten().min_by(|a, b| metres(a).total_cmp(&metres(b))).cloned().unwrap_or(none)
        };
        found.chunks(HEADINGS_DEG.len()).zip(&items).map(least).collect()
    }

    /// By a ladder of shifts, then by halving; a change that comes and goes between two rungs is not seen.
    fn smallest(&self, item: usize, heading_deg: f64) -> Option<Shift> {
        let mut without = 0.0;
        for rung in LADDER_M {
            match self.shifted(item, heading_deg, rung) {
                Some(then) if then != *self.now => return Some(self.halve(item, heading_deg, without, rung, then)),
                Some(_) => without = rung,
                // Where it cannot stand, it may a little farther.
                None => {}
            }
        }
        None
    }

    fn halve(&self, item: usize, heading_deg: f64, mut without: f64, mut with: f64, mut then: Upshot) -> Shift {
        while with - without > FINE_M {
            let middle = (with + without) / 2.0;
            match self.shifted(item, heading_deg, middle) {
                Some(upshot) if upshot != *self.now => (with, then) = (middle, upshot),
                _ => without = middle,
            }
        }
        let id = self.home.scene.furniture[item].id.clone();
        // To the centimetre, upward: the shift named does change it.
        let metres = Rounded((with * 100.0).ceil() / 100.0);
        Shift { id, metres: Some(metres), heading_deg: Some(heading_deg), then: Some(then) }
    }

    /// What the trial comes to with the piece shifted; nothing where it cannot stand.
    fn shifted(&self, item: usize, heading_deg: f64, metres: f64) -> Option<Upshot> {
        let mut scene = self.home.scene.clone();
        let piece = scene.furniture.get_mut(item)?;
        let (sin, cos) = heading_deg.to_radians().sin_cos();
        (piece.x, piece.y) = (piece.x + cos * metres, piece.y + sin * metres);
        let home = Home::new(self.home.map.clone(), scene);
        check(&home.scene, &home.map, "the home with a piece shifted").ok()?;
        Some(upshot(&Pipeline::new(&home, *self.settings), self.id, self.plan))
    }
}

/// Metres of a shift; none at all counts as farthest.
pub(super) fn metres(shift: &Shift) -> f64 {
    shift.metres.map_or(f64::INFINITY, |metres| metres.0)
}

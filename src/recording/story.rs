//! A watcher that keeps what is needed to show a trial again, step by step.

use std::sync::{Mutex, PoisonError};

use crate::behavior::{Furniture, Run, Watcher};
use crate::geometry::Vec2;
use crate::perception::View;

/// A piece as the robot believed in it: its name, and its corners in metres.
pub type BelievedPiece = (String, Vec<Vec2>);

/// What the robot saw, believed and decided, each with the robot's seconds.
#[derive(Clone, Debug, Default)]
pub struct Story {
    /// What it did and why, in plain words.
    pub told: Vec<(f64, String)>,
    /// All it believed of the furniture, each time that changed.
    pub believed: Vec<(f64, Vec<BelievedPiece>)>,
    /// When it looked.
    pub looks: Vec<f64>,
}

impl Watcher for Story {
    fn told(&mut self, time_s: f64, plain: &str) {
        self.told.push((time_s, plain.to_string()));
    }

    fn furniture(&mut self, time_s: f64, furniture: &[Furniture]) {
        let there = furniture.iter().filter(|piece| !piece.is_refuted());
        self.believed
            .push((time_s, there.map(|piece| (piece.label(), piece.footprint().corners().to_vec())).collect()));
    }

    fn seen(&mut self, time_s: f64, _view: &View) {
        self.looks.push(time_s);
    }
}

/// A trial with its story, to be shown.
#[derive(Clone, Debug)]
pub struct Told {
    /// The record as `drive` writes it.
    pub line: String,
    /// The trial.
    pub run: Run,
    /// What the camera showed at the end, PNG, where there is a camera.
    pub picture: Option<Vec<u8>>,
    /// What happened on the way.
    pub story: Story,
}

/// The trials of a run, in the order in which they end.
#[derive(Debug, Default)]
pub struct Stories(Mutex<Vec<Told>>);

impl Stories {
    /// Adds a trial.
    pub fn tell(&self, told: Told) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(told);
    }

    /// All trials so far; none are left.
    pub fn take(&self) -> Vec<Told> {
        std::mem::take(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

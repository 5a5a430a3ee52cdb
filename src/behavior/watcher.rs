//! Someone who looks on: a recording, a live view. Nobody by default.

use super::Furniture;
use crate::frame::RgbdFrame;
use crate::geometry::{ClearanceGrid, Pose};
use crate::perception::View;
use crate::robot::MobileBase;

/// Hears of everything the executive does, as it happens. Times are the robot's seconds.
pub trait Watcher {
    /// A control period has passed: where the robot believes it is, how it moves, what its sonars hear.
    fn sensed(&mut self, _base: &dyn MobileBase) {}
    /// The eyes looked through a camera, and this is its frame.
    fn frame(&mut self, _time_s: f64, _believed: Pose, _frame: &RgbdFrame) {}
    /// What the eyes made of a look.
    fn seen(&mut self, _time_s: f64, _view: &View) {}
    /// The grid on which ways are planned has changed.
    fn grid(&mut self, _time_s: f64, _grid: &ClearanceGrid) {}
    /// A decision or an event, with its reason.
    fn said(&mut self, _time_s: f64, _text: &str) {}
    /// The same in plain words, without figures.
    fn told(&mut self, _time_s: f64, _plain: &str) {}
    /// What the robot believes of the furniture has changed.
    fn furniture(&mut self, _time_s: f64, _furniture: &[Furniture]) {}
    /// Asked at every tick: end the trial now?
    fn wants_stop(&self) -> bool {
        false
    }
}

/// Nobody looks on.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Watcher for Silent {}

/// Several who look on.
#[derive(Default)]
pub struct Several<'a>(pub Vec<&'a mut dyn Watcher>);

impl Watcher for Several<'_> {
    fn sensed(&mut self, base: &dyn MobileBase) {
        self.0.iter_mut().for_each(|watcher| watcher.sensed(base));
    }

    fn frame(&mut self, time_s: f64, believed: Pose, frame: &RgbdFrame) {
        self.0.iter_mut().for_each(|watcher| watcher.frame(time_s, believed, frame));
    }

    fn seen(&mut self, time_s: f64, view: &View) {
        self.0.iter_mut().for_each(|watcher| watcher.seen(time_s, view));
    }

    fn grid(&mut self, time_s: f64, grid: &ClearanceGrid) {
        self.0.iter_mut().for_each(|watcher| watcher.grid(time_s, grid));
    }

    fn said(&mut self, time_s: f64, text: &str) {
        self.0.iter_mut().for_each(|watcher| watcher.said(time_s, text));
    }

    fn told(&mut self, time_s: f64, plain: &str) {
        self.0.iter_mut().for_each(|watcher| watcher.told(time_s, plain));
    }

    fn furniture(&mut self, time_s: f64, furniture: &[Furniture]) {
        self.0.iter_mut().for_each(|watcher| watcher.furniture(time_s, furniture));
    }

    fn wants_stop(&self) -> bool {
        self.0.iter().any(|watcher| watcher.wants_stop())
    }
}

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

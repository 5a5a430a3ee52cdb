//! Someone who looks on: a recording, a live view. Nobody by default.

use super::Furniture;
use crate::geometry::Pose;

/// Hears of everything the executive does, as it happens. Times are the robot's seconds.
pub trait Watcher {
    /// The robot is here, as it believes.
    fn pose(&mut self, _time_s: f64, _pose: Pose) {}
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

//! The executive: runs a plan on a robot, tier by tier (Huo et al. 2014, section V).
//!
//! Upper tier ([`Executive`]): the three subtasks – enter the room, navigate
//! inside it, find the object. Lower tier: dynamic steps ([`motion`], by
//! odometry and room map) and the static search for the target furniture
//! ([`search`], by what the eyes report).
//!
//! It holds the room map and the robot's sensors, never the scene: what is
//! true is for the judge, outside. Every decision leaves a line that says why.

mod approach;
mod beliefs;
mod clearances;
mod delivery;
mod driving;
mod executive;
mod foresight;
mod free_space;
mod furniture;
mod getting_clear;
mod glimpses;
mod journal;
mod localizer;
pub mod motion;
mod names;
mod pilot;
mod progress;
mod regions;
mod relation;
mod route;
pub mod search;
mod static_tier;
mod telling;
mod trial_record;
mod trial_text;
mod visits;
mod wanted;
mod watcher;

pub use approach::Ways;
pub use beliefs::Beliefs;
pub use clearances::Clearances;
pub use executive::{Executive, MOST_PASSED_OVER, Options, Report};
pub use furniture::Furniture;
pub use journal::Journal;
pub use localizer::Localizer;
pub use pilot::{Halt, grid_of};
pub use relation::Place;
pub use route::{length, route};
pub use trial_record::{Run, note_of, object_of, plan_of, rounded};
pub use trial_text::{row_of, shade_of, text_of};
pub use watcher::{Several, Silent, Watcher};

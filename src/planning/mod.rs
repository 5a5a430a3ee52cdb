//! RDT nodes and room map → actions, for the three subtasks of the paper
//! (Huo et al. 2014, section V): enter the room, navigate inside it, find the object.
//!
//! Knows the room map and what was said; never furniture, and never the scene.
//! What the words of motion mean on the robot stands in `behavior::motion`.

mod actions;
mod frames;
mod nouns;
mod rooms;
mod stage;

pub use frames::frames_to_try;
pub use stage::Planner;

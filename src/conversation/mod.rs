//! Errand after errand with a person: what is said is understood, driven, and answered in words.
//!
//! A session keeps what one run of `drive` forgets: the question that waits for its answer, the errand that can be
//! corrected, and what was seen. It drives through [`crate::simulation::Driver`] and knows no more of the home than
//! what the robot told.

mod memory;
mod session;
mod utterance;

pub use memory::{Memory, SeenObject, SeenPiece};
pub use session::{Reply, Session};
pub use utterance::Utterance;

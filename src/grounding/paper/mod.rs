//! The published grounding (Huo, Alexenko, Skubic, IROS 2014, section IV): labelled examples decide.
//!
//! Step 1 gives a chunk its type, T = argmax P(t | tag) · S(tx, TX_t); step 2
//! gives each slot of that type its grounding, G = argmax P(g | tag) ·
//! S(tx, TX_g) · P(g | parent) · P(g | children), where S is one less the
//! smallest weighted Levenshtein distance to the texts TX of the candidate.
//!
//! - Read literally, S(tx, TX_tp) of the second equation compares with all
//!   texts of the type and cannot tell left from right; TX_g is the texts of
//!   the candidate grounding.
//! - Priors drown rarer groundings, so [`Factors::Similarity`] is the default;
//!   the other variants are there to show it.
//! - Priors are smoothed by adding one to the count of every candidate, so that
//!   a grounding seen under another parent is unlikely, not impossible. The
//!   parent term conditions on the parent's tag, the child term on the set of
//!   the children's tags: with 36 descriptions nothing finer has counts.

mod distance;
mod example;
mod model;

pub use distance::weighted_distance;
pub use example::{Label, LabelledChunk, LabelledTree, TrainingError};
pub use model::{Distance, Factors, Model, ModelError, Options};

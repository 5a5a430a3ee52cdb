//! Chunk tree → room, RDT nodes and object. Never sees a map.
//!
//! Two methods: [`Method::Composed`] reads what the words of each chunk mean;
//! [`Method::Paper`] finds the nearest labelled example by the published
//! equations. Both give each chunk a [`Meaning`], which [`assemble`] puts
//! together.

mod answer;
mod assemble;
mod composed;
mod grounder;
mod meaning;
pub mod paper;
mod readings;
mod settings;
mod stage;
mod table;
mod words;

pub use answer::answer;
pub use assemble::assemble;
pub use grounder::{Grounder, Method};
pub use meaning::{Kind, Meaning, meaning_of_label, pair as usual_pair};
pub use settings::{MethodName, Settings, SettingsError};
pub use stage::GroundStage;
pub use words::{ChunkWords, chunk_words, chunk_words_of};

//! Phrases or a chunk tree → room, RDT nodes, objects, destination and further errands. Never sees a map.
//!
//! Two methods: [`Method::Composed`] takes what the phrases mean and lets the
//! `story` put them together, knowing where in it it is; of a tree from
//! elsewhere it reads each chunk by the same grammar. [`Method::Paper`] finds
//! the nearest labelled example by the published equations. Meanings of
//! chunks are put together by [`assemble`].

mod answer;
mod assemble;
mod composed;
mod confidence;
mod doubts;
mod grounder;
mod meaning;
pub mod paper;
mod phrase_pairs;
mod readings;
mod settings;
mod stage;
mod story;
mod table;
mod words;

pub use answer::answer;
pub use assemble::assemble;
pub use grounder::{Grounder, Method};
pub use meaning::{Kind, Meaning, meaning_of_label, pair as usual_pair};
pub use settings::{MethodName, Settings, SettingsError};
pub use stage::GroundStage;
pub use words::{ChunkWords, chunk_words, chunk_words_of};

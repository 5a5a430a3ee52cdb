//! Experiments, metrics and tables: what the system reads, understands and finds, against gold.

pub mod behavior;
mod brackets;
mod furniture;
mod furniture_gold;
mod furniture_table;
mod gold;
mod interval;
mod labelled;
mod model;
mod score;
mod table;
mod token_gold;
mod training_frame;

pub use brackets::{Bracket, brackets_of};
pub use furniture::{FurnitureScores, SeenGroup, kind_of, score_furniture};
pub use furniture_gold::{GoldFrame, GoldItem, gold_frames};
pub use furniture_table::furniture_tables;
pub use gold::{Gold, GoldError, read_gold};
pub use interval::Rate;
pub use labelled::{LabelledChunk, LabelledTree, TreeError, parse_tree};
pub use model::training_record;
pub use score::{Group, Scores, run_corpus, score};
pub use table::text_tables;
pub use training_frame::write_training_frame;

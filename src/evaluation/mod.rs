//! Experiments, metrics and tables: what the system reads, understands and finds, against gold.

pub mod behavior;
mod brackets;
mod chunking;
mod furniture;
mod furniture_gold;
mod furniture_table;
mod gold;
mod grounding;
mod import;
mod interval;
mod labelled;
mod meaning_gold;
mod model;
mod score;
mod table;
mod training_frame;
mod treebank;

pub use brackets::{Bracket, brackets_of};
pub use chunking::{ChunkingScores, TagScores, chunking_table, score_chunking};
pub use furniture::{FurnitureScores, SeenGroup, kind_of, score_furniture};
pub use furniture_gold::{GoldFrame, GoldItem, gold_frames};
pub use furniture_table::furniture_tables;
pub use gold::{Gold, GoldError, Rules, read_gold};
pub use grounding::{
    Bin, Disagreement, Experiment, GroundingScores, Kept, MeaningRates, Noise, SplitScores, Spread, TreeRates,
    evaluate_grounding, grounding_table, misheard,
};
pub use import::{ImportError, Imported, import};
pub use interval::Rate;
pub use labelled::{LabelledChunk, LabelledTree, TreeError, parse_tree};
pub use model::training_record;
pub use score::{Group, Scores, run_corpus, score};
pub use table::text_tables;
pub use training_frame::write_training_frame;

//! Experiments, metrics and tables: what the system reads, understands and finds, against gold.

pub mod behavior;
mod blame;
mod brackets;
mod chunking;
mod compare;
mod furniture;
mod furniture_gold;
mod furniture_table;
mod gold;
mod gold_reader;
mod grounding;
mod import;
mod interval;
mod labelled;
mod meaning_gold;
mod merge;
mod model;
mod paper;
mod pipeline;
mod report;
pub mod robustness;
mod score;
mod table;
mod training_frame;
mod treebank;

mod what_if;

pub use blame::{Blame, Blames, Stage, Wanted, blame, blame_text, meaning_phrase};
pub use brackets::{Bracket, brackets_of};
pub use chunking::{ChunkingScores, TagScores, chunking_table, score_chunking};
pub use compare::{Change, CompareError, Comparison, Measure, compare, comparison_text, mcnemar_exact};
pub use furniture::{FurnitureScores, SeenGroup, score_furniture};
pub use furniture_gold::{GoldFrame, GoldItem, gold_frames};
pub use furniture_table::furniture_tables;
pub use gold::{Gold, GoldError, Rules};
pub use gold_reader::read_gold;
pub use grounding::{
    Bin, Disagreement, Experiment, GroundingScores, Kept, MeaningRates, Noise, SplitScores, Spread, TreeRates,
    evaluate_grounding, grounding_table, misheard,
};
pub use import::{ImportError, Imported, import};
pub use interval::Rate;
pub use labelled::{LabelledChunk, LabelledTree, TreeError, parse_tree};
pub use meaning_gold::with_texts;
pub use merge::{merge_scores, only_with_records};
pub use model::training_record;
pub use paper::{Case, Cell, Column, Experiments, Paper, PaperTable, Row, Source, paper_csv, paper_text};
pub use pipeline::{Pipeline, Understood};
pub use report::{write_report, write_trials};
pub use score::{Group, Scores, run_corpus, score};
pub use table::{csv_tables, text_tables};
pub use training_frame::write_training_frame;
pub use what_if::{Shift, WhatIf, Wording, what_if, what_if_text};

//! What the seven binaries share: arguments, JSON lines in and out,
//! diagnostics, exit codes, progress.
//!
//! The only room that prints or ends the process; it knows nothing of what a
//! stage computes.

mod arguments;
mod csv_input;
mod diagnostic;
mod exit;
mod eyes;
mod filter;
mod foreign;
mod frame_input;
mod home;
mod input;
mod interrupt;
mod line;
mod log_input;
mod number;
mod output;
mod paint;
mod program;
mod progress;
mod rows;
mod scores;
mod source;
mod threads;
mod trial_options;

pub use arguments::{ColorChoice, Common, Format};
pub use csv_input::CsvLines;
pub use diagnostic::{Diagnostic, Reporter};
pub use exit::{Exit, Failure};
pub use eyes::EyeArguments;
pub use filter::{Intake, record_of, run_filter, run_filter_on};
pub use frame_input::{FrameInput, FrameItem, FrameLogs, See, run_frames};
pub use home::HomeArguments;
pub use input::{Inputs, read_file};
pub use interrupt::{Pause, on_interrupt, on_suspend};
pub use line::Line;
pub use log_input::FromLog;
pub use number::within;
pub use output::{SharedSink, Sink, is_output_closed, open_output};
pub use program::{Program, command_of, main};
pub use progress::Progress;
pub use scores::{
    Table, find_description, load_corpora, load_gold, load_gold_with, read_lines, write_report, write_robustness,
    write_scores, write_text,
};
pub use source::Source;
pub use threads::{counted_on_threads, on_threads};
pub use trial_options::{DEAD_TIME_S, JITTER_S, OptionsError, TIME_LIMIT_S, TrialOptions};

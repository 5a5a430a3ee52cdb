//! What the seven binaries share: arguments, JSON lines in and out,
//! diagnostics, exit codes, progress.
//!
//! The only room that prints or ends the process; it knows nothing of what a
//! stage computes.

mod arguments;
mod diagnostic;
mod exit;
mod filter;
mod input;
mod interrupt;
mod output;
mod parallel;
mod program;
mod progress;
mod scores;

pub use arguments::{ColorChoice, Common, Format};
pub use diagnostic::{Diagnostic, Reporter};
pub use exit::{Exit, Failure};
pub use filter::{Intake, run_filter};
pub use input::{Inputs, Line, read_file};
pub use interrupt::on_interrupt;
pub use output::{SharedSink, Sink, open_output};
pub use parallel::in_parallel;
pub use program::{Program, command_of, main};
pub use progress::Progress;
pub use scores::{Table, load_gold, read_lines, write_robustness, write_scores, write_text};

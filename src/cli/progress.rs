//! A count on standard error for runs that take longer than about a second.

use std::fmt::Write;
use std::io::{self, IsTerminal};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressState, ProgressStyle};
use rustix::fs::{FileType, fstat};

use super::Common;

/// Shows nothing on a pipe, in a quiet run, or in the first second.
pub struct Progress {
    wanted: bool,
    name: &'static str,
    begun: Instant,
    total: Option<u64>,
    shown: Mutex<Shown>,
}

#[derive(Default)]
struct Shown {
    count: u64,
    bar: Option<ProgressBar>,
}

impl Progress {
    /// A count of `total` things, when the total is known.
    pub fn new(common: &Common, total: Option<u64>) -> Self {
        // With records on the same terminal the count would stand among them.
        let wanted = is_wanted(common, io::stdout().is_terminal());
        Self { wanted, name: "evaluate", begun: Instant::now(), total, shown: Mutex::default() }
    }

    /// A count of the records of one filter. Of the filters of a pipe the last one counts, so that no two write over
    /// each other; `total` is asked only when the count is shown.
    pub fn of_records(name: &'static str, common: &Common, total: impl FnOnce() -> Option<u64>) -> Self {
        let wanted = is_wanted(common, goes_on());
        let total = if wanted { total() } else { None };
        Self { wanted, name, begun: Instant::now(), total, shown: Mutex::default() }
    }

    /// Counts `n` more.
    pub fn add(&self, n: u64) {
        if !self.wanted {
            return;
        }
        let mut shown = self.shown.lock().unwrap_or_else(PoisonError::into_inner);
        shown.count += n;
        if self.begun.elapsed() >= Duration::from_secs(1) {
            let count = shown.count;
            shown.bar.get_or_insert_with(|| new_bar(self.name, self.total)).set_position(count);
        }
    }
}

/// Whether a count is to be shown; `in_the_way` says that standard output has another use for this terminal.
fn is_wanted(common: &Common, in_the_way: bool) -> bool {
    let told = common.verbose > 0;
    !common.quiet && !told && io::stderr().is_terminal() && (common.output.is_some() || !in_the_way)
}

/// Whether standard output is a terminal, or a pipe to a program that counts, too.
fn goes_on() -> bool {
    let is_pipe = fstat(io::stdout()).is_ok_and(|found| FileType::from_raw_mode(found.st_mode) == FileType::Fifo);
    is_pipe || io::stdout().is_terminal()
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.shown.get_mut().unwrap_or_else(PoisonError::into_inner).bar {
            bar.finish_and_clear();
        }
    }
}

fn new_bar(name: &'static str, total: Option<u64>) -> ProgressBar {
    let (bar, template) = match total {
        Some(total) => (ProgressBar::new(total), "{prefix} {bar:30} {pos} of {len}, {rate}, {eta} left"),
        None => (ProgressBar::new_spinner(), "{prefix} {spinner} {pos} records, {rate}"),
    };
    let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
    bar.with_prefix(name).with_style(style.with_key("rate", rate))
}

fn rate(state: &ProgressState, to: &mut dyn Write) {
    // Writing to a string cannot fail.
    let _ = write!(to, "{:.0}/s", state.per_sec());
}

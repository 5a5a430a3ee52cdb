//! A count on standard error for runs that take longer than about a second.

use std::io::{self, IsTerminal};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use super::Common;

/// Shows nothing on a pipe, in a quiet run, or in the first second.
pub struct Progress {
    wanted: bool,
    begun: Instant,
    count: u64,
    total: Option<u64>,
    bar: Option<ProgressBar>,
}

impl Progress {
    /// A progress count of `total` things, when the total is known.
    pub fn new(common: &Common, total: Option<u64>) -> Self {
        // With records on the same terminal the count would stand among them.
        let wanted = !common.quiet && io::stderr().is_terminal() && !io::stdout().is_terminal();
        Self { wanted, begun: Instant::now(), count: 0, total, bar: None }
    }

    /// Counts `n` more.
    pub fn add(&mut self, n: u64) {
        self.count += n;
        if !self.wanted || self.begun.elapsed() < Duration::from_secs(1) {
            return;
        }
        let total = self.total;
        self.bar.get_or_insert_with(|| new_bar(total)).set_position(self.count);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

fn new_bar(total: Option<u64>) -> ProgressBar {
    let (bar, template) = match total {
        Some(total) => (ProgressBar::new(total), "{bar:40} {pos}/{len} {per_sec} {eta}"),
        None => (ProgressBar::new_spinner(), "{spinner} {pos} records {per_sec}"),
    };
    bar.with_style(ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar()))
}

//! Simulated time held back for a person who watches.

use std::time::{Duration, Instant};

/// Lets simulated time pass no faster than some times the time of day.
pub(super) struct Pace {
    began: Instant,
    times: f64,
}

impl Pace {
    /// Begins now, at second zero of the trial.
    pub(super) fn new(times: f64) -> Self {
        Self { began: Instant::now(), times }
    }

    /// Waits until second `time_s` of the trial is due.
    pub(super) fn wait(&self, time_s: f64) {
        // What is due at no time that can be told is not waited for.
        let due = Duration::try_from_secs_f64(time_s / self.times).unwrap_or_default();
        std::thread::sleep(due.saturating_sub(self.began.elapsed()));
    }
}

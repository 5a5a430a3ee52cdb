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
        std::thread::sleep(self.due(time_s).saturating_sub(self.began.elapsed()));
    }

    fn due(&self, time_s: f64) -> Duration {
        // What is due at no time that can be told is not waited for.
        Duration::try_from_secs_f64(time_s / self.times).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_twice_the_pace_a_second_is_due_after_half_of_one() {
        assert_eq!(Pace::new(1.0).due(3.0), Duration::from_secs(3));
        assert_eq!(Pace::new(2.0).due(3.0), Duration::from_millis(1500));
        assert_eq!(Pace::new(1.0).due(f64::INFINITY), Duration::ZERO);
    }
}

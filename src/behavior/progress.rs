//! What is asked for must come about: a robot that gets nowhere says so instead of going on until its time is up.

use super::foresight::stands;

/// Without progress for so long it is stuck, seconds.
pub(super) const PATIENCE_S: f64 = 20.0;
/// Wheels that do not answer are told sooner than a way that does not get shorter, seconds.
const WHEELS_S: f64 = 10.0;
/// So often a drive may turn in between without getting on.
const MOST_TURNS: usize = 6;

/// Whether what is left grows less.
#[derive(Clone, Debug)]
pub(super) struct Progress {
    /// Less by this counts, in the caller's unit.
    step: f64,
    least: f64,
    since_s: Option<f64>,
    turns: usize,
}

impl Progress {
    pub fn new(step: f64) -> Self {
        Self { step, least: f64::INFINITY, since_s: None, turns: 0 }
    }

    /// With `left` left at `time_s`: false when it has not grown less for too long.
    pub fn goes_on(&mut self, left: f64, time_s: f64) -> bool {
        if left < self.least - self.step {
            (self.least, self.since_s, self.turns) = (left, Some(time_s), 0);
        }
        time_s - *self.since_s.get_or_insert(time_s) <= PATIENCE_S
    }

    /// It turned in between, which takes its time, and is progress of another kind, a few times.
    pub fn turned(&mut self, time_s: f64) {
        self.turns += 1;
        if self.turns <= MOST_TURNS {
            self.since_s = Some(time_s);
        }
    }
}

/// Whether the wheels answer at all.
#[derive(Clone, Debug, Default)]
pub(super) struct Idle {
    /// Since when motion has been asked for and none reported, seconds.
    since_s: Option<f64>,
}

impl Idle {
    /// Until `time_s` this was asked for, m/s and rad/s, and that reported: what is to be said when that goes on too long.
    ///
    /// # Errors
    /// When it is held fast: much was asked for, and little came of it.
    pub fn passed(&mut self, asked: (f64, f64), reported: (f64, f64), time_s: f64) -> Result<(), String> {
        if stands(asked) || !stands(reported) {
            self.since_s = None;
            return Ok(());
        }
        if time_s - *self.since_s.get_or_insert(time_s) <= WHEELS_S {
            return Ok(());
        }
        let (linear, angular) = (asked.0 * 1000.0, asked.1.to_degrees());
        Err(format!(
            "the wheels report zero for {WHEELS_S:.0} s although {linear:.0} mm/s and {angular:.0}°/s are asked for; \
             are the motors on, and is the robot free?"
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_grows_less_goes_on_and_what_does_not_is_stuck_after_twenty_seconds() {
        let mut progress = Progress::new(0.02);
        assert!((0..100).all(|second| progress.goes_on(10.0 - 0.05 * f64::from(second), f64::from(second))));
        assert!(progress.goes_on(5.05, 119.0) && !progress.goes_on(5.04, 119.1));
    }

    #[test]
    fn a_drive_that_only_turns_is_stuck_too() {
        let mut progress = Progress::new(0.05);
        let stuck = (0..100).find(|i| {
            let time_s = 5.0 * f64::from(*i);
            progress.turned(time_s);
            !progress.goes_on(2.0, time_s)
        });
        assert!(stuck.is_some_and(|turns| turns < 15), "{stuck:?}");
    }

    #[test]
    fn wheels_that_report_zero_although_motion_is_asked_for_are_told_with_what_was_asked() {
        let mut idle = Idle::default();
        let told = (0..200).find_map(|tick| idle.passed((0.3, 0.0), (0.0, 0.0), 0.1 * f64::from(tick)).err());
        assert!(told.is_some_and(|why| why.contains("300 mm/s")));
        let mut idle = Idle::default();
        assert!((0..200).all(|tick| idle.passed((0.3, 0.0), (0.3, 0.0), 0.1 * f64::from(tick)).is_ok()));
    }
}

//! What was done, when, and why.

use crate::geometry::Pose;
use crate::record::{ActionReport, PathPoint};

/// The path is kept at this spacing, seconds: short lines, as in the paper's Fig. 6.
const PATH_SPACING_S: f64 = 0.5;

/// The reports and the path of one trial.
#[derive(Clone, Debug, Default)]
pub struct Journal {
    /// One entry per action, in order.
    pub actions: Vec<ActionReport>,
    /// Where the robot believed itself to be.
    pub path: Vec<PathPoint>,
    open: Option<(String, f64, Vec<String>)>,
}

impl Journal {
    /// An action begins.
    pub fn begin(&mut self, action: &str, time_s: f64) {
        self.open = Some((action.to_string(), time_s, Vec::new()));
    }

    /// A reason for something done within the present action.
    pub fn because(&mut self, reason: impl Into<String>) {
        if let Some((_, _, reasons)) = &mut self.open {
            reasons.push(reason.into());
        }
    }

    /// The action that began last is over.
    pub fn end(&mut self, result: &str, time_s: f64) {
        if let Some((action, start_s, reasons)) = self.open.take() {
            self.actions.push(ActionReport {
                action,
                result: result.to_string(),
                why: reasons.join("; "),
                start_s: start_s.into(),
                end_s: time_s.into(),
            });
        }
    }

    /// "During search: ", when an action is open.
    pub fn during(&self) -> String {
        self.open.as_ref().map(|(action, _, _)| format!("during {action}: ")).unwrap_or_default()
    }

    /// The robot is here; kept when the last point is old enough.
    pub fn passed(&mut self, time_s: f64, pose: Pose) {
        if self.path.last().is_none_or(|last| time_s - last.0.0 >= PATH_SPACING_S - 1e-9) {
            self.path.push(PathPoint::new(time_s, pose));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reasons_of_an_action_are_told_in_order() {
        let mut journal = Journal::default();
        journal.begin("search", 1.0);
        journal.because("no mug on table 1");
        journal.because("read left as the bed's own left");
        journal.end("table 2", 9.0);
        assert_eq!(journal.actions[0].why, "no mug on table 1; read left as the bed's own left");
    }

    #[test]
    fn the_path_is_kept_every_half_second() {
        let mut journal = Journal::default();
        for tick in 0..11 {
            journal.passed(f64::from(tick) * 0.1, Pose::default());
        }
        assert_eq!(journal.path.len(), 3);
    }
}

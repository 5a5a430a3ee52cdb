//! A watcher that tells, while it happens, what the robot does and why.

use std::fmt;
use std::sync::Arc;

use crate::behavior::Watcher;
use crate::record::{Record, Trial};

/// Where a narration goes, and how it tells.
#[derive(Clone)]
pub struct Narration {
    /// Hears every line.
    pub tell: Arc<dyn Fn(&str) + Send + Sync>,
    /// Whether the figures behind each decision are told as well.
    pub figures: bool,
}

impl fmt::Debug for Narration {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("Narration").field("figures", &self.figures).finish_non_exhaustive()
    }
}

/// Tells one trial, a line a decision, under the record's id: several trials may go on at a time.
pub struct Narrator {
    narration: Narration,
    id: String,
}

impl Narrator {
    pub(super) fn begin(narration: &Narration, id: &str, record: &Record) -> Self {
        let narrator = Self { narration: narration.clone(), id: id.to_string() };
        if let Ok(Some(text)) = record.get::<String>("text") {
            narrator.line(&format!("\"{text}\""));
        }
        narrator
    }

    /// How it ended.
    pub fn end(&self, trial: &Trial) {
        let (metres, seconds) = (trial.distance_m.0, trial.duration_s.0);
        self.line(&format!("{}: {} ({metres:.1} m, {seconds:.0} s)", trial.outcome.phrase(), trial.why));
        trial.description.iter().for_each(|description| self.line(description));
    }

    fn line(&self, text: &str) {
        (self.narration.tell)(&format!("{}: {text}", self.id));
    }

    fn at(&self, time_s: f64, text: &str) {
        self.line(&format!("{time_s:6.1} s  {text}"));
    }
}

impl Watcher for Narrator {
    fn said(&mut self, time_s: f64, text: &str) {
        if self.narration.figures {
            self.at(time_s, text);
        }
    }

    fn told(&mut self, time_s: f64, plain: &str) {
        if !self.narration.figures {
            self.at(time_s, plain);
        }
    }
}

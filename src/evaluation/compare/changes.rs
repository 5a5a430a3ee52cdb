//! The values in which two records differ, field by field.

use serde_json::Value;

use super::Change;
use crate::record::{Chunk, Detection, FieldError, Grounding, Part, Plan, Record, Trial};

/// The keys that stages add and that say what was understood and done.
const KEYS: [&str; 5] = [Vec::<Chunk>::KEY, Grounding::KEY, Plan::KEY, Trial::KEY, Vec::<Detection>::KEY];

/// Reasons and measurements: they move with every small change, and say little about what changed.
const NOISE: [&str; 18] = [
    "why",
    "because",
    "score",
    "scores",
    "confidence",
    "margin",
    "readings",
    "unused",
    "path",
    "final_pose",
    "duration_s",
    "distance_m",
    "spl",
    "min_clearance_m",
    "start_s",
    "end_s",
    "picture",
    "rule",
];

/// All values that differ between two records of one id.
///
/// # Errors
/// When a key that a stage adds does not hold what the stage writes.
pub fn changes_between(id: &str, a: &Record, b: &Record, everything: bool) -> Result<Vec<Change>, FieldError> {
    let mut walk = Walk { id, everything, changes: Vec::new() };
    for key in KEYS {
        let (from, to): (Option<Value>, Option<Value>) = (a.get(key)?, b.get(key)?);
        walk.value(key, &from.unwrap_or(Value::Null), &to.unwrap_or(Value::Null));
    }
    Ok(walk.changes)
}

struct Walk<'a> {
    id: &'a str,
    everything: bool,
    changes: Vec<Change>,
}

impl Walk<'_> {
    fn value(&mut self, field: &str, from: &Value, to: &Value) {
        match (from, to) {
            (from, to) if from == to => {}
            (Value::Object(a), Value::Object(b)) => {
                let everything = self.everything;
                let counts = |key: &str| everything || !NOISE.contains(&key);
                for (key, value) in a.iter().filter(|(key, _)| counts(key)) {
                    self.value(&format!("{field}.{key}"), value, b.get(key).unwrap_or(&Value::Null));
                }
                for (key, value) in b.iter().filter(|(key, _)| counts(key) && !a.contains_key(*key)) {
                    self.value(&format!("{field}.{key}"), &Value::Null, value);
                }
            }
            (Value::Array(a), Value::Array(b)) => {
                for i in 0..a.len().max(b.len()) {
                    let at = |values: &[Value]| values.get(i).cloned().unwrap_or(Value::Null);
                    self.value(&format!("{field}.{i}"), &at(a), &at(b));
                }
            }
            _ => self.changes.push(Change {
                id: self.id.to_string(),
                field: field.to_string(),
                from: from.clone(),
                to: to.clone(),
            }),
        }
    }
}

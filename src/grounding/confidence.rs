//! How sure a reading is.

use super::doubts::left_out;
use crate::language::Reading;
use crate::record::Grounding;

/// The confidence in the whole reading.
pub fn score(grounding: &mut Grounding, reading: &Reading) {
    super::readings::score(grounding);
    let lost = left_out(reading).len();
    grounding.score = (grounding.score.0 * 0.9_f64.powi(i32::try_from(lost).unwrap_or(i32::MAX))).into();
}

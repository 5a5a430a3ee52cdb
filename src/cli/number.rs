//! Numbers of the command line that must lie in a range.

use std::ops::RangeInclusive;

/// Reads such a number; what is none, or not a number at all, is told with the range.
///
/// # Errors
/// When the text is no number or lies outside the range.
pub fn within(range: RangeInclusive<f64>) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    move |text| {
        let value: f64 = text.parse().map_err(|_| "not a number".to_string())?;
        in_range(value, &range)
    }
}

/// The value, when it lies in the range.
pub(super) fn in_range(value: f64, range: &RangeInclusive<f64>) -> Result<f64, String> {
    let outside = || format!("must be from {} to {}", range.start(), range.end());
    range.contains(&value).then_some(value).ok_or_else(outside)
}

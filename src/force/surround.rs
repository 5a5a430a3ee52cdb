//! "Surrounded by" and "between", read from histograms.

use std::f64::consts::{PI, TAU};

use super::Histogram;

/// Levels at which a histogram is cut.
const LEVELS: usize = 20;

/// How far one object surrounds the other, 0 to 1: for each level of the histogram, as a fuzzy set of directions, one
/// less the widest opening over half a turn; averaged over the levels.
///
/// After Matsakis & Andréfouët, FUZZ-IEEE 2002, who read it from the α-cuts too; how an opening becomes a degree is
/// our choice: half a turn open is not surrounded, none open is. The histogram alone cannot tell which of the two
/// is outside.
pub fn surround(histogram: &Histogram) -> f64 {
    let values = histogram.values();
    let top = histogram.peak();
    if top <= 0.0 {
        return 0.0;
    }
    let closed = |level: usize| {
        let cut = (level as f64 + 0.5) / LEVELS as f64 * top;
        (1.0 - widest_opening(values, cut) / PI).clamp(0.0, 1.0)
    };
    (0..LEVELS).map(closed).sum::<f64>() / LEVELS as f64
}

/// The widest angle without a value of at least `cut`, radians.
fn widest_opening(values: &[f64], cut: f64) -> f64 {
    let k = values.len();
    let Some(first) = values.iter().position(|v| *v >= cut) else { return TAU };
    let (mut widest, mut run) = (0, 0);
    for i in 1..=k {
        if values[(first + i) % k] >= cut {
            widest = widest.max(run);
            run = 0;
        } else {
            run += 1;
        }
    }
    TAU * widest as f64 / k as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_circle_surrounds_and_a_half_does_not() {
        let circle = |open: usize| Histogram::from_values((0..36).map(|i| if i < open { 0.0 } else { 1.0 }).collect());
        assert_eq!(surround(&circle(0)), 1.0);
        assert!((surround(&circle(9)) - 0.5).abs() < 1e-9);
        assert_eq!(surround(&circle(18)), 0.0);
    }
}

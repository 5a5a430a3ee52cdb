//! Degree of truth of "A is in direction α of B", from a histogram of forces.
//!
//! After Matsakis, Keller, Wendling, Marjamaa & Sjahputera, "Linguistic
//! description of relative positions in images", IEEE TSMC-B 31(4), 2001: the
//! forces more than 90° off α contradict; they are compensated by forces on the
//! same side; what is left is effective. Of the effective forces the part above
//! a threshold counts at its own angle, the part below it as if it pointed at α.

use std::f64::consts::TAU;

use super::Histogram;

/// Half-widths of the trapezoid over which the threshold is a weighted mean, in quarter turns (Matsakis' defaults).
const CORE: f64 = 0.25;
const SUPPORT: f64 = 0.5;

/// a is the degree of truth in the histogram's opinion, b the most that may reasonably be said.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DegreeOfTruth {
    /// 0 to 1, at most b.
    pub a: f64,
    /// Share of effective forces, 0 to 1.
    pub b: f64,
}

/// The degree of truth of "A is in direction `theta` of B", radians.
///
/// Exact where `theta` is one of the histogram's directions; between two of them the histogram is taken as linear.
/// The algorithm wants a multiple of four directions; another number is resampled to the next one that is.
pub fn degree_of_truth(histogram: &Histogram, theta: f64) -> DegreeOfTruth {
    Judge::new(histogram).degree(theta)
}

/// Asks one histogram about several directions.
#[derive(Debug)]
pub(super) struct Judge<'h> {
    values: &'h [f64],
    /// Directions in a quarter turn.
    quarter: usize,
    /// The histogram turned so that index 2n is the direction asked for: n and 3n are 90° off, 0 and 4n opposite.
    turned: Vec<f64>,
}

impl<'h> Judge<'h> {
    pub(super) fn new(histogram: &'h Histogram) -> Self {
        let values = histogram.values();
        let quarter = values.len().div_ceil(4);
        Self { values, quarter, turned: vec![0.0; 4 * quarter + 1] }
    }

    pub(super) fn degree(&mut self, theta: f64) -> DegreeOfTruth {
        let n = self.quarter;
        if n == 0 {
            return DegreeOfTruth::default();
        }
        self.turn(theta);
        let lost = compensate(&mut self.turned, n, |i| i) + compensate(&mut self.turned, n, |i| 4 * n - i);
        let effective: f64 = self.turned[n + 1..3 * n].iter().sum();
        if effective <= 0.0 {
            return DegreeOfTruth::default();
        }
        let b = effective / (effective + lost);
        let threshold = threshold(&self.turned, n);
        let above = |i: usize| (self.turned[i] - threshold).max(0.0);
        let moment: f64 = (1..n).map(|off| off as f64 * (above(2 * n + off) - above(2 * n - off))).sum();
        let deviation = moment / (effective * n as f64);
        DegreeOfTruth { a: (1.0 - deviation.abs()).max(0.0) * b, b }
    }

    fn turn(&mut self, theta: f64) {
        let (k, samples) = (self.values.len(), 4 * self.quarter);
        let start = ((theta / TAU + 0.5).rem_euclid(1.0)) * k as f64;
        // A direction of the histogram itself, but for rounding.
        let start = if (start - start.round()).abs() < 1e-9 { start.round() } else { start };
        let step = k as f64 / samples as f64;
        for (i, value) in self.turned.iter_mut().enumerate() {
            let place = start + i as f64 * step;
            let low = place as usize;
            let share = place - low as f64;
            let (here, next) = (low % k, (low + 1) % k);
            *value = self.values[here] * (1.0 - share) + self.values[next] * share;
        }
    }
}

/// Takes the contradictory forces of one half and the forces that compensate them out; returns how much that was.
///
/// `at` counts places from the far end of the half: 0 opposite to the direction, n at right angles, 2n the direction.
fn compensate(t: &mut [f64], n: usize, at: impl Fn(usize) -> usize) -> f64 {
    // The opposite direction belongs to both halves, half of it to each, a quarter of a step inside.
    let mut moment = t[at(0)] / 2.0 * (n as f64 - 0.25);
    let mut lost = t[at(0)] / 2.0 + t[at(n)];
    for i in 1..n {
        moment += t[at(i)] * (n - i) as f64;
        lost += t[at(i)];
    }
    for i in n + 1..=3 * n {
        let (lever, value) = ((i - n) as f64, t[at(i)]);
        if moment <= value * lever {
            t[at(i)] = value - moment / lever;
            return lost + moment / lever;
        }
        moment -= value * lever;
        lost += value;
        t[at(i)] = 0.0;
    }
    lost
}

/// The mean of the effective forces about the direction, weighted by a trapezoid.
fn threshold(t: &[f64], n: usize) -> f64 {
    let (core, support) = ((CORE * n as f64) as usize, (SUPPORT * n as f64) as usize);
    let weight = |off: usize| {
        if off <= core { 1.0 } else { (support as f64 - off as f64).max(0.0) / (support - core).max(1) as f64 }
    };
    let (mut sum, mut weights) = (t[2 * n], 1.0);
    for off in 1..=support.max(core) {
        sum += weight(off) * (t[2 * n - off] + t[2 * n + off]);
        weights += 2.0 * weight(off);
    }
    sum / weights
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spike(k: usize, at: usize) -> Histogram {
        Histogram::from_values((0..k).map(|i| f64::from(u8::from(i == at))).collect())
    }

    #[test]
    fn all_force_in_one_direction_makes_it_wholly_true() {
        assert_eq!(degree_of_truth(&spike(16, 4), TAU / 4.0), DegreeOfTruth { a: 1.0, b: 1.0 });
    }

    #[test]
    fn a_force_at_right_angles_or_behind_says_nothing() {
        assert_eq!(degree_of_truth(&spike(16, 4), 0.0).a, 0.0);
        assert_eq!(degree_of_truth(&spike(16, 4), 0.75 * TAU).a, 0.0);
    }

    #[test]
    fn halfway_between_two_directions_is_half_true() {
        let degree = degree_of_truth(&spike(16, 2), 0.0);
        assert!((degree.a - 0.5).abs() < 1e-12, "{degree:?}");
    }

    #[test]
    fn equal_forces_from_both_sides_leave_nothing_to_say() {
        let both = Histogram::from_values((0..16).map(|i| f64::from(u8::from(i % 8 == 0))).collect());
        assert!(degree_of_truth(&both, 0.0).a < 0.05);
    }

    #[test]
    fn a_number_of_directions_that_four_does_not_divide_is_resampled() {
        let wide =
            |k: usize| Histogram::from_values((0..k).map(|i| (TAU * i as f64 / k as f64).cos().max(0.0)).collect());
        let (odd, even) = (degree_of_truth(&wide(361), 0.3), degree_of_truth(&wide(360), 0.3));
        assert!((odd.a - even.a).abs() < 1e-2 && (odd.b - even.b).abs() < 1e-2, "{odd:?} {even:?}");
    }
}

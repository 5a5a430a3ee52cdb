//! Degree of truth of "A is in direction α of B", from a histogram of forces.
//!
//! After Matsakis, Keller, Wendling, Marjamaa & Sjahputera, "Linguistic
//! description of relative positions in images", IEEE TSMC-B 31(4), 2001: the
//! forces more than 90° off α contradict; they are compensated by forces on the
//! same side; what is left is effective. Of the effective forces the part above
//! a threshold counts at its own angle, the part below it as if it pointed at α.

use std::f64::consts::TAU;

use super::Histogram;

/// Half-widths of the trapezoid over which the threshold is a weighted mean, in quarter turns.
const CORE: f64 = 0.25;
const SUPPORT: f64 = 0.5;

/// a is the degree of truth in the histogram's opinion, b the most that may reasonably be said.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Degree {
    /// 0 to 1.
    pub a: f64,
    /// Share of effective forces, 0 to 1.
    pub b: f64,
}

/// The degree for the direction of value `index`. The number of directions must be a multiple of 4; else it is zero.
pub fn degree_of_truth(histogram: &Histogram, index: usize) -> Degree {
    let values = histogram.values();
    let k = values.len();
    if k == 0 || k % 4 != 0 {
        return Degree::default();
    }
    let n = k / 4;
    // Turned so that 2n is the direction asked for, n and 3n are 90° off, 0 and 4n are opposite.
    let mut t: Vec<f64> = (0..=k).map(|i| values[(index + i + 2 * n) % k]).collect();
    let mut lost = 0.0;
    lost += compensate(&mut t, n);
    t.reverse();
    lost += compensate(&mut t, n);
    t.reverse();
    let effective: f64 = t[n + 1..3 * n].iter().sum();
    if effective <= 0.0 {
        return Degree::default();
    }
    let b = effective / (effective + lost);
    let threshold = threshold(&t, n);
    let moment: f64 = (n + 1..3 * n).map(|i| (t[i] - threshold).max(0.0) * (i as f64 - 2.0 * n as f64)).sum();
    let deviation = moment / (effective * n as f64);
    Degree { a: (1.0 - deviation.abs()).max(0.0) * b, b }
}

/// Takes the contradictory forces of one half and the forces that compensate them out; returns how much that was.
fn compensate(t: &mut [f64], n: usize) -> f64 {
    let mut moment = t[0] / 2.0 * (n as f64 - 0.25);
    let mut lost = t[0] / 2.0 + t[n];
    for i in 1..n {
        moment += t[i] * (n - i) as f64;
        lost += t[i];
    }
    for i in n + 1..=3 * n {
        let lever = (i - n) as f64;
        if moment > t[i] * lever {
            moment -= t[i] * lever;
            lost += t[i];
            t[i] = 0.0;
        } else {
            t[i] -= moment / lever;
            return lost + moment / lever;
        }
    }
    lost
}

/// The mean of the effective forces about the direction, weighted by a trapezoid.
fn threshold(t: &[f64], n: usize) -> f64 {
    let (core, support) = ((CORE * n as f64) as usize, (SUPPORT * n as f64) as usize);
    let weight = |off: usize| {
        if off <= core { 1.0 } else { (support as f64 - off as f64).max(0.0) / (support - core).max(1) as f64 }
    };
    let (mut sum, mut weights) = (0.0, 0.0);
    for off in 0..=support.max(core) {
        let sides = if off == 0 { 1.0 } else { 2.0 };
        let values = if off == 0 { t[2 * n] } else { t[2 * n - off] + t[2 * n + off] };
        sum += weight(off) * values;
        weights += sides * weight(off);
    }
    sum / weights
}

/// The direction with the greatest degree of truth, radians, 0 to 2π; nothing where none has any.
///
/// A plateau or a tie of neighbours answers its middle, so that symmetric objects get their axis.
pub fn main_direction(histogram: &Histogram) -> Option<f64> {
    let k = histogram.values().len();
    let degrees: Vec<f64> = (0..k).map(|i| degree_of_truth(histogram, i).a).collect();
    let best = degrees.iter().copied().fold(0.0, f64::max);
    if best <= 0.0 {
        return None;
    }
    let top = |i: usize| degrees[i % k] >= best * (1.0 - 1e-6);
    let first = (0..k).find(|&i| top(i) && !top(i + k - 1)).unwrap_or(0);
    let last = (first..first + k).take_while(|&i| top(i)).last().unwrap_or(first);
    // Two bins apart over a dip is how a diagonal axis shows: take the middle of those as well.
    let last = if top(last + 2) { last + 2 } else { last };
    let middle = (first + last) as f64 / 2.0;
    let refined = if first == last { middle + parabola(&degrees, first % k) } else { middle };
    Some((TAU * refined / k as f64).rem_euclid(TAU))
}

/// Where a parabola through a value and its neighbours peaks, in bins from it.
fn parabola(degrees: &[f64], i: usize) -> f64 {
    let k = degrees.len();
    let (left, here, right) = (degrees[(i + k - 1) % k], degrees[i], degrees[(i + 1) % k]);
    let bend = left - 2.0 * here + right;
    if bend.abs() < 1e-12 { 0.0 } else { ((left - right) / (2.0 * bend)).clamp(-0.5, 0.5) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spike(k: usize, at: usize) -> Histogram {
        Histogram::from_values((0..k).map(|i| f64::from(u8::from(i == at))).collect())
    }

    #[test]
    fn all_force_in_one_direction_makes_it_wholly_true() {
        let degree = degree_of_truth(&spike(16, 4), 4);
        assert_eq!((degree.a, degree.b), (1.0, 1.0));
    }

    #[test]
    fn a_force_at_right_angles_or_behind_says_nothing() {
        assert_eq!(degree_of_truth(&spike(16, 4), 0).a, 0.0);
        assert_eq!(degree_of_truth(&spike(16, 4), 12).a, 0.0);
    }

    #[test]
    fn halfway_between_two_directions_is_half_true() {
        let degree = degree_of_truth(&spike(16, 2), 0);
        assert!((degree.a - 0.5).abs() < 1e-12, "{degree:?}");
    }

    #[test]
    fn the_main_direction_of_a_spike_is_its_own() {
        assert!((main_direction(&spike(16, 4)).expect("a direction") - TAU / 4.0).abs() < 1e-9);
    }
}

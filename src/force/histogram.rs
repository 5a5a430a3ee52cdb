//! A histogram over directions, and the directions themselves.

use std::f64::consts::TAU;

/// One value per direction; value i belongs to θ = 2π·i/K, counter-clockwise from +x.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    values: Vec<f64>,
}

impl Histogram {
    /// A histogram from its values.
    pub fn from_values(values: Vec<f64>) -> Self {
        Self { values }
    }

    /// The values.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The histogram of B against A, for an even number of directions: half a turn round.
    pub fn reversed(&self) -> Self {
        let half = self.values.len() / 2;
        Self { values: [&self.values[half..], &self.values[..half]].concat() }
    }

    /// The value in direction `theta`, radians, linear between two directions of the histogram.
    pub fn at(&self, theta: f64) -> f64 {
        let k = self.values.len();
        if k == 0 {
            return 0.0;
        }
        let place = (theta / TAU).rem_euclid(1.0) * k as f64;
        let (low, share) = (place.floor(), place - place.floor());
        let (i, j) = (low as usize % k, (low as usize + 1) % k);
        self.values[i] * (1.0 - share) + self.values[j] * share
    }

    /// The greatest value, zero when there is none.
    pub fn peak(&self) -> f64 {
        self.values.iter().copied().fold(0.0, f64::max)
    }
}

/// Sine and cosine of 2π·i/k.
///
/// Reduced to the first octant, so that symmetric directions get equal numbers and quarter turns exact ones: what is
/// symmetric in the objects stays symmetric in their histogram.
pub(super) fn direction(i: usize, k: usize) -> (f64, f64) {
    let eighths = 8 * (i % k);
    let (octant, rest) = (eighths / k, eighths % k);
    let within = if octant % 2 == 0 { rest } else { k - rest };
    let (sin, cos) = (TAU * within as f64 / (8 * k) as f64).sin_cos();
    let (sin, cos) = if within == k { (0.5_f64.sqrt(), 0.5_f64.sqrt()) } else { (sin, cos) };
    match octant {
        0 => (sin, cos),
        1 => (cos, sin),
        2 => (cos, -sin),
        3 => (sin, -cos),
        4 => (-sin, -cos),
        5 => (-cos, -sin),
        6 => (-cos, sin),
        _ => (-sin, cos),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_the_points_of_the_unit_circle() {
        for k in [1, 3, 8, 16, 180, 360, 361] {
            for i in 0..k {
                let (sin, cos) = direction(i, k);
                let (want_sin, want_cos) = (TAU * i as f64 / k as f64).sin_cos();
                assert!((sin - want_sin).abs() < 4e-15 && (cos - want_cos).abs() < 4e-15, "{i} of {k}: {sin} {cos}");
            }
        }
    }

    #[test]
    fn quarter_turns_are_exact_and_diagonals_are_equal() {
        assert_eq!(direction(90, 360), (1.0, 0.0));
        assert_eq!(direction(4, 8), (0.0, -1.0));
        let (sin, cos) = direction(135, 360);
        assert_eq!(sin, -cos);
    }

    #[test]
    fn between_two_directions_the_value_is_between_theirs() {
        let histogram = Histogram::from_values(vec![0.0, 4.0, 0.0, 2.0]);
        assert!((histogram.at(TAU / 8.0) - 2.0).abs() < 1e-12);
        assert!((histogram.at(-TAU / 8.0) - 1.0).abs() < 1e-12);
    }
}

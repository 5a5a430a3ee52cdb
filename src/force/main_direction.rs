//! The direction in which one object lies of another: where the degree of truth is greatest.
//!
//! Matsakis et al. (2001) evaluate every direction of the histogram. The degree
//! changes slowly (by no more than about 1/90 per degree), so sixteen
//! directions show where its hills are, and each hill is climbed by trisection.

use std::f64::consts::TAU;

use super::Histogram;
use super::degree::Judge;

/// Directions looked at first.
const LOOKOUTS: usize = 16;
/// A hill may rise by this much between two of them.
const HIDDEN_RISE: f64 = 0.15;
/// Trisections of the range about a lookout: 45° shrinks to a fiftieth of a degree.
const STEPS: usize = 19;
/// Degrees of truth that differ less are equal: what is left of symmetry after rounding.
const TIE: f64 = 1e-9;
/// Hills are one summit when their mean direction keeps at least this length: spread over less than about 120°.
const AGREEMENT: f64 = 0.5;

/// The direction with the greatest degree of truth, radians, 0 to 2π; nothing where no direction stands out.
///
/// Several directions that are equally true answer their middle when they lie together, as on the two flanks of a
/// symmetric object, and nothing when they lie all round. (Our choice: the literature takes the first.)
pub fn main_direction(histogram: &Histogram) -> Option<f64> {
    let mut judge = Judge::new(histogram);
    let mut truth = |theta: f64| judge.degree(theta).a;
    let step = TAU / LOOKOUTS as f64;
    let seen: Vec<f64> = (0..LOOKOUTS).map(|i| truth(i as f64 * step)).collect();
    let top = seen.iter().copied().fold(0.0, f64::max);
    if top <= TIE {
        return None;
    }
    let is_hill = |i: usize| {
        let (before, after) = (seen[(i + LOOKOUTS - 1) % LOOKOUTS], seen[(i + 1) % LOOKOUTS]);
        seen[i] >= before - TIE && seen[i] >= after - TIE && seen[i] >= top - HIDDEN_RISE
    };
    let hills = (0..LOOKOUTS).filter(|&i| is_hill(i));
    let summits: Vec<(f64, f64)> = hills.map(|i| climb(i as f64 * step, step, &mut truth)).collect();
    middle_of_best(&summits)
}

/// The place and height of the summit within one step of `about`; the middle where the summit is flat.
fn climb(about: f64, step: f64, truth: &mut impl FnMut(f64) -> f64) -> (f64, f64) {
    let (mut low, mut high) = (about - step, about + step);
    for _ in 0..STEPS {
        let (left, right) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        let rise = truth(right) - truth(left);
        // Equal heights draw both ends in: a symmetric hill keeps its axis.
        if rise > -TIE {
            low = left;
        }
        if rise < TIE {
            high = right;
        }
    }
    let place = (low + high) / 2.0;
    (place, truth(place))
}

fn middle_of_best(summits: &[(f64, f64)]) -> Option<f64> {
    let best = summits.iter().map(|(_, height)| *height).fold(0.0, f64::max);
    // Trisection leaves heights unequal by a little even where the histogram is symmetric.
    let level = |height: f64| height >= best * (1.0 - 1e-4);
    let (mut x, mut y, mut count) = (0.0, 0.0, 0.0);
    for (place, _) in summits.iter().filter(|(_, height)| level(*height)) {
        x += place.cos();
        y += place.sin();
        count += 1.0;
    }
    let agrees = f64::hypot(x, y) >= AGREEMENT * count;
    agrees.then(|| y.atan2(x).rem_euclid(TAU)).map(|theta| if TAU - theta < 1e-9 { 0.0 } else { theta })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hill(k: usize, about: f64) -> Histogram {
        let value = |i: usize| (TAU * i as f64 / k as f64 - about).cos().max(0.0).powi(4);
        Histogram::from_values((0..k).map(value).collect())
    }

    #[test]
    fn a_single_hill_has_its_top_found_between_the_lookouts() {
        for about in [0.0, 0.4, 1.0, 3.3, 6.0] {
            let found = main_direction(&hill(180, about)).expect("a direction");
            assert!((found - about).abs() < 0.01, "{found} is not {about}");
        }
    }

    #[test]
    fn equal_flanks_answer_their_axis() {
        let flanks: Vec<f64> =
            hill(180, 1.2).values().iter().zip(hill(180, 1.9).values()).map(|(a, b)| a.powi(9) + b.powi(9)).collect();
        let found = main_direction(&Histogram::from_values(flanks)).expect("a direction");
        assert!((found - 1.55).abs() < 0.01, "{found}");
    }

    #[test]
    fn forces_all_round_have_no_direction() {
        assert_eq!(main_direction(&Histogram::from_values(vec![1.0; 64])), None);
        assert_eq!(main_direction(&Histogram::from_values(vec![0.0; 64])), None);
    }
}

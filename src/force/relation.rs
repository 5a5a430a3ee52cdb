//! The relative position of two objects, as the executive and `hof` ask for it.

use std::f64::consts::{PI, TAU};

use super::degree::{Degree, degree_of_truth, main_direction};
use super::polygon::{histogram, histogram_from, hybrid};
use super::{Force, Histogram, Shape};

/// Directions of the histograms behind degrees: coarse enough for a robot's control loop.
const DIRECTIONS: usize = 32;

/// Where `a` is relative to `b`.
#[derive(Clone, Debug)]
pub struct Relation<'s> {
    a: &'s Shape,
    b: &'s Shape,
    near: Force,
}

impl<'s> Relation<'s> {
    /// The relation of `a` to `b`.
    pub fn between(a: &'s Shape, b: &'s Shape) -> Self {
        Self { a, b, near: hybrid(a, b) }
    }

    fn opinions(&self, first: f64) -> Vec<Histogram> {
        // Neither force diverges.
        [Force::Power(0.0), self.near]
            .into_iter()
            .filter_map(|force| histogram_from(self.a, self.b, force, DIRECTIONS, first).ok())
            .collect()
    }

    /// Degree of truth of "a is in direction `angle` of b", radians: the mean of what constant and hybrid forces say.
    ///
    /// Constant forces see the objects whole, hybrid ones the parts nearest to each other.
    pub fn degree(&self, angle: f64) -> Degree {
        let degrees: Vec<Degree> = self.opinions(angle).iter().map(|h| degree_of_truth(h, 0)).collect();
        let n = degrees.len().max(1) as f64;
        Degree { a: degrees.iter().map(|d| d.a).sum::<f64>() / n, b: degrees.iter().map(|d| d.b).fold(1.0, f64::min) }
    }

    /// The direction in which a lies, radians, 0 to 2π.
    pub fn main_direction(&self) -> Option<f64> {
        self.opinions(0.0).last().and_then(main_direction)
    }

    /// The gap, zero when they touch.
    pub fn distance(&self) -> f64 {
        self.a.distance(self.b)
    }

    /// How far a surrounds b, 0 to 1: one less the widest opening over half a turn, averaged over the
    /// histogram's levels (after Matsakis & Andréfouët, FUZZ-IEEE 2002).
    pub fn surround(&self) -> f64 {
        let Ok(histogram) = histogram(self.a, self.b, Force::Power(0.0), 2 * DIRECTIONS) else { return 0.0 };
        surround(&histogram)
    }
}

fn surround(histogram: &Histogram) -> f64 {
    let values = histogram.values();
    let top = values.iter().copied().fold(0.0, f64::max);
    if top <= 0.0 {
        return 0.0;
    }
    const LEVELS: usize = 20;
    let at = |level: usize| {
        let cut = (level as f64 + 0.5) / LEVELS as f64 * top;
        (1.0 - opening(values, cut) / PI).clamp(0.0, 1.0)
    };
    (0..LEVELS).map(at).sum::<f64>() / LEVELS as f64
}

/// The widest angle without a value of at least `cut`, radians, less the one bin a full circle leaves.
fn opening(values: &[f64], cut: f64) -> f64 {
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

/// How far `a` lies between two others, 0 to 1: the greatest degree to which they pull it in opposite directions.
pub fn between(a: &Shape, first: &Shape, second: &Shape) -> f64 {
    let degrees = |reference: &Shape| -> Vec<f64> {
        let Ok(histogram) = histogram(a, reference, Force::Power(0.0), DIRECTIONS) else {
            return vec![0.0; DIRECTIONS];
        };
        (0..DIRECTIONS).map(|i| degree_of_truth(&histogram, i).a).collect()
    };
    let (one, other) = (degrees(first), degrees(second));
    (0..DIRECTIONS).map(|i| one[i].min(other[(i + DIRECTIONS / 2) % DIRECTIONS])).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64) -> Shape {
        Shape::from_ring(vec![[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]])
    }

    #[test]
    fn a_square_to_the_right_is_to_the_right() {
        let (a, b) = (square(3.0, 0.0), square(0.0, 0.0));
        let relation = Relation::between(&a, &b);
        assert!(relation.degree(0.0).a > 0.9);
        assert!(relation.degree(PI).a < 0.01);
        assert!(relation.main_direction().expect("a direction").min(0.1) < 0.01);
        assert!((relation.distance() - 2.0).abs() < 1e-12);
    }

    #[test]
    fn a_ring_surrounds_and_a_neighbour_does_not() {
        let ring = |low: f64, high: f64| vec![[low, low], [high, low], [high, high], [low, high], [low, low]];
        let frame = Shape::from_parts(&[vec![ring(-2.0, 3.0), ring(-1.0, 2.0)]]).expect("a frame");
        let inner = square(0.0, 0.0);
        assert!(Relation::between(&frame, &inner).surround() > 0.8);
        assert!(Relation::between(&square(3.0, 0.0), &inner).surround() < 0.1);
    }

    #[test]
    fn the_middle_of_three_is_between_the_outer_two() {
        let (left, middle, right) = (square(0.0, 0.0), square(3.0, 0.2), square(6.0, 0.0));
        assert!(between(&middle, &left, &right) > 0.8);
        assert!(between(&left, &middle, &right) < 0.1);
    }
}

//! Whether something lies between two others.

use std::f64::consts::{PI, TAU};

use super::degree::Judge;
use super::{RelativePosition, Shape};

/// How far `a` lies between two others, 0 to 1: the greatest degree to which it lies in one direction of the first
/// and in the opposite direction of the second.
///
/// ```
/// use spatial_fetch::force::{self, Shape};
/// let square = |x: f64| Shape::from_ring(vec![[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]]);
/// assert!(force::between(&square(3.0), &square(0.0), &square(6.0)) > 0.9);
/// assert!(force::between(&square(0.0), &square(3.0), &square(6.0)) < 0.1);
/// ```
pub fn between(a: &Shape, first: &Shape, second: &Shape) -> f64 {
    betweenness(&RelativePosition::between(a, first), &RelativePosition::between(a, second))
}

/// How far an object lies between two others, from its relations to them.
pub(super) fn betweenness(one: &RelativePosition, other: &RelativePosition) -> f64 {
    const DIRECTIONS: usize = 32;
    let (mut one, mut other) = (Judge::new(one.constant()), Judge::new(other.constant()));
    let both = |i: usize| {
        let theta = TAU * i as f64 / DIRECTIONS as f64;
        one.degree(theta).a.min(other.degree(theta + PI).a)
    };
    (0..DIRECTIONS).map(both).fold(0.0, f64::max)
}

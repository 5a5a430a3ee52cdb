//! Histograms of forces between polygons, exactly, by pairs of edges.
//!
//! F(θ) = − Σ sA·sB ∫ G(max(0, gap(v))) dv over the edges of A and B and the
//! range of normal offsets v that both cover; an edge counts +1 where a line of
//! direction θ leaves its object and −1 where it enters, and G'' is the force
//! φ. No slicing into trapezoids, no sorting of runs; holes and parts need no
//! care of their own, and one sweep serves θ and θ + π and every force.

mod pairs;
mod sweep;
mod total;

use self::sweep::{Outline, Sweep};
use self::total::{Gaps, Totals};
use super::histogram::direction;
use super::{Force, Histogram, Infinite, Shape};

/// A share of the smaller area below which two objects count as touching, not overlapping.
const TOUCHING: f64 = 1e-9;
/// Y0 of the hybrid force: this share of the smaller object's diameter … (Matsakis & Wendling's p0)
const NEAR_BY_SIZE: f64 = 0.01;
/// … or this multiple of the intersection's diameter, whichever is more (p1).
const NEAR_BY_OVERLAP: f64 = 3.0;

/// The histogram of `a` against `b`: value i is the weight of the arguments for "a is in direction 2π·i/K of b".
///
/// # Errors
/// [`Infinite`] where the force diverges: r ≥ 2 and the objects touch, or r ≥ 1 and they overlap.
pub fn histogram(a: &Shape, b: &Shape, force: Force, directions: usize) -> Result<Histogram, Infinite> {
    require_finite(a, b, force)?;
    Ok(finite_histograms(a, b, &[force], directions).remove(0))
}

/// The histograms of several forces, for little more than the price of one.
///
/// ```
/// use spatial_fetch::force::{Force, Shape, polygon};
/// let square = |x: f64| Shape::from_ring(vec![[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]]);
/// let (a, b) = (square(1.0), square(0.0));
/// let histograms = polygon::histograms(&a, &b, &[Force::Power(0.0), Force::Power(2.0)], 8);
/// assert!(histograms[0].is_ok());
/// // The squares share an edge: gravitation between them has no bound.
/// assert!(histograms[1].is_err());
/// ```
pub fn histograms(a: &Shape, b: &Shape, forces: &[Force], directions: usize) -> Vec<Result<Histogram, Infinite>> {
    let checks: Vec<Result<(), Infinite>> = forces.iter().map(|force| require_finite(a, b, *force)).collect();
    let finite: Vec<Force> = forces.iter().zip(&checks).filter(|(_, check)| check.is_ok()).map(|(f, _)| *f).collect();
    let mut computed = finite_histograms(a, b, &finite, directions).into_iter();
    checks.into_iter().map(|check| check.and_then(|()| computed.next().ok_or(Infinite))).collect()
}

/// The histograms of forces that are known not to diverge.
pub(super) fn finite_histograms(a: &Shape, b: &Shape, forces: &[Force], directions: usize) -> Vec<Histogram> {
    let origin = b.corner();
    let (mut a, mut b) = (Outline::new(a, origin), Outline::new(b, origin));
    let mut totals = Totals::new(forces);
    let mut sweep = Sweep::default();
    let mut values = vec![vec![0.0; directions]; forces.len()];
    // A sweep yields both directions of its axis.
    let (swept, half) = if directions.is_multiple_of(2) { (directions / 2, directions / 2) } else { (directions, 0) };
    for i in 0..swept {
        let (sin, cos) = direction(i, directions);
        if !resultants(&mut a, &mut b, &mut sweep, &mut totals, (sin, cos)) {
            continue;
        }
        for (values, [ahead, behind]) in values.iter_mut().zip(totals.take()) {
            values[i] = ahead;
            if half > 0 {
                values[i + half] = behind;
            }
        }
    }
    values.into_iter().map(Histogram::from_values).collect()
}

/// Sums the forces along one axis; false when no line of that direction meets both objects.
fn resultants(a: &mut Outline, b: &mut Outline, sweep: &mut Sweep, totals: &mut Totals, axis: (f64, f64)) -> bool {
    let (of_a, of_b) = (a.turn(axis.0, axis.1), b.turn(axis.0, axis.1));
    let shared = (of_a.across.0.max(of_b.across.0), of_a.across.1.min(of_b.across.1));
    if shared.0 >= shared.1 {
        return false;
    }
    totals.begin(
        Gaps::new(of_a.along.0 - of_b.along.1, of_a.along.1 - of_b.along.0),
        Gaps::new(of_b.along.0 - of_a.along.1, of_b.along.1 - of_a.along.0),
    );
    sweep.run(a, b, shared, |first, last, weight| totals.add(first, last, weight));
    true
}

/// Area of the intersection, square units.
pub fn intersection_area(a: &Shape, b: &Shape) -> f64 {
    let origin = b.corner();
    let (mut a, mut b) = (Outline::new(a, origin), Outline::new(b, origin));
    // Any direction gives it; this one is parallel to hardly any edge.
    let (sin, cos) = 0.123_f64.sin_cos();
    let (of_a, of_b) = (a.turn(sin, cos), b.turn(sin, cos));
    let shared = (of_a.across.0.max(of_b.across.0), of_a.across.1.min(of_b.across.1));
    let mut sum = 0.0;
    // With G(d) = d for open gaps the sum counts the coincident points of each line.
    Sweep::default().run(&mut a, &mut b, shared, |first, last, weight| {
        let (low, high) = (first.min(last), first.max(last));
        let open = if high <= 0.0 {
            0.0
        } else if low >= 0.0 {
            (low + high) / 2.0
        } else {
            high * high / (2.0 * (high - low))
        };
        sum -= weight * open;
    });
    sum.max(0.0)
}

/// The hybrid force with Y0 as Matsakis & Wendling choose it: a hundredth of the smaller object's diameter, or three
/// times the diameter of the intersection if that is more (diameters of discs of the same area).
pub fn hybrid(a: &Shape, b: &Shape) -> Force {
    hybrid_of_areas(a.area().min(b.area()), overlap(a, b))
}

pub(super) fn hybrid_of_areas(smaller: f64, shared: f64) -> Force {
    let diameter = |area: f64| 2.0 * (area / std::f64::consts::PI).sqrt();
    Force::Hybrid((NEAR_BY_SIZE * diameter(smaller)).max(NEAR_BY_OVERLAP * diameter(shared)))
}

/// The area of the intersection, zero where the objects only touch.
fn overlap(a: &Shape, b: &Shape) -> f64 {
    if !a.touches(b) {
        return 0.0;
    }
    let shared = intersection_area(a, b);
    if shared > TOUCHING * a.area().min(b.area()) { shared } else { 0.0 }
}

/// Finite are: r < 1 always, r < 2 while the interiors are apart, any r while the objects are.
fn require_finite(a: &Shape, b: &Shape, force: Force) -> Result<(), Infinite> {
    let Force::Power(r) = force else { return Ok(()) };
    let diverges = r >= 1.0 && a.touches(b) && (r >= 2.0 || overlap(a, b) > 0.0);
    if diverges { Err(Infinite) } else { Ok(()) }
}

#[cfg(test)]
mod tests;

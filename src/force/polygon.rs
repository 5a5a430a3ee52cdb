//! Histograms of forces between polygons, exactly, by pairs of edges.
//!
//! F(θ) = − Σ sA·sB ∫ G(max(0, gap(v))) dv over the edges of A and B and the
//! range of normal offsets v that both cover; an edge counts +1 where a line of
//! direction θ leaves its object and −1 where it enters. No slicing, no
//! sorting of runs; holes and parts need no care of their own.

use std::f64::consts::TAU;

use super::kernel::Kernel;
use super::{Force, Infinite, Shape};
use crate::geometry::Vec2;

/// A share of the smaller area below which two objects count as touching, not overlapping.
const TOUCHING: f64 = 1e-9;
/// Y0 of the hybrid force: this share of the smaller object's diameter … (Matsakis & Wendling's p0)
const NEAR_BY_SIZE: f64 = 0.01;
/// … or this multiple of the intersection's diameter, whichever is more (p1).
const NEAR_BY_OVERLAP: f64 = 3.0;

/// One value per direction; value i belongs to θ = offset + 2π·i/K.
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

    /// The histogram of B against A: half a turn round.
    pub fn reversed(&self) -> Self {
        let half = self.values.len() / 2;
        Self { values: [&self.values[half..], &self.values[..half]].concat() }
    }
}

/// The histogram of `a` against `b` in `directions` directions from θ = 0 on.
pub fn histogram(a: &Shape, b: &Shape, force: Force, directions: usize) -> Result<Histogram, Infinite> {
    histogram_from(a, b, force, directions, 0.0)
}

/// The same, beginning at θ = `first`, radians.
pub fn histogram_from(
    a: &Shape,
    b: &Shape,
    force: Force,
    directions: usize,
    first: f64,
) -> Result<Histogram, Infinite> {
    require_finite(a, b, force)?;
    let (edges_a, edges_b): (Vec<_>, Vec<_>) = (a.edges().collect(), b.edges().collect());
    let value = |i: usize| resultant(&edges_a, &edges_b, force, first + TAU * i as f64 / directions as f64);
    Ok(Histogram { values: (0..directions).map(value).collect() })
}

/// Area of the intersection, square units.
pub fn intersection_area(a: &Shape, b: &Shape) -> f64 {
    let (edges_a, edges_b): (Vec<_>, Vec<_>) = (a.edges().collect(), b.edges().collect());
    // Any direction gives it; this one is parallel to hardly any edge.
    resultant(&edges_a, &edges_b, Force::Overlap, 0.123).max(0.0)
}

/// The hybrid force with Y0 as Matsakis & Wendling choose it.
pub fn hybrid(a: &Shape, b: &Shape) -> Force {
    let diameter = |area: f64| 2.0 * (area / std::f64::consts::PI).sqrt();
    let by_size = NEAR_BY_SIZE * diameter(a.area().min(b.area()));
    Force::Hybrid(by_size.max(NEAR_BY_OVERLAP * diameter(overlap(a, b))))
}

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

/// An edge in the frame of a direction: along it and across it, from lower to higher offset.
#[derive(Clone, Copy)]
struct Side {
    /// Offset across the direction at both ends, ascending.
    from: f64,
    to: f64,
    /// Position along the direction at both ends.
    start: f64,
    end: f64,
    /// +1 where lines leave the object through it, −1 where they enter.
    sign: f64,
}

fn sides(edges: &[(Vec2, Vec2)], sin: f64, cos: f64) -> Vec<Side> {
    let along = |p: Vec2| p.x * cos + p.y * sin;
    let across = |p: Vec2| p.y * cos - p.x * sin;
    edges
        .iter()
        .filter_map(|&(a, b)| {
            let (va, vb) = (across(a), across(b));
            // The interior lies to the left of a→b: rising offsets mean the line leaves here.
            if vb > va {
                Some(Side { from: va, to: vb, start: along(a), end: along(b), sign: 1.0 })
            } else if va > vb {
                Some(Side { from: vb, to: va, start: along(b), end: along(a), sign: -1.0 })
            } else {
                None
            }
        })
        .collect()
}

impl Side {
    fn at(&self, v: f64) -> f64 {
        self.start + (self.end - self.start) * ((v - self.from) / (self.to - self.from))
    }
}

/// The resultant in direction `theta`.
fn resultant(edges_a: &[(Vec2, Vec2)], edges_b: &[(Vec2, Vec2)], force: Force, theta: f64) -> f64 {
    let (sin, cos) = exact_sin_cos(theta);
    let (mut a, b) = (sides(edges_a, sin, cos), sides(edges_b, sin, cos));
    let extent = |sides: &[Side], pick: fn(&Side) -> (f64, f64)| {
        sides
            .iter()
            .map(pick)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (x, y)| (low.min(x.min(y)), high.max(x.max(y))))
    };
    let ((a_low, a_high), (b_low, b_high)) = (extent(&a, |s| (s.start, s.end)), extent(&b, |s| (s.start, s.end)));
    let ((a_from, a_to), (b_from, b_to)) = (extent(&a, |s| (s.from, s.to)), extent(&b, |s| (s.from, s.to)));
    if a_high <= b_low || a_to <= b_from || b_to <= a_from {
        return 0.0;
    }
    let kernel = Kernel::new(force, a_low - b_high, a_high - b_low);
    a.retain(|side| side.to > b_from && side.from < b_to);
    let mut sum = 0.0;
    for sa in &a {
        for sb in &b {
            let (from, to) = (sa.from.max(sb.from), sa.to.min(sb.to));
            if from < to {
                let gap = |v: f64| sa.at(v) - sb.at(v);
                sum -= sa.sign * sb.sign * (to - from) * kernel.mean(gap(from), gap(to));
            }
        }
    }
    // Rounding may leave a trace where there is no force at all.
    if sum < 0.0 { 0.0 } else { sum }
}

/// Sine and cosine that are exact on the quarter turns.
fn exact_sin_cos(theta: f64) -> (f64, f64) {
    let quarters = theta / std::f64::consts::FRAC_PI_2;
    let nearest = quarters.round();
    if (quarters - nearest).abs() > 1e-12 {
        return theta.sin_cos();
    }
    match (nearest as i64).rem_euclid(4) {
        0 => (0.0, 1.0),
        1 => (1.0, 0.0),
        2 => (0.0, -1.0),
        _ => (-1.0, 0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangle(x: (f64, f64), y: (f64, f64)) -> Shape {
        Shape::from_ring(vec![[x.0, y.0], [x.1, y.0], [x.1, y.1], [x.0, y.1]])
    }

    fn value(a: &Shape, b: &Shape, force: Force, degrees: f64) -> f64 {
        histogram_from(a, b, force, 1, degrees.to_radians()).expect("finite").values()[0]
    }

    fn assert_near(got: f64, want: f64) {
        assert!((got - want).abs() < 1e-12 * want.abs().max(1.0), "{got} is not {want}");
    }

    #[test]
    fn unit_squares_two_apart_have_the_known_forces() {
        let (a, b) = (rectangle((3.0, 4.0), (0.0, 1.0)), rectangle((0.0, 1.0), (0.0, 1.0)));
        assert_near(value(&a, &b, Force::Power(0.0), 0.0), 1.0);
        assert_near(value(&a, &b, Force::Power(2.0), 0.0), (9.0_f64 / 8.0).ln());
        assert_near(value(&a, &b, Force::Power(2.0), 180.0), 0.0);
    }

    #[test]
    fn a_square_against_itself_attracts_within() {
        let a = rectangle((0.0, 1.0), (0.0, 1.0));
        assert_near(value(&a, &a, Force::Power(0.0), 0.0), 0.5);
        assert_near(value(&a, &a, Force::Power(0.0), 45.0), 2.0_f64.sqrt() / 3.0);
    }

    #[test]
    fn touching_squares_have_a_finite_force_below_two_and_none_from_two_on() {
        let (a, b) = (rectangle((1.0, 2.0), (0.0, 1.0)), rectangle((0.0, 1.0), (0.0, 1.0)));
        assert_near(value(&a, &b, Force::Power(1.0), 0.0), 2.0 * 2.0_f64.ln());
        assert_eq!(histogram(&a, &b, Force::Power(2.0), 4), Err(Infinite));
        assert!(histogram(&a, &b, hybrid(&a, &b), 4).is_ok());
    }

    #[test]
    fn far_pairs_keep_their_digits() {
        // Size over distance 1e-5: the gravitational force tends to area·area/distance².
        let (a, b) = (rectangle((1e5, 1e5 + 1.0), (0.0, 1.0)), rectangle((0.0, 1.0), (0.0, 1.0)));
        let got = value(&a, &b, Force::Power(2.0), 0.0);
        assert!((got * 1e10 - 1.0).abs() < 1e-9, "{got}");
    }

    #[test]
    fn the_intersection_of_shifted_squares_is_their_overlap() {
        let (a, b) = (rectangle((0.25, 1.25), (0.5, 1.5)), rectangle((0.0, 1.0), (0.0, 1.0)));
        assert_near(intersection_area(&a, &b), 0.375);
    }

    #[test]
    fn a_hole_exerts_no_force() {
        let square = |low: f64, high: f64| vec![[low, low], [high, low], [high, high], [low, high], [low, low]];
        let frame = Shape::from_parts(&[vec![square(0.0, 3.0), square(1.0, 2.0)]]).expect("a frame");
        let b = rectangle((-3.0, -2.0), (1.0, 2.0));
        let whole = rectangle((0.0, 3.0), (0.0, 3.0));
        let hole = rectangle((1.0, 2.0), (1.0, 2.0));
        for degrees in [0.0, 7.0, 20.0] {
            let difference =
                value(&whole, &b, Force::Power(2.0), degrees) - value(&hole, &b, Force::Power(2.0), degrees);
            assert_near(value(&frame, &b, Force::Power(2.0), degrees), difference);
        }
    }
}

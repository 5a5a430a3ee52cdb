//! The relative position of two objects, as people and robots ask for it.

use std::f64::consts::{PI, TAU};

use super::degree::{Judge, degree_of_truth};
use super::main_direction::main_direction;
use super::polygon::{finite_histograms, hybrid, intersection_area};
use super::raster::{Raster, RasterPair};
use super::surround::surround;
use super::{DegreeOfTruth, Force, Histogram, Shape};
use crate::geometry::Vec2;

/// Least number of directions.
const DIRECTIONS: usize = 16;
/// Directions that the pair should show a force in: fewer, and a small or far object falls between two of them.
const BINS_WITH_FORCE: f64 = 8.0;
/// The most directions; a pair that is narrower still is taken for two points.
const MOST_DIRECTIONS: usize = 1024;

/// Where `a` is relative to `b`: two histograms, of constant and of hybrid forces, and what they say.
///
/// Constant forces see the objects whole, hybrid ones the parts nearest to each other.
///
/// ```
/// use spatial_fetch::force::{RelativePosition, Shape};
/// let square = |x: f64| Shape::from_ring(vec![[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]]);
/// let relation = RelativePosition::between(&square(3.0), &square(0.0));
/// assert!(relation.degree(0.0).a > 0.99);
/// assert_eq!(relation.distance(), 2.0);
/// ```
#[derive(Clone, Debug)]
pub struct RelativePosition {
    constant: Histogram,
    hybrid: Histogram,
    distance: f64,
    shared_area: f64,
    areas: (f64, f64),
    diameters: (f64, f64),
}

impl RelativePosition {
    /// The relation of `a` to `b`, on as many directions as the pair needs (16 at least).
    pub fn between(a: &Shape, b: &Shape) -> Self {
        let directions = directions_for(a, b);
        let distance = a.distance(b);
        let near = match hybrid(a, b) {
            // No gap is below Y0: the hybrid force is the gravitational one.
            Force::Hybrid(y0) if distance >= y0 => Force::Power(2.0),
            force => force,
        };
        let mut histograms = finite_histograms(a, b, &[Force::Power(0.0), near], directions);
        if histograms[0].peak() <= 0.0 {
            histograms.fill(towards(a.centroid() - b.centroid()));
        }
        let hybrid = histograms.pop().unwrap_or_else(|| Histogram::from_values(Vec::new()));
        let constant = histograms.pop().unwrap_or_else(|| hybrid.clone());
        let shared_area = if distance > 0.0 { 0.0 } else { intersection_area(a, b) };
        let areas = (a.area(), b.area());
        Self { constant, hybrid, distance, shared_area, areas, diameters: (diameter(a), diameter(b)) }
    }

    /// The relation of two rasters, `a` to `b`, by their correlation.
    pub fn between_rasters(a: &Raster, b: &Raster, pair: &RasterPair) -> Self {
        let (diameters, apart) = ((a.diameter(), b.diameter()), a.offset_from(b));
        let directions = directions_for_sizes(diameters.0 + diameters.1, apart.norm());
        let mut histograms = pair.finite_histograms(&[Force::Power(0.0), pair.hybrid()], directions);
        if histograms[0].peak() <= 0.0 {
            histograms.fill(towards(apart));
        }
        let hybrid = histograms.pop().unwrap_or_else(|| Histogram::from_values(Vec::new()));
        let constant = histograms.pop().unwrap_or_else(|| hybrid.clone());
        let (shared_area, distance) = (pair.shared_area(), pair.distance());
        Self { constant, hybrid, distance, shared_area, areas: (a.area(), b.area()), diameters }
    }

    /// The histogram of constant forces, F0.
    pub fn constant(&self) -> &Histogram {
        &self.constant
    }

    /// The histogram of hybrid forces.
    pub fn hybrid(&self) -> &Histogram {
        &self.hybrid
    }

    /// Degree of truth of "a is in direction `theta` of b", radians: the mean of both opinions, and no more than the
    /// lesser of what the two allow. (How opinions merge is left open by the literature.)
    pub fn degree(&self, theta: f64) -> DegreeOfTruth {
        self.degrees([theta])[0]
    }

    /// What constant and hybrid forces each think of "a is in direction `theta` of b", radians.
    pub fn opinions(&self, theta: f64) -> [DegreeOfTruth; 2] {
        [&self.constant, &self.hybrid].map(|histogram| degree_of_truth(histogram, theta))
    }

    /// The degrees of several directions at once.
    pub fn degrees<const N: usize>(&self, thetas: [f64; N]) -> [DegreeOfTruth; N] {
        let (mut whole, mut near) = (Judge::new(&self.constant), Judge::new(&self.hybrid));
        thetas.map(|theta| merge(whole.degree(theta), near.degree(theta)))
    }

    /// The direction in which a lies, radians, 0 to 2π; nothing where none stands out.
    pub fn main_direction(&self) -> Option<f64> {
        let sum = self.constant.values().iter().zip(self.hybrid.values());
        // Each opinion counts alike, whatever its unit.
        let (whole, near) = (self.constant.peak().max(f64::MIN_POSITIVE), self.hybrid.peak().max(f64::MIN_POSITIVE));
        main_direction(&Histogram::from_values(sum.map(|(c, h)| c / whole + h / near).collect()))
    }

    /// The gap, zero when they touch.
    pub fn distance(&self) -> f64 {
        self.distance
    }

    /// How far a surrounds b, 0 to 1; zero when b is the larger, for then it can only be the other way round.
    pub fn surround(&self) -> f64 {
        if self.diameters.0 > self.diameters.1 { surround(&self.constant) } else { 0.0 }
    }

    /// How far b surrounds a, 0 to 1.
    pub fn surrounded(&self) -> f64 {
        if self.diameters.1 > self.diameters.0 { surround(&self.constant) } else { 0.0 }
    }

    /// The share of a that lies inside b, 0 to 1.
    pub fn inside(&self) -> f64 {
        (self.shared_area / self.areas.0).clamp(0.0, 1.0)
    }

    /// The share of b that lies inside a, 0 to 1.
    pub fn contains(&self) -> f64 {
        (self.shared_area / self.areas.1).clamp(0.0, 1.0)
    }

    /// The gap in diameters of the smaller object.
    pub fn relative_distance(&self) -> f64 {
        self.distance / self.diameters.0.min(self.diameters.1)
    }
}

/// The mean of two opinions, bounded by what both allow.
fn merge(whole: DegreeOfTruth, near: DegreeOfTruth) -> DegreeOfTruth {
    let b = whole.b.min(near.b);
    DegreeOfTruth { a: ((whole.a + near.a) / 2.0).min(b), b }
}

fn diameter(shape: &Shape) -> f64 {
    let (low, high) = shape.bounds();
    (high - low).norm()
}

/// Enough directions for the angle under which the two see each other.
fn directions_for(a: &Shape, b: &Shape) -> usize {
    let ((a_low, a_high), (b_low, b_high)) = (a.bounds(), b.bounds());
    let reach = (a_high - a_low).norm() + (b_high - b_low).norm();
    directions_for_sizes(reach, ((a_low + a_high) - (b_low + b_high)).norm() / 2.0)
}

/// Enough directions for two objects of the given diameters together, whose centres are `apart`.
fn directions_for_sizes(diameters: f64, apart: f64) -> usize {
    let reach = diameters / 2.0;
    let angle = if reach < apart { 2.0 * (reach / apart).asin() } else { PI };
    let wanted = (TAU / angle * BINS_WITH_FORCE) as usize;
    wanted.clamp(DIRECTIONS, MOST_DIRECTIONS).next_power_of_two()
}

/// The histogram of two points: all force in the direction nearest to the way from b to a.
fn towards(way: Vec2) -> Histogram {
    let bin = (way.y.atan2(way.x).rem_euclid(TAU) / TAU * MOST_DIRECTIONS as f64).round() as usize;
    let mut values = vec![0.0; MOST_DIRECTIONS];
    values[bin % MOST_DIRECTIONS] = 1.0;
    Histogram::from_values(values)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64) -> Shape {
        Shape::from_ring(vec![[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]])
    }

    fn frame(low: f64, high: f64) -> Shape {
        let ring = |low: f64, high: f64| vec![[low, low], [high, low], [high, high], [low, high], [low, low]];
        Shape::from_parts(&[vec![ring(low, high), ring(low + 1.0, high - 1.0)]]).expect("a frame")
    }

    #[test]
    fn a_square_to_the_right_is_to_the_right() {
        let relation = RelativePosition::between(&square(3.0, 0.0), &square(0.0, 0.0));
        assert!(relation.degree(0.0).a > 0.9);
        assert!(relation.degree(PI).a < 0.01);
        assert!(relation.main_direction().expect("a direction") < 0.01);
        assert!((relation.distance() - 2.0).abs() < 1e-12);
    }

    #[test]
    fn a_small_object_far_away_has_a_direction_wherever_it_stands() {
        for degrees in [3.0_f64, 11.0, 47.3, 200.1] {
            let theta = degrees.to_radians();
            for distance in [5.0, 50.0, 5000.0] {
                let far = square(distance * theta.cos(), distance * theta.sin());
                let found = RelativePosition::between(&far, &square(0.0, 0.0)).main_direction().expect("a direction");
                assert!((found - theta).abs() < 0.02, "{degrees}° at {distance}: {}", found.to_degrees());
            }
        }
    }

    #[test]
    fn a_ring_surrounds_what_is_in_it_and_not_the_other_way_round() {
        let relation = RelativePosition::between(&frame(-2.0, 3.0), &square(0.0, 0.0));
        assert!(relation.surround() > 0.8 && relation.surrounded() == 0.0);
        assert!(RelativePosition::between(&square(0.0, 0.0), &frame(-2.0, 3.0)).surrounded() > 0.8);
        assert!(RelativePosition::between(&square(3.0, 0.0), &square(0.0, 0.0)).surround() < 0.1);
    }

    #[test]
    fn a_square_within_another_is_inside_it() {
        let large = Shape::from_ring(vec![[-2.0, -2.0], [3.0, -2.0], [3.0, 3.0], [-2.0, 3.0]]);
        let relation = RelativePosition::between(&square(0.0, 0.0), &large);
        assert!((relation.inside() - 1.0).abs() < 1e-9 && (relation.contains() - 0.04).abs() < 1e-9);
        assert_eq!(relation.distance(), 0.0);
    }
}

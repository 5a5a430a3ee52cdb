//! Areal objects: rings with holes, in several parts.

use super::ShapeError;
use super::validity::{self, Ring};
use crate::geometry::{Polygon, Vec2, cross, ring, vec2};
use crate::limits::SHAPE_CORNERS;

/// An areal object: outer rings counter-clockwise, holes clockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    rings: Vec<Vec<Vec2>>,
}

impl Shape {
    /// A shape of one simple ring, in either order, unchecked.
    pub fn from_ring(ring: Vec<[f64; 2]>) -> Self {
        Self { rings: vec![oriented(ring.into_iter().map(|[x, y]| vec2(x, y)).collect(), true)] }
    }

    /// A shape of rings that may share borders, counter-clockwise, unchecked.
    #[cfg(test)]
    pub(super) fn of_cells(rings: Vec<Vec<Vec2>>) -> Self {
        Self { rings }
    }

    /// A shape from polygons as GeoJSON has them: for each part its closed outer ring, then closed rings of holes.
    ///
    /// # Errors
    /// What is wrong with the first bad ring, by its number.
    pub fn from_parts(parts: &[Vec<Vec<[f64; 2]>>]) -> Result<Self, ShapeError> {
        let corners = parts.iter().flatten().map(Vec::len).sum();
        SHAPE_CORNERS.check(corners).map_err(ShapeError::TooMany)?;
        let mut rings = Vec::new();
        for (part, own) in parts.iter().enumerate() {
            for (i, ring) in own.iter().enumerate() {
                let number = rings.len() + 1;
                rings.push(Ring { corners: checked(ring, number)?, part, is_hole: i > 0 });
            }
        }
        if rings.is_empty() {
            return Err(ShapeError::Empty);
        }
        validity::check(&rings)?;
        for (i, bounded) in rings.iter().enumerate() {
            if ring::area(ring::edges(&bounded.corners), Vec2::zeros()) == 0.0 {
                return Err(ShapeError::NoArea(i + 1));
            }
        }
        Ok(Self { rings: rings.into_iter().map(|ring| oriented(ring.corners, !ring.is_hole)).collect() })
    }

    /// The edges, each with the object's interior on its left.
    pub fn edges(&self) -> impl Iterator<Item = (Vec2, Vec2)> + '_ {
        self.rings.iter().flat_map(|corners| ring::edges(corners))
    }

    /// Square units.
    pub fn area(&self) -> f64 {
        ring::area(self.edges(), self.corner())
    }

    /// Whether a point lies inside.
    pub fn contains(&self, point: Vec2) -> bool {
        ring::surrounds(self.edges(), point)
    }

    /// The rings, outer ones counter-clockwise, holes clockwise.
    pub fn rings(&self) -> &[Vec<Vec2>] {
        &self.rings
    }

    /// One of the corners.
    pub(super) fn corner(&self) -> Vec2 {
        self.rings.first().and_then(|ring| ring.first()).copied().unwrap_or_else(Vec2::zeros)
    }

    /// The lowest and highest x and y.
    pub fn bounds(&self) -> (Vec2, Vec2) {
        ring::bounds(self.rings.iter().flatten())
    }

    /// The centre of area.
    pub fn centroid(&self) -> Vec2 {
        ring::centroid(self.edges(), self.corner())
    }
}

fn checked(ring: &[[f64; 2]], number: usize) -> Result<Vec<Vec2>, ShapeError> {
    if let Some(at) = ring.iter().position(|p| !p[0].is_finite() || !p[1].is_finite()) {
        return Err(ShapeError::NotFinite(number, at + 1));
    }
    if ring.len() < 4 {
        return Err(ShapeError::TooFewCorners(number));
    }
    if ring[0] != ring[ring.len() - 1] {
        return Err(ShapeError::Open(number));
    }
    let mut corners: Vec<Vec2> = ring[..ring.len() - 1].iter().map(|&[x, y]| vec2(x, y)).collect();
    corners.dedup();
    if corners.len() < 3 {
        return Err(ShapeError::TooFewCorners(number));
    }
    let first = corners[0];
    let on_a_line = corners.iter().all(|c| cross(corners[1] - first, c - first) == 0.0);
    if on_a_line { Err(ShapeError::NoArea(number)) } else { Ok(corners) }
}

fn oriented(mut corners: Vec<Vec2>, counter_clockwise: bool) -> Vec<Vec2> {
    if (ring::area(ring::edges(&corners), Vec2::zeros()) > 0.0) != counter_clockwise {
        corners.reverse();
    }
    corners
}

impl From<&Polygon> for Shape {
    fn from(polygon: &Polygon) -> Self {
        Self { rings: vec![polygon.corners().to_vec()] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(ring: &[[f64; 2]]) -> ShapeError {
        Shape::from_parts(&[vec![ring.to_vec()]]).expect_err("a bad ring")
    }

    #[test]
    fn each_kind_of_bad_ring_is_called_by_its_name() {
        assert_eq!(error(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]), ShapeError::Open(1));
        assert_eq!(
            error(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.5], [0.0, 0.0]]),
            ShapeError::SelfCrossing(1, 1, 3)
        );
        assert_eq!(error(&[[0.0, 0.0], [f64::NAN, 1.0], [1.0, 0.0], [0.0, 0.0]]), ShapeError::NotFinite(1, 2));
        assert_eq!(error(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [0.0, 0.0]]), ShapeError::NoArea(1));
        assert_eq!(error(&[[0.0, 0.0], [1.0, 1.0], [0.0, 0.0]]), ShapeError::TooFewCorners(1));
        assert_eq!(Shape::from_parts(&[]), Err(ShapeError::Empty));
    }

    #[test]
    fn a_hole_is_outside() {
        let square = |low: f64, high: f64| vec![[low, low], [high, low], [high, high], [low, high], [low, low]];
        let ring = Shape::from_parts(&[vec![square(0.0, 3.0), square(1.0, 2.0)]]).expect("a ring");
        assert_eq!(ring.area(), 8.0);
        assert!(ring.contains(vec2(0.5, 0.5)) && !ring.contains(vec2(1.5, 1.5)));
    }
}

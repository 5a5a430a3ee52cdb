//! Areal objects: rings with holes, in several parts.

use crate::geometry::{Polygon, Vec2, cross, vec2};

/// An areal object: outer rings counter-clockwise, holes clockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    rings: Vec<Vec<Vec2>>,
}

/// What keeps a list of rings from being an areal object.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ShapeError {
    /// No ring at all.
    #[error("the shape is empty; give it at least one ring of three corners")]
    Empty,
    /// Fewer than three different corners.
    #[error("ring {0} has fewer than three corners")]
    TooFewCorners(usize),
    /// First and last position differ.
    #[error("ring {0} is open; its last position must repeat its first")]
    Open(usize),
    /// NaN or infinite.
    #[error("ring {0} has a coordinate that is not a finite number, at position {1}")]
    NotFinite(usize, usize),
    /// Two edges cross.
    #[error("ring {0} crosses itself, at edges {1} and {2}")]
    SelfCrossing(usize, usize, usize),
    /// All corners on a line.
    #[error("ring {0} has no area")]
    NoArea(usize),
}

impl Shape {
    /// A shape of one simple ring, in either order, unchecked.
    pub fn from_ring(ring: Vec<[f64; 2]>) -> Self {
        Self { rings: vec![oriented(ring.into_iter().map(|[x, y]| vec2(x, y)).collect(), true)] }
    }

    /// A shape from polygons as GeoJSON has them: for each part its closed outer ring, then closed rings of holes.
    pub fn from_parts(parts: &[Vec<Vec<[f64; 2]>>]) -> Result<Self, ShapeError> {
        let mut rings = Vec::new();
        for part in parts {
            for (i, ring) in part.iter().enumerate() {
                let number = rings.len() + 1;
                rings.push(oriented(checked(ring, number)?, i == 0));
            }
        }
        if rings.is_empty() { Err(ShapeError::Empty) } else { Ok(Self { rings }) }
    }

    /// The edges, each with the object's interior on its left.
    pub fn edges(&self) -> impl Iterator<Item = (Vec2, Vec2)> + '_ {
        self.rings.iter().flat_map(|ring| (0..ring.len()).map(move |i| (ring[i], ring[(i + 1) % ring.len()])))
    }

    /// Square units.
    pub fn area(&self) -> f64 {
        let origin = self.corner();
        self.edges().map(|(a, b)| cross(a - origin, b - origin)).sum::<f64>() / 2.0
    }

    /// Whether a point lies inside.
    pub fn contains(&self, point: Vec2) -> bool {
        let crossings = self.edges().filter(|(a, b)| {
            (a.y > point.y) != (b.y > point.y) && point.x < (b.x - a.x) * (point.y - a.y) / (b.y - a.y) + a.x
        });
        crossings.count() % 2 == 1
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
        let start = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY));
        self.rings.iter().flatten().fold(start, |(low, high), c| (low.inf(c), high.sup(c)))
    }

    /// The centre of area.
    pub fn centroid(&self) -> Vec2 {
        let origin = self.corner();
        let (mut sum, mut doubled_area) = (Vec2::zeros(), 0.0);
        for (a, b) in self.edges().map(|(a, b)| (a - origin, b - origin)) {
            sum += (a + b) * cross(a, b);
            doubled_area += cross(a, b);
        }
        origin + sum / (3.0 * doubled_area)
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
    // Before the area, which is zero for a bow tie too.
    if let Some((i, j)) = crossing(&corners) {
        return Err(ShapeError::SelfCrossing(number, i + 1, j + 1));
    }
    if signed_area(&corners) == 0.0 { Err(ShapeError::NoArea(number)) } else { Ok(corners) }
}

/// Two edges of a ring that cross properly, the lower numbers first.
///
/// Edges are taken from left to right and compared with those whose range of
/// x is still open, so that long coastlines are checked in little more than
/// the time it takes to sort them.
fn crossing(corners: &[Vec2]) -> Option<(usize, usize)> {
    let n = corners.len();
    let edge = |i: usize| (corners[i], corners[(i + 1) % n]);
    let mut order: Vec<(f64, usize)> = (0..n).map(|i| (edge(i).0.x.min(edge(i).1.x), i)).collect();
    order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut open: Vec<usize> = Vec::new();
    for (left, i) in order {
        let (a, b) = edge(i);
        open.retain(|&j| edge(j).0.x.max(edge(j).1.x) >= left);
        if let Some(&j) = open.iter().find(|&&j| cross_properly((a, b), edge(j))) {
            return Some((i.min(j), i.max(j)));
        }
        open.push(i);
    }
    None
}

fn cross_properly((a, b): (Vec2, Vec2), (c, d): (Vec2, Vec2)) -> bool {
    boxes_meet((a.inf(&b), a.sup(&b)), (c.inf(&d), c.sup(&d)))
        && cross(b - a, c - a) * cross(b - a, d - a) < 0.0
        && cross(d - c, a - c) * cross(d - c, b - c) < 0.0
}

fn signed_area(corners: &[Vec2]) -> f64 {
    (0..corners.len()).map(|i| cross(corners[i], corners[(i + 1) % corners.len()])).sum()
}

fn oriented(mut corners: Vec<Vec2>, counter_clockwise: bool) -> Vec<Vec2> {
    if (signed_area(&corners) > 0.0) != counter_clockwise {
        corners.reverse();
    }
    corners
}

impl From<&Polygon> for Shape {
    fn from(polygon: &Polygon) -> Self {
        Self { rings: vec![polygon.corners().to_vec()] }
    }
}

/// Whether two boxes, each its lowest and highest corner, share a point.
pub(super) fn boxes_meet((l1, h1): (Vec2, Vec2), (l2, h2): (Vec2, Vec2)) -> bool {
    l1.x <= h2.x && l2.x <= h1.x && l1.y <= h2.y && l2.y <= h1.y
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

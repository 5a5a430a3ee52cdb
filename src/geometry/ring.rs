//! What holds of any closed ring of corners, of a polygon as of a shape with holes.

use super::{Vec2, cross};

/// The edges of a ring, its last corner joined to the first.
pub fn edges(corners: &[Vec2]) -> impl Iterator<Item = (Vec2, Vec2)> + '_ {
    let n = corners.len();
    (0..n).map(move |i| (corners[i], corners[if i + 1 == n { 0 } else { i + 1 }]))
}

/// The area to the left of the edges, square units, reckoned about `origin`: the nearer it is, the less is lost.
pub fn area(edges: impl Iterator<Item = (Vec2, Vec2)>, origin: Vec2) -> f64 {
    edges.map(|(a, b)| cross(a - origin, b - origin)).sum::<f64>() / 2.0
}

/// The centre of the area to the left of the edges, reckoned about `origin`.
pub fn centroid(edges: impl Iterator<Item = (Vec2, Vec2)>, origin: Vec2) -> Vec2 {
    let (mut sum, mut doubled_area) = (Vec2::zeros(), 0.0);
    for (a, b) in edges.map(|(a, b)| (a - origin, b - origin)) {
        sum += (a + b) * cross(a, b);
        doubled_area += cross(a, b);
    }
    origin + sum / (3.0 * doubled_area)
}

/// The lowest and highest x and y.
pub fn bounds<'c>(corners: impl Iterator<Item = &'c Vec2>) -> (Vec2, Vec2) {
    let start = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY));
    corners.fold(start, |(low, high), c| (low.inf(c), high.sup(c)))
}

/// Whether a point lies inside, by the parity of crossings; on the border either may come out.
pub fn surrounds(edges: impl Iterator<Item = (Vec2, Vec2)>, point: Vec2) -> bool {
    let crosses = |(a, b): &(Vec2, Vec2)| {
        (a.y > point.y) != (b.y > point.y) && point.x < (b.x - a.x) * (point.y - a.y) / (b.y - a.y) + a.x
    };
    edges.filter(crosses).count() % 2 == 1
}

//! Simple polygons without holes: footprints and room outlines.

use super::{
    Pose, Vec2, cross, distance_to_segment, ring, segment_distance, segments_touch, squared_distance_to_segment, vec2,
};

/// A point so near to an edge lies on it, metres.
const BORDER_M: f64 = 1e-9;

/// A simple polygon, counter-clockwise, its last corner joined to the first.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    corners: Vec<Vec2>,
}

impl Polygon {
    /// A polygon from its corners in either order; they are turned counter-clockwise.
    pub fn new(mut corners: Vec<Vec2>) -> Self {
        if signed_area(&corners) < 0.0 {
            corners.reverse();
        }
        Self { corners }
    }

    /// A rectangle centred on `pose`, `length` along its heading, `width` across, metres.
    pub fn rectangle(pose: Pose, length: f64, width: f64) -> Self {
        let (l, w) = (length / 2.0, width / 2.0);
        Self::new([vec2(-l, -w), vec2(l, -w), vec2(l, w), vec2(-l, w)].map(|c| pose.to_world(c)).to_vec())
    }

    /// A regular polygon with `sides` corners inscribed in an ellipse of the given axes, metres.
    pub fn ellipse(pose: Pose, length: f64, width: f64, sides: usize) -> Self {
        let corner = |i: usize| {
            let angle = std::f64::consts::TAU * i as f64 / sides as f64;
            pose.to_world(vec2(length / 2.0 * angle.cos(), width / 2.0 * angle.sin()))
        };
        Self::new((0..sides).map(corner).collect())
    }

    /// The convex hull of points (Andrew's monotone chain).
    pub fn hull(mut points: Vec<Vec2>) -> Self {
        points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        let chain = |points: &mut dyn Iterator<Item = Vec2>| {
            let mut chain: Vec<Vec2> = Vec::new();
            for point in points {
                while let [.., a, b] = chain[..]
                    && cross(b - a, point - b) <= 0.0
                {
                    chain.pop();
                }
                chain.push(point);
            }
            chain.pop();
            chain
        };
        let mut corners = chain(&mut points.iter().copied());
        corners.extend(chain(&mut points.iter().rev().copied()));
        Self { corners }
    }

    /// The corners, counter-clockwise.
    pub fn corners(&self) -> &[Vec2] {
        &self.corners
    }

    /// The edges as pairs of corners, counter-clockwise.
    pub fn edges(&self) -> impl Iterator<Item = (Vec2, Vec2)> + '_ {
        ring::edges(&self.corners)
    }

    /// Square metres.
    pub fn area(&self) -> f64 {
        signed_area(&self.corners)
    }

    /// The centre of area.
    pub fn centroid(&self) -> Vec2 {
        ring::centroid(self.edges(), Vec2::zeros())
    }

    /// The lowest and highest x and y.
    pub fn bounds(&self) -> (Vec2, Vec2) {
        ring::bounds(self.corners.iter())
    }

    /// Whether `point` lies inside or on the border.
    pub fn contains(&self, point: Vec2) -> bool {
        self.surrounds(point) || self.edges().any(|(a, b)| distance_to_segment(point, a, b) < BORDER_M)
    }

    /// By the parity of crossings; on the border either may come out.
    fn surrounds(&self, point: Vec2) -> bool {
        ring::surrounds(self.edges(), point)
    }

    /// Whether the two share a point.
    pub fn touches(&self, other: &Self) -> bool {
        self.edges().any(|(a, b)| other.edges().any(|(c, d)| segments_touch(a, b, c, d)))
            || self.contains(other.corners[0])
            || other.contains(self.corners[0])
    }

    /// Area of the intersection over area of the union of two convex polygons, 0 to 1.
    pub fn overlap(&self, other: &Self) -> f64 {
        let mut common = self.corners.clone();
        for (a, b) in other.edges() {
            let side = |p: Vec2| cross(b - a, p - a);
            let mut kept = Vec::with_capacity(common.len() + 1);
            for (i, &p) in common.iter().enumerate() {
                let q = common[(i + 1) % common.len()];
                if side(p) >= 0.0 {
                    kept.push(p);
                }
                if (side(p) < 0.0) != (side(q) < 0.0) {
                    kept.push(p + (q - p) * (side(p) / (side(p) - side(q))));
                }
            }
            common = kept;
        }
        let shared = if common.len() < 3 { 0.0 } else { signed_area(&common).max(0.0) };
        let all = self.area() + other.area() - shared;
        if all > 0.0 { shared / all } else { 0.0 }
    }

    /// Metres between the two areas, zero when they share a point.
    pub fn distance(&self, other: &Self) -> f64 {
        if self.touches(other) {
            return 0.0;
        }
        let gaps = self.edges().flat_map(|(a, b)| other.edges().map(move |(c, d)| segment_distance(a, b, c, d)));
        gaps.fold(f64::INFINITY, f64::min)
    }

    /// Metres from the area to `point`, zero inside.
    pub fn distance_to(&self, point: Vec2) -> f64 {
        if self.surrounds(point) {
            return 0.0;
        }
        let nearest = self.distance_to_border(point);
        if nearest < BORDER_M { 0.0 } else { nearest }
    }

    /// Metres from the border to `point`, inside as outside.
    pub(super) fn distance_to_border(&self, point: Vec2) -> f64 {
        let squares = self.edges().map(|(a, b)| squared_distance_to_segment(point, a, b));
        squares.fold(f64::INFINITY, f64::min).sqrt()
    }
}

fn signed_area(corners: &[Vec2]) -> f64 {
    ring::area(ring::edges(corners), Vec2::zeros())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64) -> Polygon {
        Polygon::rectangle(Pose::new(x, y, 0.0), 1.0, 1.0)
    }

    #[test]
    fn corners_are_turned_counter_clockwise() {
        let clockwise = Polygon::new(vec![vec2(0.0, 0.0), vec2(0.0, 1.0), vec2(1.0, 1.0), vec2(1.0, 0.0)]);
        assert!((clockwise.area() - 1.0).abs() < 1e-12);
        assert!((clockwise.centroid() - vec2(0.5, 0.5)).norm() < 1e-12);
    }

    #[test]
    fn squares_two_metres_apart_have_a_gap_of_one() {
        assert!((square(0.0, 0.0).distance(&square(2.0, 0.0)) - 1.0).abs() < 1e-12);
        assert!(!square(0.0, 0.0).touches(&square(2.0, 0.0)));
    }

    #[test]
    fn squares_half_a_side_apart_share_a_third_of_their_union() {
        assert!((square(0.0, 0.0).overlap(&square(0.5, 0.0)) - 1.0 / 3.0).abs() < 1e-12);
        assert_eq!(square(0.0, 0.0).overlap(&square(2.0, 0.0)), 0.0);
    }

    #[test]
    fn a_square_inside_another_touches_it() {
        let large = Polygon::rectangle(Pose::default(), 4.0, 4.0);
        assert!(large.touches(&square(0.0, 0.0)) && square(0.0, 0.0).touches(&large));
        assert_eq!(large.distance(&square(0.5, 0.5)), 0.0);
    }

    #[test]
    fn the_border_counts_as_inside() {
        assert!(square(0.0, 0.0).contains(vec2(0.5, 0.0)));
        assert!(!square(0.0, 0.0).contains(vec2(0.500001, 0.0)));
    }

    #[test]
    fn the_hull_leaves_out_what_lies_inside() {
        let points = [(0.0, 0.0), (2.0, 0.0), (1.0, 0.5), (2.0, 2.0), (1.0, 0.0), (0.0, 2.0), (0.5, 1.5)];
        let hull = Polygon::hull(points.map(|(x, y)| vec2(x, y)).to_vec());
        assert_eq!(hull.corners().len(), 4);
        assert!((hull.area() - 4.0).abs() < 1e-12);
    }
}

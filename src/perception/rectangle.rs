//! The smallest rectangle round a set of points.

use std::f64::consts::FRAC_PI_2;

use crate::geometry::{Pose, Vec2, cross, vec2};

/// A rectangle: its middle with the heading of its long side, and both sides, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// Middle and heading of the long side.
    pub pose: Pose,
    /// The long side.
    pub long: f64,
    /// The short side.
    pub short: f64,
}

/// The rectangle of least area, one of whose sides lies along the convex hull (Freeman & Shapira 1975).
pub fn least_rectangle(points: &[Vec2]) -> Option<Rectangle> {
    let hull = convex_hull(points);
    if hull.len() < 3 {
        return None;
    }
    let along_edge = |i: usize| {
        let edge = hull[(i + 1) % hull.len()] - hull[i];
        rectangle_at(&hull, edge.y.atan2(edge.x))
    };
    (0..hull.len()).map(along_edge).min_by(|a, b| (a.long * a.short).total_cmp(&(b.long * b.short)))
}

fn rectangle_at(hull: &[Vec2], heading: f64) -> Rectangle {
    let (u, v) = (vec2(heading.cos(), heading.sin()), vec2(-heading.sin(), heading.cos()));
    let extent = |axis: Vec2| {
        hull.iter()
            .map(|p| p.dot(&axis))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), t| (low.min(t), high.max(t)))
    };
    let ((u0, u1), (v0, v1)) = (extent(u), extent(v));
    let middle = u * ((u0 + u1) / 2.0) + v * ((v0 + v1) / 2.0);
    let (along, across) = (u1 - u0, v1 - v0);
    let (heading, long, short) =
        if along >= across { (heading, along, across) } else { (heading + FRAC_PI_2, across, along) };
    Rectangle { pose: Pose::new(middle.x, middle.y, crate::geometry::wrap_angle(heading)), long, short }
}

/// Counter-clockwise, by Andrew's monotone chain.
fn convex_hull(points: &[Vec2]) -> Vec<Vec2> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    sorted.dedup();
    let mut hull: Vec<Vec2> = Vec::new();
    for pass in 0..2 {
        let base = hull.len();
        let ordered: Box<dyn Iterator<Item = &Vec2>> =
            if pass == 0 { Box::new(sorted.iter()) } else { Box::new(sorted.iter().rev()) };
        for &point in ordered {
            while hull.len() >= base + 2
                && cross(hull[hull.len() - 1] - hull[hull.len() - 2], point - hull[hull.len() - 1]) <= 0.0
            {
                hull.pop();
            }
            hull.push(point);
        }
        hull.pop();
    }
    hull
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turned_rectangle_is_found_again() {
        let pose = Pose::new(1.0, 2.0, 0.4);
        let grid =
            (0..=20).flat_map(|i| (0..=10).map(move |j| vec2(f64::from(i) * 0.1 - 1.0, f64::from(j) * 0.1 - 0.5)));
        let points: Vec<Vec2> = grid.map(|p| pose.to_world(p)).collect();
        let found = least_rectangle(&points).expect("a rectangle");
        assert!((found.long - 2.0).abs() < 1e-9 && (found.short - 1.0).abs() < 1e-9);
        assert!((found.pose.position() - pose.position()).norm() < 1e-9);
        assert!((found.pose.heading - 0.4).sin().abs() < 1e-9);
    }

    #[test]
    fn points_on_a_line_have_no_rectangle() {
        assert_eq!(least_rectangle(&[vec2(0.0, 0.0), vec2(1.0, 1.0), vec2(2.0, 2.0)]), None);
    }
}

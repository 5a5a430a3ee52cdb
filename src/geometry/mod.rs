//! Plane geometry in metres and radians: points, poses, polygons.
//!
//! World frame: x east, y north, headings counter-clockwise from +x.

mod clearance;
mod polygon;
mod pose;
pub mod ring;

pub use clearance::{Cell, ClearanceGrid};
pub use polygon::Polygon;
pub use pose::{Pose, angle_between, wrap_angle};

/// A point or a vector of the plane, metres.
pub type Vec2 = nalgebra::Vector2<f64>;

/// Shorthand for a [`Vec2`].
pub const fn vec2(x: f64, y: f64) -> Vec2 {
    Vec2::new(x, y)
}

/// The z component of the cross product: positive when `b` lies counter-clockwise of `a`.
pub fn cross(a: Vec2, b: Vec2) -> f64 {
    a.x * b.y - a.y * b.x
}

/// Distance from `point` to the segment `a`–`b`.
pub fn distance_to_segment(point: Vec2, a: Vec2, b: Vec2) -> f64 {
    squared_distance_to_segment(point, a, b).sqrt()
}

fn squared_distance_to_segment(point: Vec2, a: Vec2, b: Vec2) -> f64 {
    let along = b - a;
    let length_squared = along.norm_squared();
    let reached = (point - a).dot(&along);
    // Most points lie beyond an end: no division for them.
    let t = if reached <= 0.0 || length_squared == 0.0 {
        0.0
    } else if reached >= length_squared {
        1.0
    } else {
        reached / length_squared
    };
    (point - (a + along * t)).norm_squared()
}

/// Whether two closed segments share a point.
pub fn segments_touch(a: Vec2, b: Vec2, c: Vec2, d: Vec2) -> bool {
    let (d1, d2) = (cross(b - a, c - a), cross(b - a, d - a));
    let (d3, d4) = (cross(d - c, a - c), cross(d - c, b - c));
    if d1 * d2 < 0.0 && d3 * d4 < 0.0 {
        return true;
    }
    [(c, a, b), (d, a, b), (a, c, d), (b, c, d)].iter().any(|&(p, s, e)| distance_to_segment(p, s, e) < 1e-12)
}

/// Distance between two segments, zero when they touch.
pub fn segment_distance(a: Vec2, b: Vec2, c: Vec2, d: Vec2) -> f64 {
    if segments_touch(a, b, c, d) {
        return 0.0;
    }
    [(a, c, d), (b, c, d), (c, a, b), (d, a, b)]
        .iter()
        .map(|&(p, s, e)| squared_distance_to_segment(p, s, e))
        .fold(f64::INFINITY, f64::min)
        .sqrt()
}

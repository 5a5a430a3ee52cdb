//! The rectangle of a piece on the floor, from its outline.

use std::f64::consts::FRAC_PI_2;

use crate::geometry::{Polygon, Pose, Vec2, vec2};

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

/// The rectangle whose sides lie closest to the outline of what was seen.
///
/// The closeness criterion of Zhang, Xu, Dong & Dolan ("Efficient L-shape
/// fitting", IV 2017): unlike the least area it holds where only two sides of a
/// thing are seen. Nothing for fewer than three places, or places on a line.
pub fn closest_rectangle(outline: &[Vec2]) -> Option<Rectangle> {
    const STEPS: usize = 45;
    const NEAREST_M: f64 = 0.03;
    if Polygon::hull(outline.to_vec()).corners().len() < 3 {
        return None;
    }
    let sample: Vec<Vec2> = outline.iter().copied().step_by(1 + outline.len() / 160).collect();
    let closeness = |heading: f64| {
        let (u, v) = (vec2(heading.cos(), heading.sin()), vec2(-heading.sin(), heading.cos()));
        let ((u0, u1), (v0, v1)) = (extent(&sample, u), extent(&sample, v));
        let near = |p: &Vec2| {
            let (a, b) = (p.dot(&u), p.dot(&v));
            let side = (a - u0).min(u1 - a).min((b - v0).min(v1 - b));
            1.0 / side.max(NEAREST_M)
        };
        sample.iter().map(near).sum::<f64>()
    };
    let best = |headings: &mut dyn Iterator<Item = f64>| {
        headings.map(|h| (closeness(h), h)).max_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.0, |best| best.1)
    };
    let step = FRAC_PI_2 / STEPS as f64;
    let coarse = best(&mut (0..STEPS).map(|i| step * i as f64));
    let fine = best(&mut (-4..=4).map(|i| coarse + step * f64::from(i) / 5.0));
    Some(rectangle_at(outline, fine))
}

/// Lowest and highest along an axis.
fn extent(points: &[Vec2], axis: Vec2) -> (f64, f64) {
    let along = points.iter().map(|p| p.dot(&axis));
    along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), t| (low.min(t), high.max(t)))
}

/// The rectangle round some points with a side along the heading.
pub fn rectangle_at(points: &[Vec2], heading: f64) -> Rectangle {
    let (u, v) = (vec2(heading.cos(), heading.sin()), vec2(-heading.sin(), heading.cos()));
    let ((u0, u1), (v0, v1)) = (extent(points, u), extent(points, v));
    let middle = u * ((u0 + u1) / 2.0) + v * ((v0 + v1) / 2.0);
    let (along, across) = (u1 - u0, v1 - v0);
    let (heading, long, short) =
        if along >= across { (heading, along, across) } else { (heading + FRAC_PI_2, across, along) };
    Rectangle { pose: Pose::new(middle.x, middle.y, crate::geometry::wrap_angle(heading)), long, short }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turned_rectangle_is_found_again() {
        let pose = Pose::new(1.0, 2.0, 0.4);
        let side = |i: i32| f64::from(i) * 0.05;
        let ends = (-20..=20).flat_map(|i| [vec2(side(i), -0.5), vec2(side(i), 0.5)]);
        let flanks = (-10..=10).flat_map(|i| [vec2(-1.0, side(i)), vec2(1.0, side(i))]);
        let points: Vec<Vec2> = ends.chain(flanks).map(|p| pose.to_world(p)).collect();
        let found = closest_rectangle(&points).expect("a rectangle");
        // Nearer than 3 cm to a side counts as on it, so each side may be off by that.
        assert!((found.long - 2.0).abs() < 0.06 && (found.short - 1.0).abs() < 0.06, "{found:?}");
        assert!((found.pose.position() - pose.position()).norm() < 0.03, "{found:?}");
        assert!((found.pose.heading - 0.4).sin().abs() < 0.06, "{found:?}");
    }

    #[test]
    fn points_on_a_line_have_no_rectangle() {
        assert_eq!(closest_rectangle(&[vec2(0.0, 0.0), vec2(1.0, 1.0), vec2(2.0, 2.0)]), None);
    }
}

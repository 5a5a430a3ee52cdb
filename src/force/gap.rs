//! What lies between two shapes: whether they touch, and how far apart they are.

use super::boxes::boxes_meet;
use super::shape::Shape;
use crate::geometry::{Vec2, segment_distance, segments_touch};

type Edge = (Vec2, Vec2);
type Bounds = (Vec2, Vec2);

fn bounds_of((a, b): Edge) -> Bounds {
    (a.inf(&b), a.sup(&b))
}

/// The distance between two boxes, squared; zero when they meet.
fn box_distance_squared((l1, h1): Bounds, (l2, h2): Bounds) -> f64 {
    let (dx, dy) = ((l2.x - h1.x).max(l1.x - h2.x).max(0.0), (l2.y - h1.y).max(l1.y - h2.y).max(0.0));
    dx * dx + dy * dy
}

impl Shape {
    /// Whether the borders or areas of two shapes share a point.
    pub fn touches(&self, other: &Self) -> bool {
        let (own, others) = (self.bounds(), other.bounds());
        boxes_meet(own, others) && self.touches_within(other, own, others)
    }

    fn touches_within(&self, other: &Self, own: Bounds, others: Bounds) -> bool {
        let near: Vec<(Edge, Bounds)> =
            other.edges().map(|e| (e, bounds_of(e))).filter(|(_, bounds)| boxes_meet(*bounds, own)).collect();
        let borders = self.edges().map(|e| (e, bounds_of(e))).filter(|(_, bounds)| boxes_meet(*bounds, others)).any(
            |((a, b), bounds)| {
                near.iter().any(|((c, d), box_)| boxes_meet(bounds, *box_) && segments_touch(a, b, *c, *d))
            },
        );
        let inside = |a: &Self, b: &Self| a.rings().iter().any(|ring| ring.first().is_some_and(|&c| b.contains(c)));
        borders || inside(self, other) || inside(other, self)
    }

    /// The gap between two shapes, zero when they touch.
    pub fn distance(&self, other: &Self) -> f64 {
        if self.touches(other) {
            return 0.0;
        }
        let others: Vec<(Edge, Bounds)> = other.edges().map(|e| (e, bounds_of(e))).collect();
        let whole = other.bounds();
        let mut least = f64::INFINITY;
        for (a, b) in self.edges() {
            let bounds = bounds_of((a, b));
            // Boxes bound the distance from below: most pairs need no closer look.
            if box_distance_squared(bounds, whole) >= least * least {
                continue;
            }
            for ((c, d), box_) in &others {
                if box_distance_squared(bounds, *box_) < least * least {
                    least = least.min(segment_distance(a, b, *c, *d));
                }
            }
        }
        least
    }
}

#[cfg(test)]
mod tests {
    use crate::force::Shape;

    fn square(x: f64, y: f64, size: f64) -> Shape {
        Shape::from_ring(vec![[x, y], [x + size, y], [x + size, y + size], [x, y + size]])
    }

    #[test]
    fn what_lies_inside_touches_and_what_lies_in_a_hole_does_not() {
        let closed = |low: f64, high: f64| vec![[low, low], [high, low], [high, high], [low, high], [low, low]];
        let frame = Shape::from_parts(&[vec![closed(0.0, 5.0), closed(1.0, 4.0)]]).expect("a frame");
        assert!(square(0.0, 0.0, 5.0).touches(&square(2.0, 2.0, 1.0)));
        assert!(!frame.touches(&square(2.0, 2.0, 1.0)));
        assert_eq!(frame.distance(&square(2.0, 2.0, 1.0)), 1.0);
    }

    #[test]
    fn the_distance_is_that_of_the_nearest_points() {
        assert_eq!(square(0.0, 0.0, 1.0).distance(&square(4.0, 5.0, 1.0)), 5.0);
        assert_eq!(square(0.0, 0.0, 1.0).distance(&square(1.0, 0.5, 1.0)), 0.0);
    }
}

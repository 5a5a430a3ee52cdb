//! One direction: every pair of edges that face each other, by a sweep across the direction.
//!
//! Each edge becomes active at its lower normal offset and is paired with the
//! edges of the other object that are active then; the strip two edges share
//! begins where the later one begins. Runs along a line are never sorted.

use crate::geometry::Vec2;

use super::super::Shape;

/// An edge in the frame of a direction, from its lower to its higher normal offset.
#[derive(Clone, Copy, Debug)]
struct Side {
    from: f64,
    to: f64,
    /// Position along the direction at `from`, and its change per unit of offset.
    along: f64,
    slope: f64,
    /// +1 where lines leave the object through it, −1 where they enter.
    sign: f64,
}

/// An object's edges, and their order by lower offset, kept from one direction to the next.
#[derive(Debug)]
pub(super) struct Outline {
    corners: Vec<Vec2>,
    /// The corner after each corner.
    next: Vec<u32>,
    along: Vec<f64>,
    across: Vec<f64>,
    /// Edges by lower offset as of the last direction, with that offset.
    order: Vec<(f64, u32)>,
    sides: Vec<Side>,
}

/// The range an object covers along and across a direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    pub(super) along: (f64, f64),
    pub(super) across: (f64, f64),
}

impl Outline {
    /// The outline of `shape` seen from `origin`: coordinates of maps are large, and differences keep the digits.
    pub(super) fn new(shape: &Shape, origin: Vec2) -> Self {
        let count = shape.rings().iter().map(Vec::len).sum();
        let (mut corners, mut next) = (Vec::with_capacity(count), Vec::with_capacity(count));
        for ring in shape.rings() {
            let start = corners.len();
            corners.extend(ring.iter().map(|corner| corner - origin));
            next.extend((1..ring.len()).map(|i| (start + i) as u32));
            next.push(start as u32);
        }
        let order = (0..count as u32).map(|edge| (0.0, edge)).collect();
        let (along, across) = (vec![0.0; count], vec![0.0; count]);
        Self { corners, next, along, across, order, sides: Vec::with_capacity(count) }
    }

    /// Turns the outline into a direction.
    pub(super) fn turn(&mut self, sin: f64, cos: f64) -> Extent {
        let mut extent = Extent { along: (f64::MAX, f64::MIN), across: (f64::MAX, f64::MIN) };
        for ((corner, along), across) in self.corners.iter().zip(&mut self.along).zip(&mut self.across) {
            *along = corner.x * cos + corner.y * sin;
            *across = corner.y * cos - corner.x * sin;
            extent.along = (extent.along.0.min(*along), extent.along.1.max(*along));
            extent.across = (extent.across.0.min(*across), extent.across.1.max(*across));
        }
        extent
    }

    /// Lists the sides that reach into the given range of offsets, by their lower offset.
    fn list_sides(&mut self, (low, high): (f64, f64)) {
        for (key, edge) in &mut self.order {
            let (a, b) = (*edge as usize, self.next[*edge as usize] as usize);
            *key = self.across[a].min(self.across[b]);
        }
        sort_nearly_sorted(&mut self.order);
        self.sides.clear();
        for &(key, edge) in &self.order {
            if key >= high {
                break;
            }
            let (a, b) = (edge as usize, self.next[edge as usize] as usize);
            // The interior lies left of a→b: where offsets rise along the edge, the line leaves the object.
            let rising = self.across[b] > self.across[a];
            let (start, end) = if rising { (a, b) } else { (b, a) };
            let (from, to) = (self.across[start], self.across[end]);
            if to > low && to > from {
                let slope = (self.along[end] - self.along[start]) / (to - from);
                let sign = if rising { 1.0 } else { -1.0 };
                self.sides.push(Side { from, to, along: self.along[start], slope, sign });
            }
        }
    }
}

/// Insertion sort, which is linear for what has moved little since the last direction; gives up when it has moved much.
fn sort_nearly_sorted(order: &mut [(f64, u32)]) {
    let mut moves_left = 16 * order.len();
    for i in 1..order.len() {
        let entry = order[i];
        let mut at = i;
        while at > 0 && order[at - 1].0 > entry.0 {
            order[at] = order[at - 1];
            at -= 1;
        }
        order[at] = entry;
        moves_left = moves_left.saturating_sub(i - at);
        if moves_left == 0 {
            order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            return;
        }
    }
}

/// The sides that are active during a sweep, kept to be used again.
#[derive(Debug, Default)]
pub(super) struct Sweep {
    of_a: Vec<Side>,
    of_b: Vec<Side>,
}

impl Sweep {
    /// Yields every pair as (gap where the strip begins, gap where it ends, weight); the gap is A's place less B's.
    pub(super) fn run(
        &mut self,
        a: &mut Outline,
        b: &mut Outline,
        shared: (f64, f64),
        mut pair: impl FnMut(f64, f64, f64),
    ) {
        a.list_sides(shared);
        b.list_sides(shared);
        self.of_a.clear();
        self.of_b.clear();
        let (mut rest_a, mut rest_b) = (a.sides.as_slice(), b.sides.as_slice());
        while let (Some(side_a), Some(side_b)) = (rest_a.first(), rest_b.first()) {
            if side_a.from <= side_b.from {
                meet(side_a, &mut self.of_b, |own, other, last_own, last_other, w| {
                    pair(own - other, last_own - last_other, w)
                });
                self.of_a.push(*side_a);
                rest_a = &rest_a[1..];
            } else {
                meet(side_b, &mut self.of_a, |own, other, last_own, last_other, w| {
                    pair(other - own, last_other - last_own, w)
                });
                self.of_b.push(*side_b);
                rest_b = &rest_b[1..];
            }
        }
        for side_a in rest_a {
            meet(side_a, &mut self.of_b, |own, other, last_own, last_other, w| {
                pair(own - other, last_own - last_other, w)
            });
        }
        for side_b in rest_b {
            meet(side_b, &mut self.of_a, |own, other, last_own, last_other, w| {
                pair(other - own, last_other - last_own, w)
            });
        }
    }
}

/// Pairs a side that begins with the active ones of the other object; drops those that have ended.
#[inline(always)]
fn meet(side: &Side, active: &mut Vec<Side>, mut pair: impl FnMut(f64, f64, f64, f64, f64)) {
    let mut i = 0;
    while i < active.len() {
        let other = active[i];
        if other.to <= side.from {
            active.swap_remove(i);
            continue;
        }
        i += 1;
        let width = side.to.min(other.to) - side.from;
        let along = other.along + other.slope * (side.from - other.from);
        pair(
            side.along,
            along,
            side.along + side.slope * width,
            along + other.slope * width,
            side.sign * other.sign * width,
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_side_by_side_face_each_other_with_four_pairs_of_edges() {
        let square = |x: f64| Shape::from_ring(vec![[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]]);
        let origin = Vec2::zeros();
        let (mut a, mut b) = (Outline::new(&square(3.0), origin), Outline::new(&square(0.0), origin));
        a.turn(0.0, 1.0);
        b.turn(0.0, 1.0);
        let mut found = Vec::new();
        Sweep::default().run(&mut a, &mut b, (0.0, 1.0), |first, last, weight| found.push((first, last, weight)));
        found.sort_by(|x, y| x.0.total_cmp(&y.0));
        assert_eq!(found, [(2.0, 2.0, -1.0), (3.0, 3.0, 1.0), (3.0, 3.0, 1.0), (4.0, 4.0, -1.0)]);
    }

    #[test]
    fn what_has_moved_much_is_sorted_too() {
        let mut order: Vec<(f64, u32)> = (0..500).map(|i| (f64::from((i * 7919) % 500), i)).collect();
        sort_nearly_sorted(&mut order);
        assert!(order.windows(2).all(|w| w[0].0 <= w[1].0));
    }
}

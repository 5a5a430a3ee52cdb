//! Whether rings make an areal object, by the rules of OGC Simple Features (OGC 06-103r4, 6.1.11 and 6.1.14).
//!
//! A ring meets itself nowhere; a hole lies within its outer ring and beside
//! the other holes; parts lie beside each other. Two rings may share points,
//! but no line, and not so that they cut the interior in two. Which side of a
//! line a point lies on is computed exactly (Shewchuk 1997, by `robust`).

use std::collections::{BTreeMap, BTreeSet};

use super::ShapeError;
use super::boxes::boxes_meet;
use crate::geometry::Vec2;

/// A ring: its corners, the part it belongs to, and whether it is a hole of it.
pub(super) struct Ring {
    pub corners: Vec<Vec2>,
    pub part: usize,
    pub is_hole: bool,
}

impl Ring {
    fn edge(&self, i: usize) -> (Vec2, Vec2) {
        (self.corners[i], self.corners[(i + 1) % self.corners.len()])
    }

    fn bounds(&self) -> (Vec2, Vec2) {
        let start = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY));
        self.corners.iter().fold(start, |(low, high), c| (low.inf(c), high.sup(c)))
    }

    /// Whether a point that is not on the ring lies within it.
    fn surrounds(&self, point: Vec2) -> bool {
        let crossed = |&i: &usize| {
            let (a, b) = self.edge(i);
            let (low, high) = if a.y < b.y { (a, b) } else { (b, a) };
            low.y <= point.y && point.y < high.y && side(low, high, point) > 0.0
        };
        (0..self.corners.len()).filter(crossed).count() % 2 == 1
    }
}

/// How two edges meet.
enum Meeting {
    Apart,
    /// In one point, which is an end of at least one of them.
    Touch(Vec2),
    /// In a point within both.
    Cross,
    /// Along a line.
    Along,
}

/// Where an edge of one ring is touched by another ring: by ring, edge and other ring.
type Touches = BTreeMap<(usize, usize, usize), Vec<Vec2>>;

/// Checks all rings of a shape.
pub(super) fn check(rings: &[Ring]) -> Result<(), ShapeError> {
    let touches = meetings(rings)?;
    let bounds: Vec<(Vec2, Vec2)> = rings.iter().map(Ring::bounds).collect();
    let mut samples: BTreeMap<(usize, usize), Vec<Vec2>> = BTreeMap::new();
    for (&(ring, edge, other), points) in &touches {
        samples.entry((ring, other)).or_default().extend(between(rings[ring].edge(edge), points));
    }
    for a in 0..rings.len() {
        for b in (0..rings.len()).filter(|&b| b != a && boxes_meet(bounds[a], bounds[b])) {
            let points = samples.get(&(a, b)).cloned().unwrap_or_else(|| vec![rings[a].corners[0]]);
            check_pair(rings, a, b, &points)?;
        }
        // A hole whose box does not even meet its outer ring's.
        let outer = |b: &usize| rings[*b].part == rings[a].part && !rings[*b].is_hole;
        if let Some(outer) = (0..a).find(outer).filter(|&outer| !boxes_meet(bounds[a], bounds[outer])) {
            return Err(ShapeError::HoleOutside(a + 1, outer + 1));
        }
    }
    check_connected(rings, &touches)
}

/// Checks where ring `a`, of which `points` are some, lies to ring `b`.
fn check_pair(rings: &[Ring], a: usize, b: usize, points: &[Vec2]) -> Result<(), ShapeError> {
    let (own, other) = (&rings[a], &rings[b]);
    if own.part == other.part {
        let within = |point: &Vec2| other.surrounds(*point);
        return match (own.is_hole, other.is_hole) {
            (true, false) if !points.iter().all(within) => Err(ShapeError::HoleOutside(a + 1, b + 1)),
            (true, true) if points.iter().any(within) => Err(ShapeError::HolesOverlap(a + 1, b + 1)),
            _ => Ok(()),
        };
    }
    if own.is_hole || other.is_hole {
        return Ok(());
    }
    let holes = || rings.iter().filter(|ring| ring.is_hole && ring.part == other.part);
    let covered = |point: &Vec2| other.surrounds(*point) && !holes().any(|hole| hole.surrounds(*point));
    if points.iter().any(covered) { Err(ShapeError::PartsOverlap(a + 1, b + 1)) } else { Ok(()) }
}

/// Middles of the pieces into which points cut an edge.
fn between((a, b): (Vec2, Vec2), points: &[Vec2]) -> Vec<Vec2> {
    let mut cuts: Vec<Vec2> = points.iter().copied().chain([a, b]).collect();
    cuts.sort_by(|p, q| (p - a).norm_squared().total_cmp(&(q - a).norm_squared()));
    cuts.dedup();
    cuts.windows(2).map(|pair| (pair[0] + pair[1]) / 2.0).collect()
}

/// The touches of all rings; an error where a ring meets itself or two rings share more than points.
///
/// Edges are taken along one axis and compared with those whose range is still open, so that long coastlines are
/// checked in little more than the time it takes to sort them.
fn meetings(rings: &[Ring]) -> Result<Touches, ShapeError> {
    let edges: Vec<(usize, usize)> =
        rings.iter().enumerate().flat_map(|(ring, r)| (0..r.corners.len()).map(move |edge| (ring, edge))).collect();
    let ends = |&(ring, edge): &(usize, usize)| rings[ring].edge(edge);
    let extent = edges.iter().map(ends).fold(Vec2::zeros(), |sum, (a, b)| sum + (b - a).abs());
    let axis = usize::from(extent.y < extent.x);
    let low = |e: &(usize, usize)| ends(e).0[axis].min(ends(e).1[axis]);
    let high = |e: &(usize, usize)| ends(e).0[axis].max(ends(e).1[axis]);
    let mut order = edges.clone();
    order.sort_by(|e, f| low(e).total_cmp(&low(f)));
    let mut open: Vec<(usize, usize)> = Vec::new();
    let mut touches = Touches::new();
    for edge in order {
        let from = low(&edge);
        open.retain(|other| high(other) >= from);
        for other in &open {
            meet(rings, edge.min(*other), edge.max(*other), &mut touches)?;
        }
        open.push(edge);
    }
    Ok(touches)
}

fn meet(rings: &[Ring], e: (usize, usize), f: (usize, usize), touches: &mut Touches) -> Result<(), ShapeError> {
    let (p, q) = (rings[e.0].edge(e.1), rings[f.0].edge(f.1));
    if !boxes_meet((p.0.inf(&p.1), p.0.sup(&p.1)), (q.0.inf(&q.1), q.0.sup(&q.1))) {
        return Ok(());
    }
    let corners = rings[e.0].corners.len();
    let same = e.0 == f.0;
    let neighbours = same && (e.1 + 1 == f.1 || (e.1 == 0 && f.1 + 1 == corners));
    match meeting(p, q) {
        Meeting::Apart => Ok(()),
        Meeting::Touch(_) if neighbours => Ok(()),
        Meeting::Touch(at) if same => Err(ShapeError::SelfTouching(e.0 + 1, at.x, at.y)),
        Meeting::Cross | Meeting::Along if same => Err(ShapeError::SelfCrossing(e.0 + 1, e.1 + 1, f.1 + 1)),
        Meeting::Cross | Meeting::Along => Err(overlap(rings, e.0, f.0)),
        Meeting::Touch(at) => {
            touches.entry((e.0, e.1, f.0)).or_default().push(at);
            touches.entry((f.0, f.1, e.0)).or_default().push(at);
            Ok(())
        }
    }
}

/// What it is when two rings share more than points; `a` comes before `b`.
fn overlap(rings: &[Ring], a: usize, b: usize) -> ShapeError {
    if rings[a].part != rings[b].part {
        ShapeError::PartsOverlap(a + 1, b + 1)
    } else if rings[a].is_hole {
        ShapeError::HolesOverlap(a + 1, b + 1)
    } else {
        ShapeError::HoleOutside(b + 1, a + 1)
    }
}

fn meeting((a, b): (Vec2, Vec2), (c, d): (Vec2, Vec2)) -> Meeting {
    let (to_c, to_d) = (side(a, b, c), side(a, b, d));
    let (to_a, to_b) = (side(c, d, a), side(c, d, b));
    if to_c == 0.0 && to_d == 0.0 {
        return along((a, b), (c, d));
    }
    if to_c.signum() * to_d.signum() < 0.0 && to_a.signum() * to_b.signum() < 0.0 && to_a != 0.0 && to_b != 0.0 {
        return if to_c != 0.0 && to_d != 0.0 {
            Meeting::Cross
        } else {
            Meeting::Touch(if to_c == 0.0 { c } else { d })
        };
    }
    let within = |low: Vec2, high: Vec2, p: Vec2| {
        let (low, high) = (low.inf(&high), low.sup(&high));
        (low.x..=high.x).contains(&p.x) && (low.y..=high.y).contains(&p.y)
    };
    let ends = [(to_c, c, a, b), (to_d, d, a, b), (to_a, a, c, d), (to_b, b, c, d)];
    let touch = ends.into_iter().find(|&(to, point, low, high)| to == 0.0 && within(low, high, point));
    touch.map_or(Meeting::Apart, |(_, point, ..)| Meeting::Touch(point))
}

/// How two edges on one line meet.
fn along((a, b): (Vec2, Vec2), (c, d): (Vec2, Vec2)) -> Meeting {
    let axis = (b - a).abs().imax();
    let (low, high) = if a[axis] < b[axis] { (a, b) } else { (b, a) };
    let (first, last) = if c[axis] < d[axis] { (c, d) } else { (d, c) };
    if first[axis] < high[axis] && low[axis] < last[axis] {
        Meeting::Along
    } else if first == high || last == low {
        Meeting::Touch(if first == high { high } else { low })
    } else {
        Meeting::Apart
    }
}

/// Above 0 when `point` lies left of the way from `a` to `b`, 0 when on its line.
fn side(a: Vec2, b: Vec2, point: Vec2) -> f64 {
    let coord = |p: Vec2| robust::Coord { x: p.x, y: p.y };
    robust::orient2d(coord(a), coord(b), coord(point))
}

/// A part and the bits of a point.
type Place = (usize, u64, u64);

/// Rings that touch in a circle – one touching another twice is the shortest – cut the interior in two.
fn check_connected(rings: &[Ring], touches: &Touches) -> Result<(), ShapeError> {
    // A ring and a place of its part, once each; adding zero makes −0 into 0.
    let mut links: BTreeSet<(usize, Place)> = BTreeSet::new();
    for (&(ring, _, other), points) in touches {
        let part = rings[ring].part;
        let own = points.iter().filter(|_| part == rings[other].part);
        links.extend(own.map(|at| (ring, (part, (at.x + 0.0).to_bits(), (at.y + 0.0).to_bits()))));
    }
    let mut nodes: BTreeMap<Place, usize> = BTreeMap::new();
    let mut parent: Vec<usize> = (0..rings.len()).collect();
    for (ring, place) in links {
        let node = *nodes.entry(place).or_insert(parent.len());
        if node == parent.len() {
            parent.push(node);
        }
        let (a, b) = (root(&mut parent, ring), root(&mut parent, node));
        if a == b {
            return Err(ShapeError::Disconnected(ring + 1));
        }
        parent[a] = b;
    }
    Ok(())
}

fn root(parent: &mut [usize], mut node: usize) -> usize {
    while parent[node] != node {
        parent[node] = parent[parent[node]];
        node = parent[node];
    }
    node
}

#[cfg(test)]
mod tests {
    use super::super::{Shape, ShapeError};

    type Corners<'a> = &'a [[f64; 2]];

    fn of(parts: &[&[Corners]]) -> Result<Shape, ShapeError> {
        let closed = |ring: &Corners| ring.iter().chain(&ring[..1]).copied().collect::<Vec<_>>();
        let parts: Vec<Vec<Vec<[f64; 2]>>> = parts.iter().map(|rings| rings.iter().map(closed).collect()).collect();
        Shape::from_parts(&parts)
    }

    fn square(x: f64, y: f64, side: f64) -> [[f64; 2]; 4] {
        [[x, y], [x + side, y], [x + side, y + side], [x, y + side]]
    }

    #[test]
    fn parts_that_overlap_lie_within_each_other_or_are_the_same_are_refused() {
        let large = square(0.0, 0.0, 3.0);
        assert_eq!(of(&[&[&large], &[&square(2.0, 1.0, 3.0)]]), Err(ShapeError::PartsOverlap(1, 2)));
        assert_eq!(of(&[&[&large], &[&square(1.0, 1.0, 1.0)]]), Err(ShapeError::PartsOverlap(2, 1)));
        assert_eq!(of(&[&[&large], &[&large]]), Err(ShapeError::PartsOverlap(1, 2)));
    }

    #[test]
    fn parts_may_touch_in_a_point_but_not_share_a_border() {
        assert!(of(&[&[&square(0.0, 0.0, 1.0)], &[&square(1.0, 1.0, 1.0)]]).is_ok());
        assert_eq!(of(&[&[&square(0.0, 0.0, 1.0)], &[&square(1.0, 0.0, 1.0)]]), Err(ShapeError::PartsOverlap(1, 2)));
    }

    #[test]
    fn a_part_may_lie_in_the_hole_of_another() {
        let ring: [Corners; 2] = [&square(0.0, 0.0, 9.0), &square(1.0, 1.0, 7.0)];
        assert!(of(&[&ring, &[&square(3.0, 3.0, 2.0)]]).is_ok());
        assert!(of(&[&[&square(3.0, 3.0, 2.0)], &ring]).is_ok());
    }

    #[test]
    fn a_hole_lies_within_its_ring() {
        let outer = square(0.0, 0.0, 3.0);
        assert!(of(&[&[&outer, &square(1.0, 1.0, 1.0)]]).is_ok());
        assert_eq!(of(&[&[&outer, &square(2.0, 0.5, 2.0)]]), Err(ShapeError::HoleOutside(2, 1)));
        assert_eq!(of(&[&[&outer, &square(7.0, 7.0, 1.0)]]), Err(ShapeError::HoleOutside(2, 1)));
        assert_eq!(of(&[&[&outer, &square(-1.0, -1.0, 9.0)]]), Err(ShapeError::HoleOutside(2, 1)));
        assert_eq!(of(&[&[&outer, &outer]]), Err(ShapeError::HoleOutside(2, 1)));
        // It reaches beyond the ring by passing through points of it only.
        let through = [[3.0, 1.5], [4.0, 1.0], [4.0, 2.0]];
        assert_eq!(of(&[&[&outer, &through]]), Err(ShapeError::HoleOutside(2, 1)));
    }

    #[test]
    fn holes_lie_beside_each_other() {
        let outer = square(0.0, 0.0, 9.0);
        assert_eq!(
            of(&[&[&outer, &square(1.0, 1.0, 3.0), &square(2.0, 2.0, 3.0)]]),
            Err(ShapeError::HolesOverlap(2, 3))
        );
        assert_eq!(
            of(&[&[&outer, &square(1.0, 1.0, 5.0), &square(2.0, 2.0, 1.0)]]),
            Err(ShapeError::HolesOverlap(3, 2))
        );
    }

    #[test]
    fn a_hole_may_touch_its_ring_once_but_not_cut_the_object_in_two() {
        let outer = square(0.0, 0.0, 4.0);
        assert!(of(&[&[&outer, &[[0.0, 2.0], [2.0, 1.0], [2.0, 3.0]]]]).is_ok());
        let across = [[0.0, 2.0], [2.0, 1.0], [4.0, 2.0], [2.0, 3.0]];
        assert!(matches!(of(&[&[&outer, &across]]), Err(ShapeError::Disconnected(_))));
    }

    #[test]
    fn a_ring_that_meets_itself_in_a_corner_or_runs_back_is_refused() {
        let bow = [[0.0, 0.0], [1.0, 1.0], [3.0, 3.0], [3.0, -1.0], [1.0, 1.0], [0.0, 2.0]];
        assert_eq!(of(&[&[&bow]]), Err(ShapeError::SelfTouching(1, 1.0, 1.0)));
        let spike = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [2.0, 1.0], [0.0, 1.0]];
        let found = of(&[&[&spike]]);
        assert!(matches!(found, Err(ShapeError::SelfCrossing(1, ..) | ShapeError::SelfTouching(1, ..))), "{found:?}");
    }

    #[test]
    fn many_long_edges_side_by_side_are_checked_in_little_time() {
        // A comb of 40 000 teeth, each as long as the whole is wide.
        let teeth = (0..40_000).flat_map(|i| {
            let y = 2.0 * f64::from(i);
            [[1.0, y], [9e4, y], [9e4, y + 1.0], [1.0, y + 1.0]]
        });
        let comb: Vec<[f64; 2]> = teeth.chain([[0.0, 79_999.0], [0.0, 0.0]]).collect();
        assert!(of(&[&[&comb]]).is_ok());
    }
}

//! Triangles in a tree of boxes, so that a ray looks at few of them.

use super::Point;

/// Triangles in a leaf at most.
const LEAF: usize = 4;

/// A binary tree of bounding boxes over triangles.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Bvh {
    triangles: Vec<[Point; 3]>,
    nodes: Vec<Node>,
}

#[derive(Clone, Debug, PartialEq)]
struct Node {
    low: Point,
    high: Point,
    content: Content,
}

#[derive(Clone, Debug, PartialEq)]
enum Content {
    /// First triangle and one past the last.
    Leaf(usize, usize),
    /// The second child; the first is the next node.
    Fork(usize),
}

impl Bvh {
    pub fn new(mut triangles: Vec<[Point; 3]>) -> Self {
        let mut nodes = Vec::new();
        let count = triangles.len();
        build(&mut triangles, 0, count, &mut nodes);
        Self { triangles, nodes }
    }

    pub fn triangles(&self) -> &[[Point; 3]] {
        &self.triangles
    }

    /// The nearest triangle along a ray: its distance in units of the direction, and its normal toward the ray.
    pub fn hit(&self, origin: Point, direction: Point) -> Option<(f64, Point)> {
        let inverse = direction.map(|d| 1.0 / d);
        let mut best: Option<(f64, Point)> = None;
        let mut open = vec![0];
        while let Some(at) = open.pop() {
            let node = &self.nodes[at];
            let limit = best.map_or(f64::INFINITY, |(t, _)| t);
            if !enters(node, origin, inverse, limit) {
                continue;
            }
            match node.content {
                Content::Fork(second) => open.extend([second, at + 1]),
                Content::Leaf(first, end) => {
                    for triangle in &self.triangles[first..end] {
                        if let Some(hit) = meet(triangle, origin, direction)
                            && best.is_none_or(|(t, _)| hit.0 < t)
                        {
                            best = Some(hit);
                        }
                    }
                }
            }
        }
        best
    }
}

/// Splits at the median along the longest axis.
fn build(triangles: &mut [[Point; 3]], first: usize, end: usize, nodes: &mut Vec<Node>) {
    let none = (Point::repeat(f64::INFINITY), Point::repeat(f64::NEG_INFINITY));
    let own = &mut triangles[first..end];
    let (low, high) = own.iter().flatten().fold(none, |(low, high), c| (low.inf(c), high.sup(c)));
    let at = nodes.len();
    nodes.push(Node { low, high, content: Content::Leaf(first, end) });
    if own.len() <= LEAF {
        return;
    }
    let axis = (high - low).imax();
    let middle = |t: &[Point; 3]| t[0][axis] + t[1][axis] + t[2][axis];
    let half = own.len() / 2;
    own.select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)));
    build(triangles, first, first + half, nodes);
    nodes[at].content = Content::Fork(nodes.len());
    build(triangles, first + half, end, nodes);
}

/// Whether a ray passes a node's box before `limit` (slabs).
fn enters(node: &Node, origin: Point, inverse: Point, limit: f64) -> bool {
    let (mut enter, mut leave) = (0.0_f64, limit);
    for axis in 0..3 {
        let a = (node.low[axis] - origin[axis]) * inverse[axis];
        let b = (node.high[axis] - origin[axis]) * inverse[axis];
        enter = enter.max(a.min(b));
        leave = leave.min(a.max(b));
    }
    enter <= leave
}

/// Ray and triangle (Möller & Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997).
fn meet(&[a, b, c]: &[Point; 3], origin: Point, direction: Point) -> Option<(f64, Point)> {
    let (along, across) = (b - a, c - a);
    let p = direction.cross(&across);
    let determinant = along.dot(&p);
    if determinant.abs() < 1e-15 {
        return None;
    }
    let from = origin - a;
    let u = from.dot(&p) / determinant;
    let q = from.cross(&along);
    let v = direction.dot(&q) / determinant;
    let t = across.dot(&q) / determinant;
    if u < 0.0 || v < 0.0 || u + v > 1.0 || t <= 1e-9 {
        return None;
    }
    let normal = along.cross(&across);
    Some((t, if normal.dot(&direction) > 0.0 { -normal } else { normal }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tree_finds_what_looking_at_every_triangle_finds() {
        // A hilly sheet of 800 triangles, seen from above along slanting rays.
        let height = |i: usize, j: usize| ((i * 7 + j * 3) % 5) as f64 * 0.1;
        let point = |i: usize, j: usize| Point::new(i as f64, j as f64, height(i, j));
        let triangles: Vec<[Point; 3]> = (0..20)
            .flat_map(|i| (0..20).map(move |j| (i, j)))
            .flat_map(|(i, j)| {
                [
                    [point(i, j), point(i + 1, j), point(i, j + 1)],
                    [point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)],
                ]
            })
            .collect();
        let bvh = Bvh::new(triangles.clone());
        for k in 0..50 {
            let origin = Point::new(0.37 * k as f64, 19.0 - 0.31 * k as f64, 5.0);
            let direction = Point::new(0.11, -0.07, -1.0);
            let all = triangles.iter().filter_map(|t| meet(t, origin, direction)).map(|(t, _)| t);
            let nearest = all.fold(None, |least: Option<f64>, t| Some(least.map_or(t, |l| l.min(t))));
            assert_eq!(bvh.hit(origin, direction).map(|(t, _)| t), nearest, "ray {k}");
        }
    }
}

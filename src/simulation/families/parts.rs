//! Parts of furniture, in the piece's own frame: front along +x, middle at the origin.

use crate::geometry::{Vec2, vec2};
use crate::simulation::camera::{Finish, Frustum};

/// From–to, metres.
pub type Span = (f64, f64);

/// A box.
pub fn block(x: Span, y: Span, z: Span, finish: Finish) -> Frustum {
    leaning(x, x, y, z, finish)
}

/// A box whose upper end is moved along x: a backrest.
pub fn leaning(below: Span, above: Span, y: Span, z: Span, finish: Finish) -> Frustum {
    let outline = |x: Span| vec![vec2(x.0, y.0), vec2(x.1, y.0), vec2(x.1, y.1), vec2(x.0, y.1)];
    Frustum { bottom: outline(below), top: outline(above), low: z.0, high: z.1, finish }
}

/// A box whose upper outline is smaller by `inset` on every side: a cushion.
pub fn cushion(x: Span, y: Span, z: Span, inset: f64, finish: Finish) -> Vec<Frustum> {
    let half = z.0 + 0.6 * (z.1 - z.0);
    let mut upper = block(x, y, (half, z.1), finish);
    upper.top = block((x.0 + inset, x.1 - inset), (y.0 + inset, y.1 - inset), (half, z.1), finish).top;
    vec![block(x, y, (z.0, half), finish), upper]
}

/// A straight bar, `thick` metres square, between two points at two heights: a leg, splayed or not.
pub fn bar(foot: Vec2, head: Vec2, thick: Span, z: Span, finish: Finish) -> Frustum {
    let square = |at: Vec2, side: f64| {
        let h = side / 2.0;
        [vec2(-h, -h), vec2(h, -h), vec2(h, h), vec2(-h, h)].map(|corner| at + corner).to_vec()
    };
    Frustum { bottom: square(foot, thick.0), top: square(head, thick.1), low: z.0, high: z.1, finish }
}

/// A round body about `at`; the diameters along x and y below and above: a column, a shade, a round top.
pub fn round(at: Vec2, below: (f64, f64), above: (f64, f64), z: Span, finish: Finish) -> Frustum {
    sided(16, at, below, above, z, finish)
}

/// The same with so many sides.
pub fn sided(sides: usize, at: Vec2, below: (f64, f64), above: (f64, f64), z: Span, finish: Finish) -> Frustum {
    let ring = |(length, width): (f64, f64)| {
        (0..sides)
            .map(|i| {
                let angle = std::f64::consts::TAU * i as f64 / sides as f64;
                at + vec2(length / 2.0 * angle.cos(), width / 2.0 * angle.sin())
            })
            .collect()
    };
    Frustum { bottom: ring(below), top: ring(above), low: z.0, high: z.1, finish }
}

/// Four legs under a rectangle, `inset` from its edges below, splayed outward by `splay`.
pub fn legs(x: Span, y: Span, height: f64, thick: Span, splay: f64, finish: Finish) -> Vec<Frustum> {
    let half = thick.1 / 2.0;
    [(x.0 + half, y.0 + half), (x.1 - half, y.0 + half), (x.1 - half, y.1 - half), (x.0 + half, y.1 - half)]
        .map(|(a, b)| {
            let middle = vec2((x.0 + x.1) / 2.0, (y.0 + y.1) / 2.0);
            let out = vec2((a - middle.x).signum(), (b - middle.y).signum()) * splay;
            bar(vec2(a, b), vec2(a, b) - out, thick, (0.0, height), finish)
        })
        .to_vec()
}

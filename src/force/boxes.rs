//! Boxes round shapes: a first look, before edges are compared.

use crate::geometry::Vec2;

/// Whether two boxes, each its lowest and highest corner, share a point.
pub(super) fn boxes_meet((l1, h1): (Vec2, Vec2), (l2, h2): (Vec2, Vec2)) -> bool {
    l1.x <= h2.x && l2.x <= h1.x && l1.y <= h2.y && l2.y <= h1.y
}

//! What the renderer draws: plane convex faces, each with a finish and the item it belongs to.

use crate::catalogue::Color;
use crate::geometry::{Polygon, Pose, Vec2, vec2};
use crate::simulation::solid::Solid;

/// A point or a direction in space: x east, y north, z up, metres.
pub type Point = nalgebra::Vector3<f64>;

/// The pattern a surface bears.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Texture {
    /// One colour.
    #[default]
    Plain,
    /// Fine mottling.
    Cloth,
    /// Streaks along the longer way.
    Wood,
    /// Boards with joints, for floors.
    Boards,
    /// Square tiles with joints, for floors.
    Tiles,
}

/// What a surface looks like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finish {
    /// Its colour in white light.
    pub color: Color,
    /// Its pattern.
    pub texture: Texture,
}

impl Finish {
    /// A finish from colour and pattern.
    pub const fn new(color: Color, texture: Texture) -> Self {
        Self { color, texture }
    }
}

/// A convex body between two level outlines of as many corners: a prism, or one that tapers or leans.
#[derive(Clone, Debug)]
pub struct Frustum {
    /// Lower outline, counter-clockwise, metres.
    pub bottom: Vec<Vec2>,
    /// Height of the lower outline.
    pub low: f64,
    /// Upper outline, corner by corner above the lower.
    pub top: Vec<Vec2>,
    /// Height of the upper outline.
    pub high: f64,
    /// Its surface.
    pub finish: Finish,
}

impl Frustum {
    /// The same body, carried from a local frame to `pose` and `lift` metres up.
    pub fn placed(&self, pose: Pose, lift: f64) -> Self {
        let carry = |outline: &[Vec2]| outline.iter().map(|&corner| pose.to_world(corner)).collect();
        Self {
            bottom: carry(&self.bottom),
            top: carry(&self.top),
            low: self.low + lift,
            high: self.high + lift,
            ..*self
        }
    }
}

/// A plane convex face.
#[derive(Clone, Debug)]
pub(super) struct Face {
    /// Counter-clockwise seen from outside.
    pub corners: Vec<Point>,
    /// Outward, a unit vector.
    pub normal: Point,
    pub finish: Finish,
    /// Item id + 1; 0 for floor and walls.
    pub id: u16,
    /// Whether it is also seen from behind.
    pub two_sided: bool,
}

/// All faces of a scene.
#[derive(Clone, Debug, Default)]
pub struct Faces {
    pub(super) faces: Vec<Face>,
}

impl Faces {
    /// Adds a frustum that belongs to the item `id` − 1.
    pub fn add_frustum(&mut self, frustum: &Frustum, id: u16) {
        let ring = |outline: &[Vec2], z: f64| outline.iter().map(|c| Point::new(c.x, c.y, z)).collect::<Vec<_>>();
        let (bottom, top) = (ring(&frustum.bottom, frustum.low), ring(&frustum.top, frustum.high));
        for i in 0..bottom.len() {
            let j = (i + 1) % bottom.len();
            self.add_face(vec![bottom[i], bottom[j], top[j], top[i]], frustum.finish, id, false);
        }
        if frustum.low > 1e-6 {
            self.add_face(bottom.into_iter().rev().collect(), frustum.finish, id, false);
        }
        self.add_face(top, frustum.finish, id, false);
    }

    /// Adds a solid that belongs to the item `id` − 1.
    pub fn add_solid(&mut self, solid: &Solid, texture: Texture, id: u16) {
        let finish = Finish::new(solid.color(), texture);
        if let Some(triangles) = solid.triangles() {
            triangles.into_iter().for_each(|corners| self.add_triangle(corners, finish, id));
            return;
        }
        let outline = solid.footprint().corners().to_vec();
        let frustum = Frustum { top: outline.clone(), bottom: outline, low: solid.bottom(), high: solid.top(), finish };
        self.add_frustum(&frustum, id);
    }

    /// Adds a triangle of a mesh, seen from both sides.
    pub fn add_triangle(&mut self, corners: [Point; 3], finish: Finish, id: u16) {
        self.add_face(corners.to_vec(), finish, id, true);
    }

    /// Adds a wall of no thickness on the segment `a`–`b`.
    pub fn add_wall(&mut self, a: Vec2, b: Vec2, height: f64, finish: Finish) {
        let at = |p: Vec2, z: f64| Point::new(p.x, p.y, z);
        self.add_face(vec![at(a, 0.0), at(b, 0.0), at(b, height), at(a, height)], finish, 0, true);
    }

    /// Adds a level plane over a rectangle: the floor, the ceiling.
    pub fn add_level(&mut self, low: Vec2, high: Vec2, height: f64, finish: Finish) {
        let corners = [low, vec2(high.x, low.y), high, vec2(low.x, high.y)];
        self.add_face(corners.map(|c| Point::new(c.x, c.y, height)).to_vec(), finish, 0, true);
    }

    fn add_face(&mut self, corners: Vec<Point>, finish: Finish, id: u16, two_sided: bool) {
        // The longest two diagonals' product: also right where corners coincide, as in a cone's tip.
        let mut normal = Point::zeros();
        for i in 1..corners.len() - 1 {
            normal += (corners[i] - corners[0]).cross(&(corners[i + 1] - corners[0]));
        }
        if normal.norm() > 1e-12 {
            self.faces.push(Face { normal: normal.normalize(), corners, finish, id, two_sided });
        }
    }
}

/// The bounding rectangle of outlines, for floors and ceilings.
pub fn bounds_of(outlines: impl Iterator<Item = Polygon>) -> (Vec2, Vec2) {
    let start = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY));
    outlines.fold(start, |(low, high), outline| {
        let (l, h) = outline.bounds();
        (low.inf(&l), high.sup(&h))
    })
}

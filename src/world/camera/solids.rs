//! The scene as solids, with what each belongs to.

use crate::geometry::Vec2;
use crate::world::solid::{Color, Solid};
use crate::world::{RoomMap, Scene};

/// What a solid belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Surface {
    /// The floor.
    Floor,
    /// A wall, by its number.
    Wall(usize),
    /// Furniture, by its number in the scene.
    Furniture(usize),
    /// An object, by its number in the scene.
    Object(usize),
}

/// Everything the camera can see, as solids.
#[derive(Clone, Debug)]
pub struct SolidScene {
    pub(super) furniture: Vec<Thing>,
    pub(super) objects: Vec<Thing>,
    pub(super) walls: Vec<(Vec2, Vec2)>,
    pub(super) wall_height: f64,
}

/// The solids of one item, with the ball that holds them.
#[derive(Clone, Debug)]
pub(super) struct Thing {
    pub solids: Vec<Solid>,
    pub centre: Vec2,
    pub middle_height: f64,
    pub radius: f64,
}

impl SolidScene {
    /// The solids of a scene.
    pub fn new(map: &RoomMap, scene: &Scene) -> Self {
        let furniture = scene.furniture.iter().map(|item| Thing::new(item.solids())).collect();
        let holder = |object: &crate::world::PlacedObject| {
            scene.item(&object.on).map(|item| object.solids_on(item)).unwrap_or_default()
        };
        let objects = scene.objects.iter().map(|object| Thing::new(holder(object))).collect();
        Self { furniture, objects, walls: map.walls(), wall_height: map.wall_height }
    }
}

impl Thing {
    fn new(solids: Vec<Solid>) -> Self {
        let start = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY));
        let (low, high) = solids.iter().fold(start, |(low, high), solid| {
            let (l, h) = solid.footprint().bounds();
            (low.inf(&l), high.sup(&h))
        });
        let bottom = solids.iter().map(Solid::bottom).fold(f64::INFINITY, f64::min);
        let top = solids.iter().map(Solid::top).fold(0.0, f64::max);
        let radius = ((high - low).norm_squared() + (top - bottom).powi(2)).sqrt() / 2.0;
        Self { solids, centre: (low + high) / 2.0, middle_height: (bottom + top) / 2.0, radius }
    }

    /// Colour of the largest part.
    pub(super) fn top(&self) -> f64 {
        self.solids.iter().map(Solid::top).fold(0.0, f64::max)
    }
}

/// The colour of walls, floor, and what the picture shows behind everything.
pub(super) const WALL: Color = [222, 216, 204];
pub(super) const FLOOR: Color = [168, 142, 112];
pub(super) const BACKDROP: Color = [236, 238, 240];

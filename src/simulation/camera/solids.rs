//! The scene as solids, with what each belongs to.

use super::faces::{Faces, Finish, Point, Texture, bounds_of};
use crate::catalogue::FurnitureShape;
use crate::geometry::Vec2;
use crate::map::RoomMap;
use crate::simulation::Scene;
use crate::simulation::solid::Solid;

/// Everything the camera can see, as solids.
#[derive(Clone, Debug)]
pub struct SolidScene {
    pub(super) furniture: Vec<Thing>,
    pub(super) objects: Vec<Thing>,
    pub(super) walls: Vec<(Vec2, Vec2)>,
    pub(super) wall_height: f64,
    faces: Faces,
}

/// The solids of one item, with the ball that holds them.
#[derive(Clone, Debug)]
pub(super) struct Thing {
    pub solids: Vec<Solid>,
    /// The box round all of them: opposite corners.
    low: Point,
    high: Point,
    pub centre: Vec2,
    pub middle_height: f64,
    pub radius: f64,
}

impl SolidScene {
    /// The solids of a scene.
    pub fn new(map: &RoomMap, scene: &Scene) -> Self {
        let furniture: Vec<Thing> = scene.furniture.iter().map(|item| Thing::new(item.solids())).collect();
        let holder = |object: &crate::simulation::PlacedObject| {
            scene.item(&object.on).map(|item| object.solids_on(item)).unwrap_or_default()
        };
        let objects: Vec<Thing> = scene.objects.iter().map(|object| Thing::new(holder(object))).collect();
        let mut faces = shell(map);
        let textures = scene.furniture.iter().map(|item| texture_of(item.kind().shape));
        let textures = textures.chain(scene.objects.iter().map(|_| Texture::Plain));
        for ((id, thing), texture) in (1..).zip(furniture.iter().chain(&objects)).zip(textures) {
            thing.solids.iter().for_each(|solid| faces.add_solid(solid, texture, id));
        }
        Self { furniture, objects, walls: map.walls(), wall_height: map.wall_height, faces }
    }

    /// What the renderer draws.
    pub fn faces(&self) -> &Faces {
        &self.faces
    }
}

/// Floor, walls and ceiling of a home.
fn shell(map: &RoomMap) -> Faces {
    let mut faces = Faces::default();
    let (low, high) = bounds_of(map.rooms.iter().map(|room| room.polygon()));
    faces.add_level(low, high, 0.0, FLOOR);
    faces.add_level(low, high, map.wall_height, CEILING);
    for (a, b) in map.walls() {
        faces.add_wall(a, b, map.wall_height, WALL);
    }
    faces
}

fn texture_of(shape: FurnitureShape) -> Texture {
    match shape {
        FurnitureShape::Couch | FurnitureShape::Bed => Texture::Cloth,
        FurnitureShape::Lamp => Texture::Plain,
        _ => Texture::Wood,
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
        let (centre, middle_height) = ((low + high) / 2.0, (bottom + top) / 2.0);
        let (low, high) = (Point::new(low.x, low.y, bottom), Point::new(high.x, high.y, top));
        Self { solids, low, high, centre, middle_height, radius }
    }

    /// The corners of the box round it.
    pub(super) fn corners(&self) -> impl Iterator<Item = Point> {
        let (low, high) = (self.low, self.high);
        let pick = |bit: usize, low: f64, high: f64| if bit == 0 { low } else { high };
        (0..8).map(move |i| {
            Point::new(pick(i & 1, low.x, high.x), pick(i & 2, low.y, high.y), pick(i & 4, low.z, high.z))
        })
    }

    /// Colour of the largest part.
    pub(super) fn top(&self) -> f64 {
        self.solids.iter().map(Solid::top).fold(0.0, f64::max)
    }
}

const WALL: Finish = Finish::new([222, 216, 204], Texture::Plain);
const CEILING: Finish = Finish::new([240, 240, 238], Texture::Plain);
const FLOOR: Finish = Finish::new([168, 142, 112], Texture::Boards);

//! Everything a robot can touch or hear: walls and the solids that reach below its top.

use crate::geometry::{Polygon, Vec2, cross, segment_distance};
use crate::robot::p3dx;
use crate::world::{RoomMap, Scene};

/// The P3DX deck with its laser bay; what begins higher is driven under.
const ROBOT_TOP_M: f64 = 0.3;

/// Walls and furniture, in the truth.
#[derive(Clone, Debug)]
pub struct Obstacles {
    walls: Vec<(Vec2, Vec2)>,
    things: Vec<Thing>,
}

#[derive(Clone, Debug)]
struct Thing {
    outline: Polygon,
    centre: Vec2,
    radius: f64,
}

impl Obstacles {
    /// The obstacles of a scene.
    ///
    /// A table counts with its whole top: the robot's tower would not pass
    /// under it.
    pub fn new(map: &RoomMap, scene: &Scene) -> Self {
        let solids = scene.furniture.iter().flat_map(|item| {
            let low = item.solids().into_iter().filter(|solid| solid.bottom() < ROBOT_TOP_M);
            low.map(|solid| solid.footprint().clone()).chain([item.footprint()]).collect::<Vec<_>>()
        });
        Self { walls: map.walls(), things: solids.map(Thing::new).collect() }
    }

    /// No obstacles at all.
    pub fn nothing() -> Self {
        Self { walls: Vec::new(), things: Vec::new() }
    }

    /// Metres from `outline` to the nearest obstacle, as far as `reach`; zero when it touches one.
    pub fn clearance(&self, outline: &Polygon, centre: Vec2, reach: f64) -> f64 {
        let radius = p3dx::SWING_M;
        let mut nearest = reach;
        for &(a, b) in &self.walls {
            if crate::geometry::distance_to_segment(centre, a, b) - radius < nearest {
                let gap = outline.edges().map(|(c, d)| segment_distance(c, d, a, b)).fold(f64::INFINITY, f64::min);
                nearest = nearest.min(gap);
            }
        }
        for thing in &self.things {
            if (thing.centre - centre).norm() - thing.radius - radius < nearest {
                nearest = nearest.min(outline.distance(&thing.outline));
            }
        }
        nearest
    }

    /// Metres along a ray (unit direction) to the first obstacle, at most `reach`.
    pub fn range(&self, origin: Vec2, direction: Vec2, reach: f64) -> f64 {
        let mut nearest = reach;
        for &(a, b) in &self.walls {
            nearest = nearest.min(ray_to_segment(origin, direction, a, b));
        }
        for thing in &self.things {
            let to = thing.centre - origin;
            let off = cross(direction, to).abs();
            if off <= thing.radius && to.dot(&direction) + thing.radius > 0.0 && to.norm() - thing.radius < nearest {
                for (a, b) in thing.outline.edges() {
                    nearest = nearest.min(ray_to_segment(origin, direction, a, b));
                }
            }
        }
        nearest
    }
}

impl Thing {
    fn new(outline: Polygon) -> Self {
        let centre = outline.centroid();
        let radius = outline.corners().iter().map(|corner| (corner - centre).norm()).fold(0.0, f64::max);
        Self { outline, centre, radius }
    }
}

fn ray_to_segment(origin: Vec2, direction: Vec2, a: Vec2, b: Vec2) -> f64 {
    let along = b - a;
    let denominator = cross(direction, along);
    if denominator.abs() < 1e-12 {
        return f64::INFINITY;
    }
    let (t, s) = (cross(a - origin, along) / denominator, cross(a - origin, direction) / denominator);
    if t >= 0.0 && (0.0..=1.0).contains(&s) { t } else { f64::INFINITY }
}

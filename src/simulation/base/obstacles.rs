//! Everything a robot can touch or hear: walls and the solids that reach below its top.

use crate::geometry::{Polygon, Vec2, cross, segment_distance};
use crate::map::RoomMap;
use crate::robot::p3dx;
use crate::robot::sonar;
use crate::robot::sonar::Segment;
use crate::simulation::Scene;

/// Height of the sonar rings: what does not reach it is not heard, metres.
const SONAR_HEIGHT_M: f64 = 0.2;
/// What ends lower is rolled over, metres.
const STEP_M: f64 = 0.04;

/// Walls and furniture, in the truth.
#[derive(Clone, Debug)]
pub struct Obstacles {
    walls: Vec<(Vec2, Vec2)>,
    things: Vec<Thing>,
}

#[derive(Clone, Debug)]
struct Thing {
    outline: Polygon,
    edges: Vec<Segment>,
    centre: Vec2,
    radius: f64,
    /// It stands where the sonars ping; what hangs higher is only run into.
    is_low: bool,
}

impl Obstacles {
    /// The obstacles of a scene.
    ///
    /// A table counts with its whole top: the robot's tower would not pass
    /// under it.
    pub fn new(map: &RoomMap, scene: &Scene) -> Self {
        let things = scene.furniture.iter().flat_map(|item| {
            let solids = item.solids().into_iter().filter(|solid| solid.top() > STEP_M);
            let parts = solids.filter(|solid| solid.bottom() < SONAR_HEIGHT_M).map(|solid| {
                let is_low = solid.top() > SONAR_HEIGHT_M;
                (solid.footprint().clone(), is_low)
            });
            parts.chain([(item.footprint(), false)]).collect::<Vec<_>>()
        });
        Self { walls: map.walls(), things: things.map(Thing::new).collect() }
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

    /// Metres to what a beam of light from `origin` along `axis` (a unit vector) meets at the sonars' height, within
    /// `reach`.
    pub fn beam(&self, origin: Vec2, axis: Vec2, reach: f64) -> Option<f64> {
        let edges = self.things.iter().filter(|thing| thing.is_low).flat_map(|thing| &thing.edges);
        let met = edges.chain(&self.walls).filter_map(|&(a, b)| {
            let along = b - a;
            let across = cross(axis, along);
            let way = cross(a - origin, along) / across;
            let share = cross(a - origin, axis) / across;
            (across.abs() > 1e-12 && way > 0.0 && (0.0..=1.0).contains(&share)).then_some(way)
        });
        met.min_by(f64::total_cmp).filter(|way| *way <= reach)
    }

    /// Metres to the nearest echo for a sonar at `origin` that looks along `axis` (a unit vector), within `reach`.
    pub fn echo(&self, origin: Vec2, axis: Vec2, reach: f64) -> Option<f64> {
        let mut nearest = sonar::echo(&self.walls, origin, axis, reach);
        let in_reach = |thing: &&Thing| {
            let to = thing.centre - origin;
            let limit = nearest.map_or(reach, |echo| echo.range_m) + thing.radius;
            to.norm_squared() < limit * limit && may_be_heard(thing, to, axis)
        };
        let near: Vec<&Thing> = self.things.iter().filter(|thing| thing.is_low).filter(in_reach).collect();
        for edge in near.iter().flat_map(|thing| &thing.edges) {
            let reach = nearest.map_or(reach, |echo| echo.range_m);
            nearest = sonar::surface_echo(*edge, origin, axis, reach).or(nearest);
        }
        let echo = nearest?;
        let mut surfaces = near.iter().flat_map(|thing| &thing.edges).chain(&self.walls);
        let hidden = surfaces.any(|&surface| sonar::hides(surface, origin, &echo));
        (!hidden).then_some(echo.range_m)
    }
}

/// Whether any part of a thing can lie within the cone.
fn may_be_heard(thing: &Thing, to: Vec2, axis: Vec2) -> bool {
    let along = to.dot(&axis);
    let off = cross(axis, to).abs();
    off * sonar::HALF_CONE_RAD.cos() - along * sonar::HALF_CONE_RAD.sin() <= thing.radius && along > -thing.radius
}

impl Thing {
    fn new((outline, is_low): (Polygon, bool)) -> Self {
        let centre = outline.centroid();
        let radius = outline.corners().iter().map(|corner| (corner - centre).norm()).fold(0.0, f64::max);
        let edges = outline.edges().collect();
        Self { outline, edges, centre, radius, is_low }
    }
}

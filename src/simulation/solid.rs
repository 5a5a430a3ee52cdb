//! Solids: vertical prisms, of which furniture is composed, and meshes from files.

use std::sync::Arc;

use super::mesh::{Mesh, Point};
use crate::geometry::{Polygon, Pose, Vec2, cross, vec2};

/// Red, green, blue.
pub type Color = [u8; 3];

/// A vertical prism over a convex footprint, or a mesh that fills part of one.
#[derive(Clone, Debug)]
pub struct Solid {
    footprint: Polygon,
    low: Vec2,
    high: Vec2,
    bottom: f64,
    top: f64,
    color: Color,
    mesh: Option<PlacedMesh>,
}

/// A mesh at a pose, its axes stretched.
#[derive(Clone, Debug)]
struct PlacedMesh {
    mesh: Arc<Mesh>,
    pose: Pose,
    stretch: Point,
}

/// Where a ray enters a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// In units of the ray's direction.
    pub distance: f64,
    /// The outward normal of the face.
    pub normal: [f64; 3],
}

/// A ray in space: origin and direction, metres.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Its plan.
    pub origin: Vec2,
    /// Height of the origin.
    pub height: f64,
    /// Direction in plan.
    pub direction: Vec2,
    /// Climb per unit of direction.
    pub climb: f64,
}

impl Solid {
    /// A prism from `bottom` to `top`, metres above the floor.
    pub fn new(footprint: Polygon, bottom: f64, top: f64, color: Color) -> Self {
        let (low, high) = footprint.bounds();
        Self { footprint, low, high, bottom, top, color, mesh: None }
    }

    /// A box in the frame of `pose`: `x` and `y` are (from, to) along and across, metres.
    pub fn block(pose: Pose, x: (f64, f64), y: (f64, f64), z: (f64, f64), color: Color) -> Self {
        let corners = [(x.0, y.0), (x.1, y.0), (x.1, y.1), (x.0, y.1)].map(|(a, b)| pose.to_world(vec2(a, b)));
        Self::new(Polygon::new(corners.to_vec()), z.0, z.1, color)
    }

    /// A mesh that stands at `pose`, its length, width and height stretched by the given factors.
    pub fn mesh(mesh: &Arc<Mesh>, pose: Pose, stretch: Point, color: Color) -> Self {
        let corners = mesh.outline().iter().map(|c| pose.to_world(vec2(c.x * stretch.x, c.y * stretch.y)));
        let solid = Self::new(Polygon::new(corners.collect()), 0.0, mesh.size().height * stretch.z, color);
        Self { mesh: Some(PlacedMesh { mesh: Arc::clone(mesh), pose, stretch }), ..solid }
    }

    /// Its colour.
    pub fn color(&self) -> Color {
        self.color
    }

    /// Metres above the floor.
    pub fn top(&self) -> f64 {
        self.top
    }

    /// Its outline on the floor.
    pub fn footprint(&self) -> &Polygon {
        &self.footprint
    }

    /// Its lowest point, metres above the floor.
    pub fn bottom(&self) -> f64 {
        self.bottom
    }

    /// The triangles of a mesh, where they stand; nothing for a prism.
    pub fn triangles(&self) -> Option<Vec<[Point; 3]>> {
        self.mesh.as_ref().map(PlacedMesh::triangles)
    }

    /// Where `ray` enters, when it does ahead of its origin.
    pub fn hit(&self, ray: &Ray) -> Option<Hit> {
        let (mut enter, mut leave, mut normal) = self.height_span(ray)?;
        if !self.may_hit(ray) {
            return None;
        }
        if let Some(mesh) = &self.mesh {
            return mesh.hit(ray);
        }
        // The convex outline, counter-clockwise: clip the ray by each edge's half-plane.
        for (a, b) in self.footprint.edges() {
            let along = b - a;
            let (outside, speed) = (-cross(along, ray.origin - a), -cross(along, ray.direction));
            if speed.abs() < 1e-12 {
                if outside > 0.0 {
                    return None;
                }
                continue;
            }
            let t = -outside / speed;
            if speed < 0.0 {
                if t > enter {
                    enter = t;
                    let n = vec2(along.y, -along.x).normalize();
                    normal = [n.x, n.y, 0.0];
                }
            } else {
                leave = leave.min(t);
            }
            if enter >= leave {
                return None;
            }
        }
        (enter > 1e-9).then_some(Hit { distance: enter, normal })
    }

    /// Where the ray is between bottom and top, and the normal of the face it comes through.
    fn height_span(&self, ray: &Ray) -> Option<(f64, f64, [f64; 3])> {
        if ray.climb.abs() < 1e-12 {
            let level = ray.height >= self.bottom && ray.height <= self.top;
            return level.then_some((0.0, f64::INFINITY, [0.0; 3]));
        }
        let (to_bottom, to_top) = ((self.bottom - ray.height) / ray.climb, (self.top - ray.height) / ray.climb);
        let (enter, leave, up) = if ray.climb > 0.0 { (to_bottom, to_top, -1.0) } else { (to_top, to_bottom, 1.0) };
        (leave > 0.0).then_some((enter, leave, [0.0, 0.0, up]))
    }

    /// The bounding box in plan by slabs: cheap, and most rays miss.
    fn may_hit(&self, ray: &Ray) -> bool {
        let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
        for axis in 0..2 {
            let inverse = 1.0 / ray.direction[axis];
            let (t0, t1) =
                ((self.low[axis] - ray.origin[axis]) * inverse, (self.high[axis] - ray.origin[axis]) * inverse);
            enter = enter.max(t0.min(t1));
            leave = leave.min(t0.max(t1));
        }
        enter <= leave
    }
}

impl PlacedMesh {
    fn triangles(&self) -> Vec<[Point; 3]> {
        let place = |corner: &Point| {
            let local = corner.component_mul(&self.stretch);
            let at = self.pose.to_world(vec2(local.x, local.y));
            Point::new(at.x, at.y, local.z)
        };
        self.mesh
            .triangles()
            .iter()
            .map(|corners| [place(&corners[0]), place(&corners[1]), place(&corners[2])])
            .collect()
    }

    fn hit(&self, ray: &Ray) -> Option<Hit> {
        let (sin, cos) = self.pose.heading.sin_cos();
        let at = self.pose.to_local(ray.origin);
        let origin = Point::new(at.x, at.y, ray.height).component_div(&self.stretch);
        let d = ray.direction;
        let turned = Point::new(cos * d.x + sin * d.y, -sin * d.x + cos * d.y, ray.climb);
        let (distance, normal) = self.mesh.hit(origin, turned.component_div(&self.stretch))?;
        let n = normal.component_div(&self.stretch).normalize();
        Some(Hit { distance, normal: [cos * n.x - sin * n.y, sin * n.x + cos * n.y, n.z] })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube() -> Solid {
        Solid::block(Pose::new(3.0, 0.0, 0.0), (-0.5, 0.5), (-0.5, 0.5), (0.0, 1.0), [0; 3])
    }

    #[test]
    fn a_level_ray_meets_the_near_face() {
        let ray = Ray { origin: vec2(0.0, 0.0), height: 0.5, direction: vec2(1.0, 0.0), climb: 0.0 };
        let hit = cube().hit(&ray).expect("a hit");
        assert!((hit.distance - 2.5).abs() < 1e-12);
        assert_eq!(hit.normal, [-1.0, 0.0, 0.0]);
    }

    #[test]
    fn a_falling_ray_meets_the_top() {
        let ray = Ray { origin: vec2(0.0, 0.0), height: 2.5, direction: vec2(1.0, 0.0), climb: -0.5 };
        let hit = cube().hit(&ray).expect("a hit");
        assert!((hit.distance - 3.0).abs() < 1e-12);
        assert_eq!(hit.normal, [0.0, 0.0, 1.0]);
    }

    #[test]
    fn rays_above_beside_and_away_miss() {
        let ray = |y, height, x| Ray { origin: vec2(0.0, y), height, direction: vec2(x, 0.0), climb: 0.0 };
        assert_eq!(cube().hit(&ray(0.0, 1.5, 1.0)), None);
        assert_eq!(cube().hit(&ray(0.8, 0.5, 1.0)), None);
        assert_eq!(cube().hit(&ray(0.0, 0.5, -1.0)), None);
    }
}

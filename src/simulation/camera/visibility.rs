//! How much of each item the camera sees, and how much it would see if nothing stood before it.

use super::solids::{SolidScene, Thing};
use crate::frame::Camera;
use crate::geometry::{Pose, Vec2, cross, vec2};
use crate::simulation::solid::Ray;

/// Furniture is counted on a picture coarser than the camera's by this factor.
const COARSER: usize = 16;
/// Rays to an object: a grid of so many by so many over its extent.
const OBJECT_GRID: usize = 5;

/// One item in one picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Visibility {
    /// Rays that meet it first.
    pub seen: usize,
    /// Rays that would meet it if nothing stood before it.
    pub unoccluded: usize,
    /// Whether all of it lies within the picture.
    pub whole_in_view: bool,
}

impl Visibility {
    /// The share that is not hidden, 0 to 1.
    pub fn share(&self) -> f64 {
        if self.unoccluded == 0 { 0.0 } else { self.seen as f64 / self.unoccluded as f64 }
    }
}

/// All items in one picture, in the scene's order.
#[derive(Clone, Debug, Default)]
pub struct Seen {
    /// The furniture.
    pub furniture: Vec<Visibility>,
    /// The objects.
    pub objects: Vec<Visibility>,
}

impl SolidScene {
    /// What a robot at `pose` sees.
    pub fn visibility(&self, camera: &Camera, pose: Pose) -> Seen {
        let coarse = camera.coarser(COARSER);
        let ahead: Vec<usize> = (0..self.furniture.len()).filter(|&i| may_be_seen(&self.furniture[i], pose)).collect();
        let objects = self.objects.iter().map(|object| self.object_visibility(camera, pose, object, &ahead)).collect();
        Seen { furniture: self.furniture_visibility(&coarse, pose, &ahead), objects }
    }

    /// Counts every ray for each item it meets; all but the first are hidden along it.
    fn furniture_visibility(&self, camera: &Camera, pose: Pose, ahead: &[usize]) -> Vec<Visibility> {
        let ray = camera.rays(pose);
        let ray = |pixel: usize| ray((pixel % camera.width) as f64, (pixel / camera.width) as f64);
        let mut counts = vec![Visibility::default(); self.furniture.len()];
        let mut first: Vec<Option<(f64, usize)>> = vec![None; camera.width * camera.height];
        for &index in ahead {
            for pixel in pixels_of(&self.furniture[index], camera, pose) {
                let Some(distance) = nearest(&self.furniture[index], &ray(pixel), camera.near_m) else { continue };
                counts[index].unoccluded += 1;
                if first[pixel].is_none_or(|(least, _)| distance < least) {
                    first[pixel] = Some((distance, index));
                }
            }
        }
        for (pixel, first) in first.into_iter().enumerate() {
            if let Some((distance, index)) = first
                && self.wall_before(&ray(pixel), distance).is_none()
            {
                counts[index].seen += 1;
            }
        }
        counts
    }

    /// Rays to points over the object's extent, each open or hidden.
    fn object_visibility(&self, camera: &Camera, pose: Pose, object: &Thing, ahead: &[usize]) -> Visibility {
        let Some((column, row, depth)) = camera.project(pose, object.centre, object.middle_height) else {
            return Visibility::default();
        };
        let reach = camera.focal * object.radius / depth;
        let whole_in_view = [(-reach, 0.0), (reach, 0.0), (0.0, -reach), (0.0, reach)]
            .iter()
            .all(|(dx, dy)| camera.shows(column + dx, row + dy));
        let mut visibility = Visibility { whole_in_view, ..Visibility::default() };
        let rays = camera.rays(pose);
        for i in 0..OBJECT_GRID * OBJECT_GRID {
            let offset = |k: usize| (2.0 * (k as f64 + 0.5) / OBJECT_GRID as f64 - 1.0) * reach;
            let (dx, dy) = (offset(i % OBJECT_GRID), offset(i / OBJECT_GRID));
            let ray = rays(column + dx, row + dy);
            let Some(distance) = nearest(object, &ray, camera.near_m) else { continue };
            visibility.unoccluded += 1;
            let hidden =
                ahead.iter().any(|&f| nearest(&self.furniture[f], &ray, camera.near_m).is_some_and(|d| d < distance));
            if !hidden && camera.shows(column + dx, row + dy) && self.wall_before(&ray, distance).is_none() {
                visibility.seen += 1;
            }
        }
        // A thing too flat for the grid of rays still shows at its middle.
        if visibility.unoccluded == 0 {
            visibility = self.middle_visibility(camera, pose, object, ahead, whole_in_view);
        }
        visibility
    }

    fn middle_visibility(
        &self,
        camera: &Camera,
        pose: Pose,
        object: &Thing,
        ahead: &[usize],
        whole_in_view: bool,
    ) -> Visibility {
        let Some((column, row, depth)) = camera.project(pose, object.centre, object.top()) else {
            return Visibility::default();
        };
        let ray = camera.ray(pose, column, row);
        let hidden =
            ahead.iter().any(|&f| nearest(&self.furniture[f], &ray, camera.near_m).is_some_and(|d| d < depth - 0.01));
        let open = !hidden && camera.shows(column, row) && self.wall_before(&ray, depth).is_none();
        Visibility { seen: usize::from(open), unoccluded: 1, whole_in_view }
    }

    /// The wall a ray meets before `limit`: its distance and number.
    pub(super) fn wall_before(&self, ray: &Ray, limit: f64) -> Option<(f64, usize)> {
        let mut found: Option<(f64, usize)> = None;
        for (i, &(a, b)) in self.walls.iter().enumerate() {
            let along = b - a;
            let denominator = cross(ray.direction, along);
            if denominator.abs() < 1e-12 {
                continue;
            }
            let t = cross(a - ray.origin, along) / denominator;
            let s = cross(a - ray.origin, ray.direction) / denominator;
            let height = ray.height + t * ray.climb;
            let meets = t > 0.0 && t < limit && (0.0..=1.0).contains(&s) && height >= 0.0 && height <= self.wall_height;
            if meets && found.is_none_or(|(least, _)| t < least) {
                found = Some((t, i));
            }
        }
        found
    }
}

/// Not behind the camera, and within the widest angle of the picture.
fn may_be_seen(thing: &Thing, pose: Pose) -> bool {
    const HALF_VIEW: f64 = 0.56;
    let local = pose.to_local(thing.centre);
    let distance = local.norm();
    distance <= thing.radius || (local.y.atan2(local.x).abs() - (thing.radius / distance).min(1.0).asin()) < HALF_VIEW
}

/// The pixels on which a thing can show, by number: those within the corners of its bounding box.
fn pixels_of(thing: &Thing, camera: &Camera, pose: Pose) -> impl Iterator<Item = usize> {
    let (mut low, mut high) = (vec2(f64::INFINITY, f64::INFINITY), vec2(f64::NEG_INFINITY, f64::NEG_INFINITY));
    for corner in thing.corners() {
        // A corner beside or behind the camera bounds nothing.
        let (least, most) = match camera.project(pose, corner.xy(), corner.z) {
            Some((column, row, _)) => (vec2(column, row), vec2(column, row)),
            None => (Vec2::repeat(f64::NEG_INFINITY), Vec2::repeat(f64::INFINITY)),
        };
        (low, high) = (low.inf(&least), high.sup(&most));
    }
    // One pixel more on every side, so that rounding decides nothing.
    let range =
        |low: f64, high: f64, size: usize| ((low - 1.0).max(0.0) as usize)..((high + 2.0).max(0.0) as usize).min(size);
    let (columns, width) = (range(low.x, high.x, camera.width), camera.width);
    range(low.y, high.y, camera.height).flat_map(move |row| columns.clone().map(move |column| row * width + column))
}

/// The distance at which a ray first meets a thing.
pub(super) fn nearest(thing: &Thing, ray: &Ray, near: f64) -> Option<f64> {
    if misses_ball(thing, ray) {
        return None;
    }
    let hits = thing.solids.iter().filter_map(|solid| solid.hit(ray)).map(|hit| hit.distance);
    hits.filter(|distance| *distance > near).fold(None, |least: Option<f64>, d| Some(least.map_or(d, |l| l.min(d))))
}

pub(super) fn misses_ball(thing: &Thing, ray: &Ray) -> bool {
    let to: Vec2 = thing.centre - ray.origin;
    let up = thing.middle_height - ray.height;
    let length_squared = ray.direction.norm_squared() + ray.climb * ray.climb;
    let along = (to.dot(&ray.direction) + up * ray.climb) / length_squared;
    if along < 0.0 {
        return to.norm_squared() + up * up > thing.radius * thing.radius;
    }
    let off: Vec2 = to - ray.direction * along;
    let off = vec2(off.norm(), up - ray.climb * along);
    off.norm_squared() > thing.radius * thing.radius
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::RoomMap;
    use crate::simulation::Scene;

    fn seen_from(x: f64, y: f64, heading_deg: f64) -> (Scene, Seen) {
        let (map, scene) = (RoomMap::apartment(), Scene::apartment());
        let seen =
            SolidScene::new(&map, &scene).visibility(&Camera::kinect(), Pose::new(x, y, heading_deg.to_radians()));
        (scene, seen)
    }

    fn share(scene: &Scene, seen: &Seen, id: &str) -> f64 {
        let index = scene.furniture.iter().position(|item| item.id == id).expect("in the scene");
        seen.furniture[index].share()
    }

    #[test]
    fn a_table_in_front_is_seen_and_one_behind_a_wall_is_not() {
        let (scene, seen) = seen_from(2.63, 2.0, 0.0);
        assert!(share(&scene, &seen, "round-table-1") > 0.9);
        assert_eq!(share(&scene, &seen, "round-table-2"), 0.0);
    }

    #[test]
    fn the_couch_hides_part_of_the_table_behind_it() {
        let (scene, seen) = seen_from(4.5, 1.9, 90.0);
        let hidden = share(&scene, &seen, "coffee-table-1");
        assert!(hidden < 0.9, "{hidden}");
    }

    #[test]
    fn an_object_is_seen_from_near_and_not_with_the_back_to_it() {
        let (scene, seen) = seen_from(2.7, 2.0, 0.0);
        let fork = scene.objects.iter().position(|object| object.name == "fork").expect("in the scene");
        assert!(seen.objects[fork].share() > 0.9 && seen.objects[fork].whole_in_view);
        let (_, seen) = seen_from(2.7, 2.0, 180.0);
        assert_eq!(seen.objects[fork].seen, 0);
    }
}

//! Colour pictures of the solids, plainly shaded, as PNG.

use super::Camera;
use super::solids::{BACKDROP, FLOOR, SolidScene, Surface, Thing, WALL};
use super::visibility::misses_ball;
use crate::geometry::Pose;
use crate::world::solid::{Color, Ray};

/// Where the light comes from, a unit vector.
const LIGHT: [f64; 3] = [0.36, 0.48, 0.8];
/// Rays per pixel along each side, for smooth edges.
const SUPERSAMPLES: usize = 2;

/// A picture with 8 bits a channel, row by row from the top.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Pixels.
    pub width: usize,
    /// Pixels.
    pub height: usize,
    /// Red, green, blue of each pixel.
    pub rgb: Vec<u8>,
}

/// What a ray meets: how far, what, its colour and the face's normal.
struct Meeting {
    distance: f64,
    surface: Surface,
    color: Color,
    normal: [f64; 3],
}

/// What the camera of a robot at `pose` shows.
pub fn render(scene: &SolidScene, camera: &Camera, pose: Pose) -> Picture {
    let fine = SUPERSAMPLES as f64;
    let mut rgb = Vec::with_capacity(camera.width * camera.height * 3);
    for row in 0..camera.height {
        for column in 0..camera.width {
            let mut sum = [0.0; 3];
            for i in 0..SUPERSAMPLES * SUPERSAMPLES {
                let offset = |k: usize| (k as f64 + 0.5) / fine - 0.5;
                let (dx, dy) = (offset(i % SUPERSAMPLES), offset(i / SUPERSAMPLES));
                let ray = camera.ray(pose, column as f64 + dx, row as f64 + dy);
                let color = shade(scene, &ray, camera.near_m);
                (0..3).for_each(|c| sum[c] += color[c]);
            }
            rgb.extend(sum.map(|c| (c / (fine * fine)).round().clamp(0.0, 255.0) as u8));
        }
    }
    Picture { width: camera.width, height: camera.height, rgb }
}

fn shade(scene: &SolidScene, ray: &Ray, near: f64) -> [f64; 3] {
    let Some(meeting) = first_meeting(scene, ray, near) else { return BACKDROP.map(f64::from) };
    let facing: f64 = (0..3).map(|i| LIGHT[i] * meeting.normal[i]).sum();
    let light = 0.72 + 0.3 * facing.max(-0.4);
    // Farther things are paler, so that depth can be read.
    let haze = (meeting.distance / 14.0).min(0.35);
    let planks = if meeting.surface == Surface::Floor { floor_pattern(ray, meeting.distance) } else { 1.0 };
    meeting.color.map(|c| (f64::from(c) * light * planks) * (1.0 - haze) + 235.0 * haze)
}

/// Boards of 12 cm, so that the floor gives the eye a scale.
fn floor_pattern(ray: &Ray, distance: f64) -> f64 {
    let at = ray.origin + ray.direction * distance;
    let board = (at.y / 0.12).floor();
    let joint = (at.y / 0.12 - board).min(1.0 - (at.y / 0.12 - board)) < 0.04;
    let tone = 0.97 + 0.06 * ((board * 12.9898).sin() * 43758.5453).fract().abs();
    if joint { tone * 0.9 } else { tone }
}

fn first_meeting(scene: &SolidScene, ray: &Ray, near: f64) -> Option<Meeting> {
    let mut best: Option<Meeting> = None;
    let furniture = scene.furniture.iter().enumerate().map(|(i, thing)| (Surface::Furniture(i), thing));
    let objects = scene.objects.iter().enumerate().map(|(i, thing)| (Surface::Object(i), thing));
    for (surface, thing) in furniture.chain(objects) {
        meet_thing(surface, thing, ray, near, &mut best);
    }
    let limit = best.as_ref().map_or(f64::INFINITY, |m| m.distance);
    if let Some((distance, wall)) = scene.wall_before(ray, limit) {
        let (a, b) = scene.walls[wall];
        let along = (b - a).normalize();
        // Two rooms share a wall: what is seen is always the side turned to the camera.
        let side = if along.y * ray.direction.x - along.x * ray.direction.y > 0.0 { -1.0 } else { 1.0 };
        let normal = [side * along.y, -side * along.x, 0.0];
        best = Some(Meeting { distance, surface: Surface::Wall(wall), color: WALL, normal });
    }
    let to_floor = -ray.height / ray.climb;
    if ray.climb < 0.0 && best.as_ref().is_none_or(|m| to_floor < m.distance) {
        best = Some(Meeting { distance: to_floor, surface: Surface::Floor, color: FLOOR, normal: [0.0, 0.0, 1.0] });
    }
    best
}

fn meet_thing(surface: Surface, thing: &Thing, ray: &Ray, near: f64, best: &mut Option<Meeting>) {
    if misses_ball(thing, ray) {
        return;
    }
    for solid in &thing.solids {
        let Some(hit) = solid.hit(ray).filter(|hit| hit.distance > near) else { continue };
        if best.as_ref().is_none_or(|m| hit.distance < m.distance) {
            *best = Some(Meeting { distance: hit.distance, surface, color: solid.color(), normal: hit.normal });
        }
    }
}

impl Picture {
    /// The picture as a PNG file.
    pub fn to_png(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        // Writing to memory cannot fail; were it to, an empty picture says so.
        let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(&self.rgb));
        if written.is_err() {
            bytes.clear();
        }
        bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::{RoomMap, Scene};

    #[test]
    fn the_red_mug_shows_in_the_picture_taken_before_it() {
        let solids = SolidScene::new(&RoomMap::apartment(), &Scene::apartment());
        let picture = render(&solids, &Camera::kinect().coarser(4), Pose::new(0.2, -5.0, std::f64::consts::PI));
        let red = picture.rgb.chunks(3).filter(|p| p[0] > 150 && p[1] < 90 && p[2] < 90).count();
        assert!(red > 5, "{red} red pixels");
    }
}

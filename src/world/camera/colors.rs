//! The colour picture: finish, light and pattern of the face each pixel shows.

use std::sync::OnceLock;

use super::faces::{Face, Point, Texture};
use super::noise::{Gaussians, Scatter};
use super::raster::{Canvas, View};

/// Light of a room.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// 1 for a well-lit room; the sensor's noise stays when it falls.
    pub level: f64,
    /// Share that comes from everywhere.
    pub ambient: f64,
    /// Where the rest comes from, a unit vector.
    pub from: [f64; 3],
    /// Its colour: red, green, blue about 1.
    pub tint: [f64; 3],
}

impl Default for Light {
    fn default() -> Self {
        Self { level: 1.0, ambient: 0.62, from: [0.36, 0.48, 0.8], tint: [1.0; 3] }
    }
}

/// Standard deviation of the colour camera's noise, levels of 255.
const NOISE: f32 = 2.5;
/// What shows where there is nothing.
const BACKDROP: [u8; 3] = [236, 238, 240];
/// Pixels along a side of a pattern.
const SIDE: usize = 64;

/// What the pixels of one face have in common.
struct Paint {
    color: [f32; 3],
    /// Pattern coordinates: at the eye, and per metre of depth as coefficients of column, row and one.
    eye: [f32; 2],
    over: [Point; 2],
    pattern: &'static [f32],
}

impl Paint {
    fn new(view: &View, face: &Face, light: &Light) -> Self {
        let facing = face.normal.dot(&(face.corners[0] - view.eye)) < 0.0;
        let normal = if facing { face.normal } else { -face.normal };
        let meets: f64 = (0..3).map(|i| normal[i] * light.from[i]).sum::<f64>().max(-0.3);
        let strength = light.level * (light.ambient + (1.05 - light.ambient) * meets);
        let color = [0, 1, 2].map(|c| (f64::from(face.finish.color[c]) * strength * light.tint[c]) as f32);
        let (across, along) = scale(face.finish.texture);
        let (u, v) = pattern_axes(&normal, face);
        let (u, v) = (u * across, v * along);
        let over = [&u, &v].map(|axis| view.over_pixels(&view.turned(axis)));
        let eye = [view.eye.dot(&u) as f32, view.eye.dot(&v) as f32];
        Self { color, eye, over, pattern: &patterns()[face.finish.texture as usize] }
    }
}

/// Axes within the face: level and up, or for a level face its longer side first.
fn pattern_axes(normal: &Point, face: &Face) -> (Point, Point) {
    if normal.z.abs() < 0.7 {
        let level = Point::new(-normal.y, normal.x, 0.0).normalize();
        return (level, normal.cross(&level));
    }
    let edge = |i: usize| face.corners[(i + 1) % face.corners.len()] - face.corners[i];
    let along = if edge(0).norm() > edge(1).norm() { edge(0) } else { edge(1) };
    let along = along.normalize();
    (normal.cross(&along), along)
}

/// Pattern pixels a metre, across and along.
fn scale(texture: Texture) -> (f64, f64) {
    match texture {
        Texture::Plain => (1.0, 1.0),
        Texture::Cloth => (130.0, 130.0),
        Texture::Wood => (140.0, 9.0),
        Texture::Boards => (66.0, 40.0),
        Texture::Tiles => (100.0, 100.0),
    }
}

/// Brightness patterns, [`SIDE`] × [`SIDE`] each, in the order of [`Texture`].
fn patterns() -> &'static [Vec<f32>; 5] {
    static PATTERNS: OnceLock<[Vec<f32>; 5]> = OnceLock::new();
    PATTERNS.get_or_init(|| {
        let grid =
            |value: fn(usize, usize) -> f32| (0..SIDE * SIDE).map(|i| value(i % SIDE, i / SIDE)).collect::<Vec<f32>>();
        [
            grid(|_, _| 1.0),
            grid(|u, v| 0.93 + 0.14 * hash(u, v)),
            grid(|u, v| 0.86 + 0.2 * hash(u, 7) + 0.08 * hash(u, v)),
            grid(|u, v| if u % 8 == 0 { 0.8 } else { 0.92 + 0.12 * hash(u / 8, 3) + 0.05 * hash(u, v) }),
            grid(|u, v| if u % 32 == 0 || v % 32 == 0 { 0.78 } else { 0.95 + 0.08 * hash(u / 32, v / 32) }),
        ]
    })
}

/// A fixed scattering of 0 to 1.
fn hash(u: usize, v: usize) -> f32 {
    let mut x = (u as u32).wrapping_mul(0x9E37_79B1) ^ (v as u32).wrapping_mul(0x85EB_CA77);
    x = (x ^ (x >> 15)).wrapping_mul(0x2C1B_3C6D);
    x = (x ^ (x >> 12)).wrapping_mul(0x297A_2D39);
    (x >> 8) as f32 / 16_777_216.0
}

/// The colour picture of a canvas.
pub(super) fn paint(view: &View, faces: &[Face], canvas: &Canvas, light: &Light, seed: u64) -> Vec<[u8; 3]> {
    let mut paints: Vec<Option<Paint>> = Vec::new();
    paints.resize_with(faces.len(), || None);
    let mut picture = vec![BACKDROP; canvas.face.len()];
    let (gaussians, mut scatter) = (Gaussians::shared(), Scatter::new(seed));
    for row in 0..canvas.height {
        let mut from = row * canvas.width;
        let end = from + canvas.width;
        while from < end {
            let number = canvas.face[from];
            let run = canvas.face[from..end].iter().take_while(|&&face| face == number).count();
            if number > 0 {
                let face = number as usize - 1;
                let paint = paints[face].get_or_insert_with(|| Paint::new(view, &faces[face], light));
                let pixels = &mut picture[from..from + run];
                paint_run(
                    paint,
                    pixels,
                    &canvas.inverse[from..from + run],
                    (from % canvas.width, row),
                    |pixel, rgb| {
                        let noise = NOISE * gaussians.pick(scatter.bits());
                        *pixel = rgb.map(|c| (c + noise) as u8);
                    },
                );
            }
            from += run;
        }
    }
    picture
}

/// Paints a run of pixels of one face on one row.
fn paint_run(
    paint: &Paint,
    pixels: &mut [[u8; 3]],
    inverse: &[f32],
    (column, row): (usize, usize),
    mut put: impl FnMut(&mut [u8; 3], [f32; 3]),
) {
    let start = |axis: &Point| (axis.x * column as f64 + axis.y * row as f64 + axis.z) as f32;
    let (u, v) = (start(&paint.over[0]), start(&paint.over[1]));
    let (du, dv) = (paint.over[0].x as f32, paint.over[1].x as f32);
    for (i, (pixel, inverse)) in pixels.iter_mut().zip(inverse).enumerate() {
        let depth = 1.0 / inverse;
        let at = |eye: f32, start: f32, step: f32| (eye + (start + i as f32 * step) * depth) as i32 as usize % SIDE;
        let tone = paint.pattern[at(paint.eye[1], v, dv) * SIDE + at(paint.eye[0], u, du)];
        put(pixel, paint.color.map(|c| c * tone));
    }
}

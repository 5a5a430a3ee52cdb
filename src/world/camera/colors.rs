//! The colour picture: finish, light and pattern of the face each pixel shows.

use std::sync::OnceLock;

use multiversion::multiversion;

use super::faces::{Face, Point, Texture};
use super::noise::{Gaussians, Scatter, Table};
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
    pattern: &'static [f32; SIDE * SIDE],
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
fn patterns() -> &'static [[f32; SIDE * SIDE]; 5] {
    static PATTERNS: OnceLock<Box<[[f32; SIDE * SIDE]; 5]>> = OnceLock::new();
    PATTERNS.get_or_init(|| {
        let grid = |value: fn(usize, usize) -> f32| std::array::from_fn(|i| value(i % SIDE, i / SIDE));
        Box::new([
            grid(|_, _| 1.0),
            grid(|u, v| 0.93 + 0.14 * hash(u, v)),
            grid(|u, v| 0.86 + 0.2 * hash(u, 7) + 0.08 * hash(u, v)),
            grid(|u, v| if u % 8 == 0 { 0.8 } else { 0.92 + 0.12 * hash(u / 8, 3) + 0.05 * hash(u, v) }),
            grid(|u, v| if u % 32 == 0 || v % 32 == 0 { 0.78 } else { 0.95 + 0.08 * hash(u / 32, v / 32) }),
        ])
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
    let mut brush = Brush { noise: Gaussians::shared().tabled(|deviate| NOISE * deviate), scatter: Scatter::new(seed) };
    let mut spots = vec![0_u16; canvas.width];
    for row in 0..canvas.height {
        let mut from = row * canvas.width;
        let end = from + canvas.width;
        while from < end {
            let number = canvas.face[from];
            let run = canvas.face[from..end].iter().take_while(|&&face| face == number).count();
            if number > 0 {
                let face = number as usize - 1;
                let paint = paints[face].get_or_insert_with(|| Paint::new(view, &faces[face], light));
                let spots = &mut spots[..run];
                paint.spots(spots, &canvas.inverse[from..from + run], from % canvas.width, row);
                brush.stroke(paint, spots, &mut picture[from..from + run]);
            }
            from += run;
        }
    }
    picture
}

impl Paint {
    /// Where in the pattern each pixel of a run on one row lies.
    fn spots(&self, spots: &mut [u16], inverse: &[f32], column: usize, row: usize) {
        let start = |axis: &Point| (axis.x * column as f64 + axis.y * row as f64 + axis.z) as f32;
        let step = |axis: &Point| axis.x as f32;
        let [u, v] = &self.over;
        spread(spots, inverse, self.eye, [start(u), start(v)], [step(u), step(v)]);
    }
}

#[multiversion(targets("x86_64+avx2", "x86_64+sse4.1"))]
fn spread(spots: &mut [u16], inverse: &[f32], eye: [f32; 2], start: [f32; 2], step: [f32; 2]) {
    for (i, (spot, inverse)) in spots.iter_mut().zip(inverse).enumerate() {
        let depth = 1.0 / inverse;
        let u = (eye[0] + (start[0] + i as f32 * step[0]) * depth) as i32 & (SIDE as i32 - 1);
        let v = (eye[1] + (start[1] + i as f32 * step[1]) * depth) as i32 & (SIDE as i32 - 1);
        *spot = (v * SIDE as i32 + u) as u16;
    }
}

/// Puts colour with the camera's noise into the picture.
struct Brush {
    noise: Table<f32>,
    scatter: Scatter,
}

impl Brush {
    fn stroke(&mut self, paint: &Paint, spots: &[u16], pixels: &mut [[u8; 3]]) {
        let [red, green, blue] = paint.color;
        for (pixel, spot) in pixels.iter_mut().zip(spots) {
            let noise = self.noise.pick(self.scatter.bits());
            let tone = paint.pattern[usize::from(*spot) % (SIDE * SIDE)];
            *pixel = [(red * tone + noise) as u8, (green * tone + noise) as u8, (blue * tone + noise) as u8];
        }
    }
}

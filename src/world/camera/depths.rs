//! The depth picture of a Kinect v1: what the infrared projector and camera make of the true depth.
//!
//! Disparity is d = f·b/z with f = 580 px and b = 75 mm. Its noise and its
//! steps of 1/8 px give the published depth noise σz = 1.425·10⁻³ z² m
//! (Khoshelham & Elberink 2012) and steps of 2.9 mm at 1 m, 72 mm at 5 m.
//! Lateral noise is 0.8 px (Nguyen et al. 2012).

use super::faces::{Face, Texture};
use super::noise::{Gaussians, Scatter, Table};
use super::raster::{Canvas, View};

/// Focal length times baseline, pixels × metres.
const FOCAL_BASELINE: f32 = 580.0 * 0.075;
/// Standard deviation of the disparity, pixels: σz f b / z².
const DISPARITY_NOISE: f32 = 1.425e-3 * FOCAL_BASELINE;
/// Steps of disparity per pixel.
const STEPS: f32 = 8.0;
/// Lateral noise, pixels.
const LATERAL_NOISE: f32 = 0.8;
/// Nearest and farthest depth, metres.
const RANGE: (f32, f32) = (0.5, 8.0);
/// Cosine to the surface's normal below which returns are lost: none at the first, all at the second.
const GRAZING: (f32, f32) = (0.2, 0.06);
/// Brightness (of 255) below which returns from afar are lost.
const DARK: f32 = 48.0;
/// Side of the patches lost together, pixels.
const PATCH: usize = 8;

/// What is wrong with a Kinect's depth; each fault can be switched off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KinectFaults {
    /// Noise of disparity and lateral noise, in multiples of the published; 0 is none.
    pub noise: f64,
    /// Disparity in steps of 1/8 px.
    pub steps: bool,
    /// Nothing nearer than 0.5 m or farther than 8 m.
    pub range: bool,
    /// Holes beside near edges, where the projector does not reach.
    pub shadow: bool,
    /// Holes where surfaces are seen at a grazing angle.
    pub grazing: bool,
    /// Holes in dark surfaces.
    pub dark: bool,
    /// Share of pixels lost besides, singly and in patches; 0 to 1.
    pub loss: f64,
}

impl KinectFaults {
    /// An ideal sensor.
    pub const NONE: Self =
        Self { noise: 0.0, steps: false, range: false, shadow: false, grazing: false, dark: false, loss: 0.0 };
}

impl Default for KinectFaults {
    fn default() -> Self {
        Self { noise: 1.0, steps: true, range: true, shadow: true, grazing: true, dark: true, loss: 0.08 }
    }
}

/// What decides whether a face gives a return.
#[derive(Clone, Copy, Default)]
struct Response {
    /// Metres from the camera to the face's plane: the cosine is this over the pixel's distance.
    plane: f32,
    /// Added probability of loss per metre beyond 1.5 m.
    darkness: f32,
}

/// The depth picture of a canvas, millimetres.
pub(super) fn measure(view: &View, faces: &[Face], canvas: &Canvas, faults: &KinectFaults, seed: u64) -> Vec<u16> {
    let mut sensor = Sensor::new(view, faces, canvas, *faults, seed);
    let mut depth = vec![0; canvas.inverse.len()];
    for (row, line) in depth.chunks_exact_mut(canvas.width).enumerate() {
        sensor.read_row(row, line);
    }
    depth
}

struct Sensor<'c> {
    canvas: &'c Canvas,
    faults: KinectFaults,
    /// By the face's number + 1.
    responses: Vec<Response>,
    /// Depth of each disparity step, millimetres.
    depths: Vec<u16>,
    /// Noise of the disparity, pixels.
    noise: Table<f32>,
    /// Lateral noise, pixels, counted from [`AIM`] less.
    aside: Table<u32>,
    /// Of each column the square of its ray's length, less the row's part.
    across: Vec<f32>,
    scatter: Scatter,
    patches: Scatter,
    lost: Vec<bool>,
    shadowed: Vec<bool>,
    middle_row: f32,
    focal: f32,
}

/// No pixel looks so far aside.
const AIM: usize = 16;

impl<'c> Sensor<'c> {
    fn new(view: &View, faces: &[Face], canvas: &'c Canvas, faults: KinectFaults, seed: u64) -> Self {
        let response = |face: &Face| {
            let [r, g, b] = face.finish.color.map(f32::from);
            let brightness = 0.3 * r + 0.59 * g + 0.11 * b;
            let matt = if face.finish.texture == Texture::Cloth { 0.5 } else { 1.0 };
            let darkness = matt * 0.25 * (1.0 - brightness / DARK).max(0.0);
            Response { plane: face.normal.dot(&(face.corners[0] - view.eye)).abs() as f32, darkness }
        };
        let responses = std::iter::once(Response::default()).chain(faces.iter().map(response)).collect();
        let ((cx, cy), focal) = (view.centre(), view.camera.focal as f32);
        let across = (0..canvas.width).map(|column| {
            let x = (column as f32 - cx as f32) / focal;
            1.0 + x * x
        });
        let (gaussians, level) = (Gaussians::shared(), faults.noise as f32);
        Self {
            canvas,
            faults,
            responses,
            depths: depth_of_steps(faults.range),
            noise: gaussians.tabled(|deviate| DISPARITY_NOISE * level * deviate),
            aside: gaussians.tabled(|deviate| (LATERAL_NOISE * level * deviate + AIM as f32 + 0.5) as u32),
            across: across.collect(),
            scatter: Scatter::new(seed),
            patches: Scatter::new(seed ^ 0x5EED),
            lost: vec![false; canvas.width.div_ceil(PATCH)],
            shadowed: vec![false; canvas.width],
            middle_row: cy as f32,
            focal,
        }
    }

    fn read_row(&mut self, row: usize, line: &mut [u16]) {
        if row.is_multiple_of(PATCH) {
            // Six of ten lost pixels are lost in patches.
            let limit = (0.6 * self.faults.loss * f64::from(u32::MAX)) as u32;
            self.lost.iter_mut().for_each(|lost| *lost = self.patches.bits() < limit);
        }
        if self.faults.shadow {
            self.cast_shadow(row);
        }
        let single = (0.4 * self.faults.loss * 65536.0) as f32;
        let y = (row as f32 - self.middle_row) / self.focal;
        for (column, depth) in line.iter_mut().enumerate() {
            let bits = self.scatter.bits();
            if self.shadowed[column] || self.lost[column / PATCH] {
                continue;
            }
            let (inverse, face) = self.seen_at(row, column, bits);
            let chance = single + 65536.0 * self.face_loss(face, inverse, self.across[column] + y * y);
            if inverse > 0.0 && ((bits >> 16) as f32) >= chance {
                *depth = self.depth(inverse, bits);
            }
        }
    }

    /// Inverse depth and face where the pixel truly looks: lateral noise mixes up neighbours.
    #[inline(always)]
    fn seen_at(&self, row: usize, column: usize, bits: u32) -> (f32, u32) {
        let canvas = self.canvas;
        let mut at = row * canvas.width + column;
        if self.faults.noise > 0.0 {
            let aimed = |here: usize, bits: u32, size: usize| {
                (here + self.aside.pick(bits >> 20) as usize).clamp(AIM, size + AIM - 1) - AIM
            };
            let x = aimed(column, bits.wrapping_mul(0x9E37_79B1), canvas.width);
            let y = aimed(row, bits.wrapping_mul(0x85EB_CA77), canvas.height);
            at = y * canvas.width + x;
        }
        (canvas.inverse[at], canvas.face[at])
    }

    /// Probability that a face gives no return to a pixel whose ray has a length of the root of `length_squared`.
    #[inline(always)]
    fn face_loss(&self, face: u32, inverse: f32, length_squared: f32) -> f32 {
        let response = self.responses[face as usize];
        let mut chance = 0.0;
        let upright = response.plane * inverse;
        // Nearly all faces are seen at no grazing angle: the root is left out for them.
        if self.faults.grazing && upright * upright < 1.01 * GRAZING.0 * GRAZING.0 * length_squared {
            let cosine = upright / length_squared.sqrt();
            chance += ((GRAZING.0 - cosine) / (GRAZING.0 - GRAZING.1)).clamp(0.0, 1.0);
        }
        if self.faults.dark && response.darkness > 0.0 {
            chance += response.darkness * (1.0 / inverse - 1.5).max(0.0);
        }
        chance
    }

    /// Millimetres that the sensor makes of an inverse depth.
    #[inline(always)]
    fn depth(&self, inverse: f32, bits: u32) -> u16 {
        let disparity = FOCAL_BASELINE * inverse + self.noise.pick(bits);
        if self.faults.steps {
            let step = (STEPS * disparity + 0.5) as usize;
            return self.depths.get(step).copied().unwrap_or(0);
        }
        let depth = FOCAL_BASELINE / disparity;
        let out = self.faults.range && !(RANGE.0..=RANGE.1).contains(&depth);
        if out || disparity <= 0.0 { 0 } else { (1000.0 * depth + 0.5).min(65535.0) as u16 }
    }

    /// Marks the pixels of a row that the projector, a baseline to the right, does not reach.
    fn cast_shadow(&mut self, row: usize) {
        let line = &self.canvas.inverse[row * self.canvas.width..(row + 1) * self.canvas.width];
        let mut edge = f32::INFINITY;
        for (column, (inverse, shadowed)) in line.iter().zip(&mut self.shadowed).enumerate().rev() {
            let lit_from = column as f32 - FOCAL_BASELINE * inverse;
            *shadowed = lit_from > edge;
            edge = edge.min(lit_from);
        }
    }
}

/// Millimetres of each disparity step; 0 out of range.
fn depth_of_steps(range: bool) -> Vec<u16> {
    let last = (STEPS * FOCAL_BASELINE / 0.1) as usize;
    (0..=last)
        .map(|step| {
            let depth = STEPS * FOCAL_BASELINE / step.max(1) as f32;
            let out = range && !(RANGE.0..=RANGE.1).contains(&depth);
            if out || step == 0 { 0 } else { (1000.0 * depth + 0.5).min(65535.0) as u16 }
        })
        .collect()
}

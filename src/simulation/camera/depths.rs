//! The depth picture of a Kinect v1: what the infrared projector and camera make of the true depth.
//!
//! Disparity is d = f·b/z with f = 580 px and b = 75 mm. Its noise and its
//! steps of 1/8 px give the published depth noise σz = 1.425·10⁻³ z² m
//! (Khoshelham & Elberink 2012) and steps of 2.9 mm at 1 m, 72 mm at 5 m.
//! Lateral noise is 0.8 px (Nguyen et al. 2012).
//!
//! A row is read in passes, each over all its pixels: random bits, where each
//! pixel looks, what it sees there, how likely it is lost, what it measures.
//! The passes that only reckon do many pixels at once.

use multiversion::multiversion;

use super::faces::{Face, Texture};
use super::lateral::Lateral;
use super::noise::{Gaussians, Table, whole};
use super::raster::{Canvas, LANES, View};
use super::scatter::Scatter;
use super::shadow::cast_shadow;

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
    let mut picture = Vec::with_capacity(canvas.pixels());
    for row in 0..canvas.height {
        sensor.block(row);
        sensor.look(row);
        sensor.reckon(row);
        picture.extend_from_slice(sensor.depths());
    }
    picture
}

struct Sensor<'c> {
    canvas: &'c Canvas,
    faults: KinectFaults,
    /// By the face's number + 1.
    responses: Vec<Response>,
    /// Depth of each disparity step, millimetres.
    depth_of_steps: Vec<u16>,
    /// Noise of the disparity, pixels.
    noise: Table<f32>,
    /// None when there is none.
    lateral: Option<Lateral>,
    scatter: Scatter,
    patches: Scatter,
    lost: Vec<u32>,
    middle_row: f32,
    focal: f32,
    line: Line,
}

/// What is known of the pixels of a row; each list ends with a whole group.
struct Line {
    /// Of each column the square of its ray's length, less the row's part.
    across: Vec<f32>,
    bits: Vec<u32>,
    /// Whether the projector does not reach it, or its patch is lost.
    blocked: Vec<bool>,
    /// Columns of the projector's rays.
    rays: Vec<f32>,
    /// Where the pixel truly looks, as the number of a pixel.
    places: Vec<u32>,
    /// Inverse depth and response there.
    inverse: Vec<f32>,
    responses: Vec<Response>,
    noise: Vec<f32>,
    /// 0 where the return is lost.
    disparity: Vec<f32>,
    depth: Vec<u16>,
}

impl Line {
    fn new(view: &View) -> Self {
        let length = view.camera.width.next_multiple_of(LANES);
        let (cx, focal) = (view.centre().0 as f32, view.camera.focal as f32);
        let across = (0..length).map(|column| {
            let x = (column as f32 - cx) / focal;
            1.0 + x * x
        });
        Self {
            across: across.collect(),
            bits: vec![0; length],
            blocked: vec![false; length],
            rays: vec![0.0; length],
            places: vec![0; length],
            inverse: vec![0.0; length],
            responses: vec![Response::default(); length],
            noise: vec![0.0; length],
            disparity: vec![0.0; length],
            depth: vec![0; length],
        }
    }
}

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
        let (line, level) = (Line::new(view), faults.noise as f32);
        Self {
            canvas,
            faults,
            responses,
            depth_of_steps: depth_of_steps(faults.range),
            noise: Gaussians::shared().tabled(|deviate| DISPARITY_NOISE * level * deviate),
            lateral: (level > 0.0).then(|| Lateral::new(LATERAL_NOISE * level, line.bits.len())),
            scatter: Scatter::new(seed),
            patches: Scatter::new(seed ^ 0x5EED),
            lost: vec![0; canvas.width.div_ceil(PATCH)],
            middle_row: view.centre().1 as f32,
            focal: view.camera.focal as f32,
            line,
        }
    }

    /// Marks the pixels of a row that lie in shadow or in a lost patch.
    fn block(&mut self, row: usize) {
        if row.is_multiple_of(PATCH) {
            self.patches.fill(&mut self.lost);
        }
        let (width, line) = (self.canvas.width, &mut self.line);
        let blocked = &mut line.blocked[..width];
        if self.faults.shadow {
            cast_shadow(&self.canvas.inverse[row * width..], FOCAL_BASELINE, &mut line.rays[..width], blocked);
        } else {
            blocked.fill(false);
        }
        // Six of ten lost pixels are lost in patches.
        let limit = (0.6 * self.faults.loss * f64::from(u32::MAX)) as u32;
        let patches = blocked.chunks_mut(PATCH).zip(&self.lost);
        patches.filter(|(_, lost)| **lost < limit).for_each(|(patch, _)| patch.fill(true));
    }

    /// Draws the random bits of a row, and sees what its pixels look at.
    fn look(&mut self, row: usize) {
        let (canvas, line) = (self.canvas, &mut self.line);
        self.scatter.fill(&mut line.bits[..canvas.width]);
        match &mut self.lateral {
            Some(lateral) => lateral.aim(&mut line.places, &line.bits, row, canvas),
            None => line.places.iter_mut().zip(row * canvas.width..).for_each(|(place, at)| *place = at as u32),
        }
        let (inverse, face, responses) = (&canvas.inverse[..], &canvas.face[..], &self.responses[..]);
        for ((place, seen), response) in line.places.iter().zip(&mut line.inverse).zip(&mut line.responses) {
            let place = *place as usize;
            *seen = inverse[place];
            *response = responses[face[place] as usize];
        }
        for (noise, bits) in line.noise.iter_mut().zip(&line.bits) {
            *noise = self.noise.pick(*bits);
        }
    }

    /// Reckons the disparities of a row.
    fn reckon(&mut self, row: usize) {
        let y = (row as f32 - self.middle_row) / self.focal;
        reckon(&mut self.line, y * y, &self.faults);
    }

    /// What the sensor makes of the disparities of a row, millimetres.
    fn depths(&mut self) -> &[u16] {
        if self.faults.steps {
            let last = self.depth_of_steps.len() as f32;
            let steps = &mut self.line.bits;
            step(&self.line.disparity, steps, last);
            for (depth, step) in self.line.depth.iter_mut().zip(steps) {
                *depth = self.depth_of_steps.get(*step as usize).copied().unwrap_or(0);
            }
        } else {
            for (depth, &disparity) in self.line.depth.iter_mut().zip(&self.line.disparity) {
                *depth = if disparity <= 0.0 { 0 } else { millimetres(FOCAL_BASELINE / disparity, self.faults.range) };
            }
        }
        &self.line.depth[..self.canvas.width]
    }
}

/// Reckons the disparities of a row, `down` being the square of its part of the rays' lengths.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2", "x86_64+sse4.1"))]
fn reckon(line: &mut Line, down: f32, faults: &KinectFaults) {
    let single = (0.4 * faults.loss * 65536.0) as f32;
    let inverses = line.inverse.as_chunks::<LANES>().0.iter().zip(line.responses.as_chunks::<LANES>().0);
    let lengths = line.across.as_chunks::<LANES>().0.iter().zip(line.bits.as_chunks::<LANES>().0);
    let others = line.noise.as_chunks::<LANES>().0.iter().zip(line.blocked.as_chunks::<LANES>().0);
    let groups = inverses.zip(lengths).zip(others).zip(line.disparity.as_chunks_mut::<LANES>().0);
    for ((((inverse, responses), (across, bits)), (noise, blocked)), disparity) in groups {
        let chance = loss(inverse, responses, &std::array::from_fn(|lane| across[lane] + down), faults);
        for lane in 0..LANES {
            let returned = (bits[lane] >> 16) as f32 >= single + 65536.0 * chance[lane];
            let seen = returned & (inverse[lane] > 0.0) & !blocked[lane];
            disparity[lane] = if seen { FOCAL_BASELINE * inverse[lane] + noise[lane] } else { 0.0 };
        }
    }
}

/// Probabilities that faces give no return to pixels whose rays have lengths of the roots of `squares`.
#[inline(always)]
fn loss(
    inverse: &[f32; LANES],
    responses: &[Response; LANES],
    squares: &[f32; LANES],
    faults: &KinectFaults,
) -> [f32; LANES] {
    let mut chance = [0.0; LANES];
    let (mut upright, mut darkness) = ([0.0; LANES], [0.0; LANES]);
    for lane in 0..LANES {
        upright[lane] = responses[lane].plane * inverse[lane];
        darkness[lane] = responses[lane].darkness;
    }
    let grazing: [bool; LANES] =
        std::array::from_fn(|lane| upright[lane] * upright[lane] < 1.01 * GRAZING.0 * GRAZING.0 * squares[lane]);
    // Nearly all faces are seen at no grazing angle and are not dark: roots and divisions are left out for them.
    if faults.grazing && grazing.iter().fold(false, |any, grazing| any | grazing) {
        for lane in 0..LANES {
            let cosine = upright[lane] / squares[lane].sqrt();
            let lost = ((GRAZING.0 - cosine) / (GRAZING.0 - GRAZING.1)).clamp(0.0, 1.0);
            chance[lane] += if grazing[lane] { lost } else { 0.0 };
        }
    }
    if faults.dark && darkness.iter().fold(false, |any, &darkness| any | (darkness > 0.0)) {
        for lane in 0..LANES {
            let lost = darkness[lane] * (1.0 / inverse[lane] - 1.5).max(0.0);
            chance[lane] += if darkness[lane] > 0.0 { lost } else { 0.0 };
        }
    }
    chance
}

/// The step each disparity is rounded to, up to the last.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2", "x86_64+sse4.1"))]
fn step(disparity: &[f32], steps: &mut [u32], last: f32) {
    for (step, disparity) in steps.iter_mut().zip(disparity) {
        *step = whole((STEPS * disparity + 0.5).clamp(0.0, last));
    }
}

/// Millimetres of each disparity step; 0 out of range.
fn depth_of_steps(range: bool) -> Vec<u16> {
    let last = (STEPS * FOCAL_BASELINE / 0.1) as usize;
    (0..=last)
        .map(|step| if step == 0 { 0 } else { millimetres(STEPS * FOCAL_BASELINE / step as f32, range) })
        .collect()
}

/// A depth as the picture has it; 0 out of range, where that counts.
fn millimetres(metres: f32, range: bool) -> u16 {
    let out = range && !(RANGE.0..=RANGE.1).contains(&metres);
    if out { 0 } else { (1000.0 * metres + 0.5).min(65535.0) as u16 }
}

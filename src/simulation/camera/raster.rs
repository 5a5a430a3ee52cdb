//! Which face each pixel shows, and at what depth: a scan-line rasteriser of convex faces.
//!
//! One over depth is linear in the picture, so a row of a face costs one
//! addition and one comparison a pixel. Rows are worked on in groups of
//! [`LANES`] pixels, a whole one also at a run's end: most runs are short, and
//! a loop over what is left would take most of the time. So the canvas is a
//! group longer than the picture.

use std::cell::RefCell;
use std::ops::Range;

use multiversion::multiversion;

use super::faces::{Face, Point};
use crate::frame::Camera;
use crate::geometry::Pose;

/// A camera placed in the world.
pub(super) struct View {
    pub camera: Camera,
    pub eye: Point,
    /// The camera's right, down and ahead in world axes.
    pub axes: [Point; 3],
}

impl View {
    pub fn new(camera: Camera, pose: Pose) -> Self {
        let axes = camera.axes(pose).map(|[x, y, z]| Point::new(x, y, z));
        Self { camera, eye: Point::new(pose.x, pose.y, camera.tower_m), axes }
    }

    /// A direction of the world in camera axes.
    pub fn turned(&self, direction: &Point) -> Point {
        Point::new(self.axes[0].dot(direction), self.axes[1].dot(direction), self.axes[2].dot(direction))
    }

    pub fn centre(&self) -> (f64, f64) {
        ((self.camera.width as f64 - 1.0) / 2.0, (self.camera.height as f64 - 1.0) / 2.0)
    }

    /// A quantity `g·(x, y, 1)` over the ray of a pixel, as coefficients of column, row and one.
    pub fn over_pixels(&self, g: &Point) -> Point {
        let (cx, cy) = self.centre();
        let f = self.camera.focal;
        Point::new(g.x / f, g.y / f, g.z - (g.x * cx + g.y * cy) / f)
    }

    /// Camera optical frame to world, 4 × 4 by rows.
    pub fn world_from_camera(&self) -> [[f64; 4]; 4] {
        let [x, y, z] = &self.axes;
        let row = |i: usize| [x[i], y[i], z[i], self.eye[i]];
        [row(0), row(1), row(2), [0.0, 0.0, 0.0, 1.0]]
    }
}

/// Pixels worked on together.
pub(super) const LANES: usize = 16;

/// Face and inverse depth of every pixel, and of [`LANES`] more that are not in the picture.
#[derive(Default)]
pub(super) struct Canvas {
    pub width: usize,
    pub height: usize,
    /// One over metres along the optical axis; 0 where there is nothing.
    pub inverse: Vec<f32>,
    /// Number of the face + 1; 0 where there is nothing.
    pub face: Vec<u32>,
}

impl Canvas {
    /// Lends an empty canvas: the thread's own, since new memory for each frame takes longer than drawing on it.
    pub fn lend<T>(camera: &Camera, work: impl FnOnce(&mut Self) -> T) -> T {
        thread_local!(static CANVAS: RefCell<Canvas> = RefCell::default());
        CANVAS.with_borrow_mut(|canvas| {
            canvas.clear(camera);
            work(canvas)
        })
    }

    fn clear(&mut self, camera: &Camera) {
        (self.width, self.height) = (camera.width, camera.height);
        let pixels = self.pixels() + LANES;
        self.inverse.clear();
        self.inverse.resize(pixels, 0.0);
        self.face.clear();
        self.face.resize(pixels, 0);
    }

    pub fn pixels(&self) -> usize {
        self.width * self.height
    }

    /// The runs of a row that show one face each, from the left: columns, and the face's number + 1 or 0.
    pub fn runs(&self, row: usize) -> impl Iterator<Item = (Range<usize>, u32)> {
        let line = &self.face[row * self.width..(row + 1) * self.width];
        let mut from = 0;
        std::iter::from_fn(move || {
            let &number = line.get(from)?;
            let run = from..from + leading(&line[from..], number);
            from = run.end;
            Some((run, number))
        })
    }

    /// Draws a face where nothing nearer was drawn.
    pub fn draw(&mut self, view: &View, number: u32, face: &Face) {
        let offset = face.corners[0] - view.eye;
        let plane = face.normal.dot(&offset);
        if plane.abs() < 1e-9 || (plane > 0.0 && !face.two_sided) {
            return;
        }
        let outline = clipped(view, face);
        let Some((low, high)) = self.rows_of(&outline) else { return };
        let inverse = view.over_pixels(&(view.turned(&face.normal) / plane));
        for row in low..high {
            let Some((from, to)) = self.columns_of(&outline, row as f64) else { continue };
            let start = inverse.x * from as f64 + inverse.y * row as f64 + inverse.z;
            let first = row * self.width + from;
            let (depths, faces) = (&mut self.inverse[first..], &mut self.face[first..]);
            draw_span(depths, faces, to - from, start as f32, inverse.x as f32, number);
        }
    }

    /// The rows an outline covers; nothing when it lies outside the picture.
    fn rows_of(&self, outline: &[(f64, f64)]) -> Option<(usize, usize)> {
        let (low, high) = span_of(outline.iter().map(|p| p.1));
        let (left, right) = span_of(outline.iter().map(|p| p.0));
        if outline.len() < 3 || right < 0.0 || left > self.width as f64 {
            return None;
        }
        let (low, high) = (low.ceil().max(0.0), high.ceil().min(self.height as f64));
        (low < high).then_some((low as usize, high as usize))
    }

    /// The columns of a convex outline on a row.
    fn columns_of(&self, outline: &[(f64, f64)], row: f64) -> Option<(usize, usize)> {
        let (mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut last = outline[outline.len() - 1];
        for &next in outline {
            if (last.1 <= row) != (next.1 <= row) {
                let x = last.0 + (row - last.1) * (next.0 - last.0) / (next.1 - last.1);
                left = left.min(x);
                right = right.max(x);
            }
            last = next;
        }
        let (from, to) = (left.ceil().max(0.0), right.ceil().min(self.width as f64));
        (from < to).then_some((from as usize, to as usize))
    }
}

fn span_of(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
}

/// The outline of a face in the picture, cut off before the camera.
fn clipped(view: &View, face: &Face) -> Vec<(f64, f64)> {
    let near = view.camera.near_m;
    let corners: Vec<Point> = face.corners.iter().map(|corner| view.turned(&(corner - view.eye))).collect();
    let (cx, cy) = view.centre();
    let shown = |p: Point| (cx + view.camera.focal * p.x / p.z, cy + view.camera.focal * p.y / p.z);
    let mut outline = Vec::with_capacity(corners.len() + 1);
    for (i, &next) in corners.iter().enumerate() {
        let last = corners[(i + corners.len() - 1) % corners.len()];
        if (last.z < near) != (next.z < near) {
            let share = (near - last.z) / (next.z - last.z);
            outline.push(shown(last + (next - last) * share));
        }
        if next.z >= near {
            outline.push(shown(next));
        }
    }
    outline
}

/// How many values at a list's beginning are the given one.
fn leading(values: &[u32], value: u32) -> usize {
    let alike = |group: &&[u32; LANES]| group.iter().fold(true, |alike, &other| alike & (other == value));
    let start = LANES * values.as_chunks().0.iter().take_while(alike).count();
    start + values[start..].iter().take_while(|&&other| other == value).count()
}

/// Draws the first `count` pixels of what is left of the canvas.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2", "x86_64+sse4.1"))]
fn draw_span(depths: &mut [f32], faces: &mut [u32], count: usize, start: f32, step: f32, number: u32) {
    let groups = count.div_ceil(LANES);
    let (depths, faces) = (depths.as_chunks_mut::<LANES>().0, faces.as_chunks_mut::<LANES>().0);
    for (group, (depths, faces)) in depths.iter_mut().zip(faces).take(groups).enumerate() {
        for lane in 0..LANES {
            let i = (group * LANES + lane) as i32;
            let inverse = start + i as f32 * step;
            let nearer = inverse > depths[lane] && i < count as i32;
            depths[lane] = if nearer { inverse } else { depths[lane] };
            faces[lane] = if nearer { number } else { faces[lane] };
        }
    }
}

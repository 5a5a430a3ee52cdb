//! What was detected, drawn: the colour picture with boxes and labels, the grid map beside it.

use font8x8::legacy::BASIC_LEGACY;

use super::View;
use super::floor_grid::{CELL_M, project};
use super::points::points;
use crate::frame::{RgbdFrame, rgb_png};
use crate::geometry::{Pose, Vec2, vec2};
use crate::record::Detection;

/// Side of a letter, pixels.
const LETTER: f64 = 8.0;
/// Pixels a metre on the map.
const SCALE: f64 = 60.0;
/// One colour for each detection, in turn.
const INKS: [[u8; 3]; 8] = [
    [230, 40, 40],
    [30, 120, 230],
    [20, 160, 60],
    [240, 140, 0],
    [160, 60, 200],
    [0, 170, 180],
    [200, 30, 130],
    [120, 100, 20],
];

/// The overlay of one frame as a PNG file, with a caption.
pub fn overlay(frame: &RgbdFrame, view: &View, caption: &str) -> Vec<u8> {
    let mut canvas = Canvas::new(frame);
    canvas.map(frame);
    for (detection, ink) in view.furniture.iter().zip(INKS.iter().cycle()) {
        canvas.furniture(frame, detection, *ink);
    }
    for object in &view.objects {
        let at = [object.x, object.y, 0.75];
        let label = if object.recognisable { object.name.clone() } else { format!("{}?", object.name) };
        if let Some((x, y)) = pixel(frame, at) {
            canvas.label(x, y, &label, [255, 0, 255]);
        }
        let (x, y) = canvas.on_map(vec2(object.x, object.y));
        canvas.label(x, y, &label, [255, 0, 255]);
    }
    canvas.text(4.0, canvas.height as f64 - LETTER - 4.0, caption, [0; 3]);
    rgb_png(canvas.width, canvas.height, &canvas.pixels)
}

/// Column and row of a point of the world; nothing behind the camera.
fn pixel(frame: &RgbdFrame, point: [f64; 3]) -> Option<(f64, f64)> {
    let m = &frame.world_from_camera;
    let d: Vec<f64> = (0..3).map(|i| point[i] - m[i][3]).collect();
    let [x, y, z] = [0, 1, 2].map(|k| (0..3).map(|i| m[i][k] * d[i]).sum::<f64>());
    let k = frame.intrinsics;
    (z > 0.15).then(|| (k.cx + k.fx * x / z, k.cy + k.fy * y / z))
}

struct Canvas {
    width: usize,
    height: usize,
    pixels: Vec<[u8; 3]>,
    picture: usize,
    /// The camera, which is at the middle of the map's lower edge.
    camera: Pose,
    /// Left, top and width of the labels so far.
    labels: Vec<(f64, f64, f64)>,
}

impl Canvas {
    fn new(frame: &RgbdFrame) -> Self {
        let (width, height) = (frame.width * 2, frame.height);
        let mut pixels = vec![[255; 3]; width * height];
        for (at, target) in (0..frame.depth.len()).map(|at| (at, at / frame.width * width + at % frame.width)) {
            let grey = (f64::from(frame.depth[at]) * frame.depth_unit_m * 40.0).min(255.0) as u8;
            pixels[target] = frame.color.get(at).copied().unwrap_or([grey; 3]);
        }
        Self { width, height, pixels, picture: frame.width, camera: points(frame).camera, labels: Vec::new() }
    }

    /// Floor grey, what stands on it by its height.
    fn map(&mut self, frame: &RgbdFrame) {
        let points = points(frame);
        let grid = project(frame, &points);
        for (index, cell) in grid.cells.iter().enumerate().filter(|(_, cell)| cell.count > 0 || cell.floor > 0) {
            let ink = if cell.count > 0 {
                let t = (cell.top / 2.0).min(1.0);
                [(90.0 + 120.0 * t) as u8, (170.0 - 110.0 * t) as u8, (200.0 - 160.0 * t) as u8]
            } else {
                [232; 3]
            };
            let (x, y) = self.on_map(points.camera.to_world(grid.centre(index)));
            let half = (CELL_M * SCALE / 2.0).ceil() as i64;
            for dy in -half..half {
                for dx in -half..half {
                    self.dot(x as i64 + dx, y as i64 + dy, ink, true);
                }
            }
        }
    }

    fn on_map(&self, place: Vec2) -> (f64, f64) {
        let local = self.camera.to_local(place);
        (self.picture as f64 * 1.5 - local.y * SCALE, self.height as f64 - 8.0 - local.x * SCALE)
    }

    fn furniture(&mut self, frame: &RgbdFrame, detection: &Detection, ink: [u8; 3]) {
        let corners: Vec<[f64; 2]> = detection.footprint.clone();
        for (i, a) in corners.iter().enumerate() {
            let b = corners[(i + 1) % corners.len()];
            let edge = |z0: f64, z1: f64, to: [f64; 2]| ([a[0], a[1], z0], [to[0], to[1], z1]);
            let h = detection.height;
            for (from, to) in [edge(0.0, 0.0, b), edge(h, h, b), edge(0.0, h, *a)] {
                if let (Some(from), Some(to)) = (pixel(frame, from), pixel(frame, to)) {
                    self.line(from, to, ink, false);
                }
            }
            self.line(self.on_map(vec2(a[0], a[1])), self.on_map(vec2(b[0], b[1])), ink, true);
        }
        let middle = vec2(detection.x, detection.y);
        if let Some(yaw) = detection.yaw {
            let tip = middle + vec2(yaw.cos(), yaw.sin()) * (detection.length / 2.0 + 0.15);
            self.line(self.on_map(middle), self.on_map(tip), ink, true);
        }
        let label = format!("{} {:.0}%", detection.category, 100.0 * detection.confidence);
        if let Some((x, y)) = pixel(frame, [detection.x, detection.y, detection.height]) {
            let right = (self.picture as f64 - LETTER * label.len() as f64).max(0.0);
            self.label(x.clamp(0.0, right), y.min(self.height as f64 - 2.0 * LETTER).max(2.0), &label, ink);
        }
        let (x, y) = self.on_map(middle);
        self.label(x, y, &label, ink);
    }

    fn dot(&mut self, x: i64, y: i64, ink: [u8; 3], on_map: bool) {
        let (low, high) = if on_map { (self.picture as i64, self.width as i64) } else { (0, self.picture as i64) };
        if (low..high).contains(&x) && (0..self.height as i64).contains(&y) {
            self.pixels[y as usize * self.width + x as usize] = ink;
        }
    }

    fn line(&mut self, from: (f64, f64), to: (f64, f64), ink: [u8; 3], on_map: bool) {
        let steps = (to.0 - from.0).abs().max((to.1 - from.1).abs()).clamp(1.0, 4000.0) as usize;
        for i in 0..=steps {
            let t = i as f64 / steps as f64;
            let (x, y) = ((from.0 + (to.0 - from.0) * t) as i64, (from.1 + (to.1 - from.1) * t) as i64);
            [(0, 0), (1, 0), (0, 1)].iter().for_each(|(dx, dy)| self.dot(x + dx, y + dy, ink, on_map));
        }
    }

    /// A label at a place, or below it where others stand already.
    fn label(&mut self, x: f64, y: f64, text: &str, ink: [u8; 3]) {
        let width = LETTER * text.chars().count() as f64;
        let covers = |y: f64, (left, top, wide): &(f64, f64, f64)| {
            x < left + wide && *left < x + width && (y - top).abs() < LETTER + 1.0
        };
        let rows = (0..20).map(|row| y + f64::from(row) * (LETTER + 1.0));
        let free = rows.into_iter().find(|y| !self.labels.iter().any(|label| covers(*y, label))).unwrap_or(y);
        self.labels.push((x, free, width));
        self.text(x, free, text, ink);
    }

    /// Letters of 8 pixels on a white ground.
    fn text(&mut self, x: f64, y: f64, text: &str, ink: [u8; 3]) {
        let on_map = x >= self.picture as f64;
        for (i, letter) in text.chars().enumerate() {
            let glyph = BASIC_LEGACY.get(letter as usize).copied().unwrap_or([0; 8]);
            for (row, bits) in glyph.iter().enumerate() {
                for bit in 0..8 {
                    let shade = if bits >> bit & 1 == 1 { ink } else { [255; 3] };
                    self.dot(x as i64 + (i * 8 + bit) as i64, y as i64 + row as i64, shade, on_map);
                }
            }
        }
    }
}

//! Depth pixels projected onto a grid over the floor: how high each cell reaches, and at which heights it is filled.

use crate::frame::RgbdFrame;
use crate::geometry::{Vec2, vec2};

/// Side of a cell, metres.
pub const CELL_M: f64 = 0.025;
/// Lower than this is floor, higher is ceiling, metres.
const FLOOR_M: f64 = 0.07;
const CEILING_M: f64 = 2.3;
/// A cell that reaches above this is wall: no furniture of a home does, bar a few wardrobes.
pub const WALL_M: f64 = 2.05;
/// Beyond this the sensor's depth steps are coarser than furniture, metres.
const FARTHEST_M: f64 = 6.5;
/// Every so many-th pixel is read, along both sides.
const STRIDE: usize = 2;

/// One cell.
#[derive(Clone, Copy, Debug, Default)]
pub struct CellStack {
    /// Pixels.
    pub count: u32,
    /// The highest point, metres.
    pub top: f32,
    /// Bit i is set when something lies between i and i + 1 decimetres.
    pub slices: u32,
}

/// The grid, spanning all pixels of one frame.
#[derive(Clone, Debug)]
pub struct FloorGrid {
    /// Corner of the first cell, metres.
    pub low: Vec2,
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Row by row.
    pub cells: Vec<CellStack>,
}

/// Projects a depth picture; nothing when no pixel lies between floor and ceiling.
pub fn project(frame: &RgbdFrame) -> Option<FloorGrid> {
    let points = points(frame);
    let start = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY));
    let (low, high) = points.iter().fold(start, |(low, high), (p, _)| (low.inf(p), high.sup(p)));
    if points.is_empty() {
        return None;
    }
    let size = (high - low) / CELL_M;
    let (width, height) = (size.x as usize + 1, size.y as usize + 1);
    let mut grid = FloorGrid { low, width, height, cells: vec![CellStack::default(); width * height] };
    for (point, z) in points {
        let at = (point - low) / CELL_M;
        let cell = &mut grid.cells[at.y as usize * width + at.x as usize];
        cell.count += 1;
        cell.top = cell.top.max(z as f32);
        cell.slices |= 1 << (z * 10.0) as u32;
    }
    Some(grid)
}

/// Place on the floor and height of each pixel between floor and ceiling.
fn points(frame: &RgbdFrame) -> Vec<(Vec2, f64)> {
    let [rx, ry, rz, _] = frame.world_from_camera;
    let mut points = Vec::with_capacity(frame.depth.len() / (STRIDE * STRIDE));
    for row in (0..frame.height).step_by(STRIDE) {
        let down = (row as f64 - frame.intrinsics.cy) / frame.intrinsics.fy;
        for column in (0..frame.width).step_by(STRIDE) {
            let z = f64::from(frame.depth[row * frame.width + column]) * frame.depth_unit_m;
            if z <= 0.0 || z > FARTHEST_M {
                continue;
            }
            let (x, y) = ((column as f64 - frame.intrinsics.cx) / frame.intrinsics.fx * z, down * z);
            let height = rz[0] * x + rz[1] * y + rz[2] * z + rz[3];
            if (FLOOR_M..CEILING_M).contains(&height) {
                let place = vec2(rx[0] * x + rx[1] * y + rx[2] * z + rx[3], ry[0] * x + ry[1] * y + ry[2] * z + ry[3]);
                points.push((place, height));
            }
        }
    }
    points
}

impl FloorGrid {
    /// The middle of a cell, metres.
    pub fn centre(&self, index: usize) -> Vec2 {
        self.low + vec2((index % self.width) as f64 + 0.5, (index / self.width) as f64 + 0.5) * CELL_M
    }

    /// Connected groups of furniture cells, largest first. Cells one apart belong together: depth has holes.
    pub fn components(&self) -> Vec<Vec<usize>> {
        let solid: Vec<bool> = self.cells.iter().map(|cell| cell.count > 0 && f64::from(cell.top) < WALL_M).collect();
        let mut seen = vec![false; self.cells.len()];
        let mut components = Vec::new();
        for start in 0..self.cells.len() {
            if solid[start] && !seen[start] {
                components.push(self.flood(start, &solid, &mut seen));
            }
        }
        components.sort_by_key(|cells| std::cmp::Reverse(cells.len()));
        components
    }

    fn flood(&self, start: usize, solid: &[bool], seen: &mut [bool]) -> Vec<usize> {
        const REACH: i64 = 2;
        let mut component = Vec::new();
        let mut waiting = vec![start];
        seen[start] = true;
        while let Some(cell) = waiting.pop() {
            component.push(cell);
            let (x, y) = ((cell % self.width) as i64, (cell / self.width) as i64);
            for dy in -REACH..=REACH {
                for dx in -REACH..=REACH {
                    let (nx, ny) = (x + dx, y + dy);
                    if nx < 0 || ny < 0 || nx >= self.width as i64 || ny >= self.height as i64 {
                        continue;
                    }
                    let next = ny as usize * self.width + nx as usize;
                    if solid[next] && !seen[next] {
                        seen[next] = true;
                        waiting.push(next);
                    }
                }
            }
        }
        component
    }
}

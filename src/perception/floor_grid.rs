//! Points projected onto a grid over the floor: how high each cell reaches, at which heights it is filled, its colour.

use super::points::{FARTHEST_M, Points, STRIDE};
use crate::frame::RgbdFrame;
use crate::geometry::{Vec2, vec2};

/// Side of a cell, metres.
pub const CELL_M: f64 = 0.025;
/// Higher is ceiling, metres.
const CEILING_M: f32 = 2.32;
/// A pixel that lies in no cell.
pub const NOWHERE: u32 = u32::MAX;

/// One cell.
#[derive(Clone, Copy, Debug, Default)]
pub struct CellStack {
    /// Points between floor and ceiling.
    pub count: u16,
    /// Points on the floor.
    pub floor: u16,
    /// The highest point, metres.
    pub top: f32,
    /// Bit i is set when something lies between i and i + 1 decimetres.
    pub slices: u32,
    /// Sums of red, green and blue over its points.
    pub color: [u32; 3],
}

/// The grid over the floor before the camera: columns run to the left, rows ahead.
#[derive(Clone, Debug)]
pub struct FloorGrid {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Row by row.
    pub cells: Vec<CellStack>,
    /// The cell of each sampled pixel that lies between floor and ceiling.
    pub cell_of: Vec<u32>,
}

/// Lower than this is floor, metres: the depth noise lifts the far floor.
pub fn floor_reach(range: f32) -> f32 {
    0.05 + 0.0018 * range * range
}

/// Projects the points of a frame.
pub fn project(frame: &RgbdFrame, points: &Points) -> FloorGrid {
    let half = (FARTHEST_M * points.spread.min(1.5)) as f64 + 0.1;
    let (width, height) = ((2.0 * half / CELL_M) as usize, (f64::from(FARTHEST_M) / CELL_M) as usize + 2);
    let mut grid = FloorGrid {
        width,
        height,
        cells: vec![CellStack::default(); width * height],
        cell_of: vec![NOWHERE; points.xyz.len()],
    };
    let (inverse, shift) = ((1.0 / CELL_M) as f32, half as f32);
    for row in 0..points.rows {
        for column in 0..points.columns {
            let at = row * points.columns + column;
            let [x, y, z] = points.xyz[at];
            let (along, across) = (x * inverse, (y + shift) * inverse);
            if x <= 0.0 || z > CEILING_M || across < 0.0 || across >= width as f32 || along >= height as f32 {
                continue;
            }
            let index = along as usize * width + across as usize;
            let cell = &mut grid.cells[index];
            if z < floor_reach(x) {
                cell.floor = cell.floor.saturating_add(1);
                continue;
            }
            cell.count = cell.count.saturating_add(1);
            cell.top = cell.top.max(z);
            cell.slices |= 1 << (z * 10.0) as u32;
            grid.cell_of[at] = index as u32;
            if let Some(color) = frame.color.get((row * frame.width + column) * STRIDE) {
                (0..3).for_each(|c| cell.color[c] += u32::from(color[c]));
            }
        }
    }
    grid
}

impl FloorGrid {
    /// The middle of a cell, metres ahead and to the left of the camera.
    pub fn centre(&self, index: usize) -> Vec2 {
        let across = (index % self.width) as f64 + 0.5 - self.width as f64 / 2.0;
        vec2(((index / self.width) as f64 + 0.5) * CELL_M, across * CELL_M)
    }

    /// The cell at a place, when it lies on the grid.
    pub fn index(&self, place: Vec2) -> Option<usize> {
        let (along, across) = (place.x / CELL_M, place.y / CELL_M + self.width as f64 / 2.0);
        let inside = along >= 0.0 && across >= 0.0 && along < self.height as f64 && across < self.width as f64;
        inside.then(|| along as usize * self.width + across as usize)
    }

    /// The cells within `reach` rows and columns of one, itself among them.
    pub fn around(&self, index: usize, reach: usize) -> impl Iterator<Item = usize> + use<> {
        let (x, y) = (index % self.width, index / self.width);
        let (width, height) = (self.width, self.height);
        (y.saturating_sub(reach)..=(y + reach).min(height - 1))
            .flat_map(move |row| (x.saturating_sub(reach)..=(x + reach).min(width - 1)).map(move |c| row * width + c))
    }

    /// Whether floor was seen at a place or beside it.
    pub fn shows_floor(&self, place: Vec2) -> bool {
        self.index(place).is_some_and(|at| self.around(at, 1).any(|cell| self.cells[cell].floor > 0))
    }
}

//! The grid cut into patches: connected cells that reach about equally high.

use super::floor_grid::{CELL_M, FloorGrid};
use crate::geometry::{Vec2, vec2};

/// Neighbouring cells whose tops differ by more are different surfaces, metres.
const STEP_M: f32 = 0.045;
/// A patch that belongs to no cell.
pub const NONE: u32 = u32::MAX;

/// Connected cells of about equal height, or several such joined.
#[derive(Clone, Debug, Default)]
pub struct Patch {
    /// Indices into the grid.
    pub cells: Vec<u32>,
    /// What is summed over them.
    pub sums: Sums,
}

/// Sums over cells: they add when patches are joined.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sums {
    /// Cells.
    pub count: f64,
    /// Places.
    pub place: Vec2,
    /// Products of places: xx, xy, yy.
    pub products: [f64; 3],
    /// Tops and their squares.
    pub top: [f64; 2],
    /// Tenths of a metre that are filled, and those that could be.
    pub filled: [f64; 2],
    /// Points, and their red, green, blue.
    pub color: [f64; 4],
}

impl Sums {
    /// Adds one cell.
    pub fn add_cell(&mut self, grid: &FloorGrid, index: usize) {
        let cell = &grid.cells[index];
        let (place, top) = (grid.centre(index), f64::from(cell.top));
        self.count += 1.0;
        self.place += place;
        self.products[0] += place.x * place.x;
        self.products[1] += place.x * place.y;
        self.products[2] += place.y * place.y;
        self.top[0] += top;
        self.top[1] += top * top;
        self.filled[0] += f64::from(cell.slices.count_ones());
        self.filled[1] += (top * 10.0).ceil();
        self.color[0] += f64::from(cell.count);
        (0..3).for_each(|c| self.color[c + 1] += f64::from(cell.color[c]));
    }

    /// The sums over both.
    pub fn joined(mut self, other: &Self) -> Self {
        self.count += other.count;
        self.place += other.place;
        (0..3).for_each(|i| self.products[i] += other.products[i]);
        (0..2).for_each(|i| self.top[i] += other.top[i]);
        (0..2).for_each(|i| self.filled[i] += other.filled[i]);
        (0..4).for_each(|i| self.color[i] += other.color[i]);
        self
    }

    /// The middle.
    pub fn middle(&self) -> Vec2 {
        self.place / self.count
    }

    /// Mean top and its deviation, metres.
    pub fn top(&self) -> (f64, f64) {
        let mean = self.top[0] / self.count;
        (mean, (self.top[1] / self.count - mean * mean).max(0.0).sqrt())
    }

    /// Mean red, green, blue, 0 to 1.
    pub fn color(&self) -> [f64; 3] {
        [1, 2, 3].map(|c| self.color[c] / self.color[0].max(1.0) / 255.0)
    }

    /// Sides of the rectangle with the same second moments, long and short, metres.
    pub fn sides(&self) -> (f64, f64) {
        let m = self.middle();
        let n = self.count;
        let [xx, xy, yy] = self.products;
        let (xx, xy, yy) = (xx / n - m.x * m.x, xy / n - m.x * m.y, yy / n - m.y * m.y);
        let (half, root) = ((xx + yy) / 2.0, (((xx - yy) / 2.0).powi(2) + xy * xy).sqrt());
        let side = |moment: f64| (12.0 * moment.max(0.0)).sqrt() + CELL_M;
        (side(half + root), side(half - root))
    }

    /// Square metres of cells.
    pub fn area(&self) -> f64 {
        self.count * CELL_M * CELL_M
    }
}

/// The patches of the furniture cells, and the patch of each cell.
pub fn patches(grid: &FloorGrid, furniture: &[bool]) -> (Vec<Patch>, Vec<u32>) {
    let mut patch_of = vec![NONE; grid.cells.len()];
    let mut patches = Vec::new();
    let mut waiting = Vec::new();
    for start in 0..grid.cells.len() {
        if !furniture[start] || patch_of[start] != NONE {
            continue;
        }
        let number = patches.len() as u32;
        let mut patch = Patch::default();
        patch_of[start] = number;
        waiting.push(start);
        while let Some(index) = waiting.pop() {
            patch.cells.push(index as u32);
            patch.sums.add_cell(grid, index);
            let top = grid.cells[index].top;
            for next in grid.around(index, 1) {
                if furniture[next] && patch_of[next] == NONE && (grid.cells[next].top - top).abs() < STEP_M {
                    patch_of[next] = number;
                    waiting.push(next);
                }
            }
        }
        patches.push(patch);
    }
    (patches, patch_of)
}

/// How far apart cells of one surface may lie, in cells: farther off, the depth steps are wider.
pub fn reach(place: Vec2) -> usize {
    let range = place.norm();
    if range < 2.5 {
        2
    } else if range < 4.2 {
        3
    } else {
        4
    }
}

/// The place between two.
pub fn between(a: Vec2, b: Vec2, share: f64) -> Vec2 {
    vec2(a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share)
}

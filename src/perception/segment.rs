//! Pieces: the joined patches of one frame, with the pixels they fill.

use super::floor_grid::{FloorGrid, NOWHERE};
use super::patches::{NONE, Sums};
use super::points::Points;
use super::rectangle::{Rectangle, closest_rectangle};
use crate::geometry::Vec2;

/// Fewer cells are clutter, about 12 × 12 cm.
pub const LEAST_CELLS: usize = 24;
/// Lower is a rug or a shoe, metres.
const LEAST_HEIGHT_M: f64 = 0.22;

/// One connected thing on the floor, in the camera's frame.
#[derive(Clone, Debug)]
pub struct Segment {
    /// Indices into the grid.
    pub cells: Vec<u32>,
    /// What is summed over them.
    pub sums: Sums,
    /// Places of the cells that border on others.
    pub outline: Vec<Vec2>,
    /// The rectangle of what is seen.
    pub rectangle: Rectangle,
    /// The tops, sorted, metres.
    pub tops: Vec<f32>,
    /// Its sampled pixels.
    pub pixels: Pixels,
}

/// Sampled pixels of a piece in the picture.
#[derive(Clone, Copy, Debug)]
pub struct Pixels {
    /// All.
    pub count: u32,
    /// Those at the left, right, upper and lower edge of the picture.
    pub at_edge: [u32; 4],
    /// First and last column, first and last row.
    pub bounds: [u32; 4],
}

/// The pieces of a frame, and the piece of each cell.
pub struct Segments {
    /// Largest first.
    pub pieces: Vec<Segment>,
    /// Number of the piece, or none.
    pub piece_of: Vec<u32>,
}

/// Keeps what is large enough to be furniture.
pub fn segments(grid: &FloorGrid, points: &Points, groups: Vec<(Vec<u32>, Sums)>) -> Segments {
    let mut piece_of = vec![NONE; grid.cells.len()];
    let mut large: Vec<(Vec<u32>, Sums)> = groups.into_iter().filter(|g| g.0.len() >= LEAST_CELLS).collect();
    large.sort_by_key(|(cells, _)| (std::cmp::Reverse(cells.len()), cells[0]));
    let mut pieces = Vec::new();
    for (mut cells, sums) in large {
        cells.sort_unstable();
        let number = pieces.len() as u32;
        cells.iter().for_each(|cell| piece_of[*cell as usize] = number);
        let is_own = |cell: usize| piece_of.get(cell) == Some(&number);
        match segment(grid, is_own, &cells, sums, Pixels::default()) {
            Some(piece) => pieces.push(piece),
            None => cells.iter().for_each(|cell| piece_of[*cell as usize] = NONE),
        }
    }
    let pixels = group_pixels(grid, points, &piece_of, pieces.len());
    pieces.iter_mut().zip(pixels).for_each(|(piece, pixels)| piece.pixels = pixels);
    Segments { pieces, piece_of }
}

/// A piece of sorted cells; nothing for what is too low or has no extent.
pub fn segment(
    grid: &FloorGrid,
    is_own: impl Fn(usize) -> bool,
    cells: &[u32],
    sums: Sums,
    pixels: Pixels,
) -> Option<Segment> {
    let mut tops: Vec<f32> = cells.iter().map(|cell| grid.cells[*cell as usize].top).collect();
    tops.sort_by(f32::total_cmp);
    if f64::from(tops[tops.len() * 97 / 100]) < LEAST_HEIGHT_M {
        return None;
    }
    let borders = |cell: &&u32| {
        let at = **cell as usize;
        let beside = [at.wrapping_sub(1), at + 1, at.wrapping_sub(grid.width), at + grid.width];
        beside.iter().any(|next| !is_own(*next))
    };
    let outline: Vec<Vec2> = cells.iter().filter(borders).map(|cell| grid.centre(*cell as usize)).collect();
    let rectangle = closest_rectangle(&outline)?;
    Some(Segment { cells: cells.to_vec(), sums, outline, rectangle, tops, pixels })
}

/// The pixels of each of so many groups of cells.
pub fn group_pixels(grid: &FloorGrid, points: &Points, group_of: &[u32], groups: usize) -> Vec<Pixels> {
    let mut all = vec![Pixels::default(); groups];
    let last = [points.columns - 1, points.rows - 1];
    for (row, line) in grid.cell_of.chunks_exact(points.columns).enumerate() {
        let [above, below] = [row < 2, row + 2 > last[1]].map(u32::from);
        for (column, cell) in line.iter().enumerate().filter(|(_, cell)| **cell != NOWHERE) {
            let Some(pixels) = all.get_mut(group_of[*cell as usize] as usize) else { continue };
            let at_edge = [u32::from(column < 2), u32::from(column + 2 > last[0]), above, below];
            let (c, r) = (column as u32, row as u32);
            *pixels = pixels.joined(&Pixels { count: 1, at_edge, bounds: [c, c, r, r] });
        }
    }
    all
}

impl Default for Pixels {
    fn default() -> Self {
        Self { count: 0, at_edge: [0; 4], bounds: [u32::MAX, 0, u32::MAX, 0] }
    }
}

impl Pixels {
    /// Those of both.
    pub fn joined(&self, other: &Self) -> Self {
        let ([left, right, above, below], [l, r, a, b]) = (self.bounds, other.bounds);
        Self {
            count: self.count + other.count,
            at_edge: [0, 1, 2, 3].map(|i| self.at_edge[i] + other.at_edge[i]),
            bounds: [left.min(l), right.max(r), above.min(a), below.max(b)],
        }
    }
}

impl Segment {
    /// The top below which a share of the cells ends, metres.
    pub fn top_at(&self, share: f64) -> f64 {
        let last = self.tops.len() - 1;
        f64::from(self.tops[((share * last as f64).round() as usize).min(last)])
    }

    /// Metres above the floor.
    pub fn height(&self) -> f64 {
        self.top_at(0.975)
    }
}

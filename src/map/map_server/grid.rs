//! The occupancy grid of a `map_server` image.

use std::path::Path;

use super::image::Image;
use super::mode::{CellState, Thresholds};
use crate::geometry::{ClearanceGrid, Polygon, Vec2, distance_to_segment, vec2};
use crate::limits::{HOME_INNER_WALLS, PICTURE_FILE_BYTES};

/// A cell this near to a room's outline belongs to its wall, metres.
const WALL_M: f64 = 0.25;

/// Cells by column and row, row 0 at the south.
pub(super) struct Grid {
    pub width: usize,
    pub height: usize,
    pub cell_m: f64,
    origin: Vec2,
    cells: Vec<CellState>,
}

impl Grid {
    /// Reads the image of a grid whose cells are `cell_m` metres wide.
    ///
    /// # Errors
    /// When the image cannot be read or is none.
    pub fn read(path: &Path, cell_m: f64, origin: Vec2, thresholds: Thresholds) -> Result<Self, String> {
        let bytes = PICTURE_FILE_BYTES.read(path).map_err(|error| error.to_string())?;
        let Image { width, height, pixels } = Image::decode(&bytes)?;
        let rows = (0..height).rev();
        let cells = rows.flat_map(|row| &pixels[row * width..(row + 1) * width]).map(|&pixel| thresholds.state(pixel));
        Ok(Self { width, height, cell_m, origin, cells: cells.collect() })
    }

    /// What the cell is that holds a point; outside the image nothing is known.
    pub fn at(&self, point: Vec2) -> CellState {
        let p = (point - self.origin) / self.cell_m;
        let inside = p.x >= 0.0 && p.y >= 0.0 && (p.x as usize) < self.width && (p.y as usize) < self.height;
        if inside { self.cells[p.y as usize * self.width + p.x as usize] } else { CellState::Unknown }
    }

    pub fn centre(&self, x: usize, y: usize) -> Vec2 {
        self.origin + vec2(x as f64 + 0.5, y as f64 + 0.5) * self.cell_m
    }

    fn cells(&self, wanted: CellState) -> impl Iterator<Item = (usize, usize)> + '_ {
        (0..self.cells.len()).filter(move |&i| self.cells[i] == wanted).map(|i| (i % self.width, i / self.width))
    }

    /// The box of all free cells, metres.
    pub fn free_box(&self) -> Option<(Vec2, Vec2)> {
        let half = Vec2::repeat(self.cell_m / 2.0);
        self.cells(CellState::Free).map(|(x, y)| self.centre(x, y)).fold(None, |found, at| {
            let (low, high) = found.unwrap_or((at, at));
            Some((low.inf(&(at - half)), high.sup(&(at + half))))
        })
    }

    /// Distances to what is not free.
    pub fn clearance(&self, reach_m: f64) -> ClearanceGrid {
        let high = self.origin + vec2(self.width as f64, self.height as f64) * self.cell_m;
        let mut clearance = ClearanceGrid::new(self.origin, high, self.cell_m, reach_m);
        // The grid may have one more column or row where the size is no round number.
        clearance.add_cells(|x, y| {
            x < self.width && y < self.height && self.state(x, y) != CellState::Free && self.borders_free(x, y)
        });
        clearance
    }

    fn state(&self, x: usize, y: usize) -> CellState {
        self.cells[y * self.width + x]
    }

    fn borders_free(&self, x: usize, y: usize) -> bool {
        let beside = [(x + 1, y), (x.wrapping_sub(1), y), (x, y + 1), (x, y.wrapping_sub(1))];
        let inside = beside.into_iter().filter(|&(x, y)| x < self.width && y < self.height);
        inside.into_iter().any(|(x, y)| self.state(x, y) == CellState::Free)
    }

    /// The place within an outline that is farthest from everything.
    pub fn roomiest_within(&self, outline: &[[f64; 2]]) -> Option<Vec2> {
        let room = Polygon::new(outline.iter().map(|&[x, y]| vec2(x, y)).collect());
        let clearance = self.clearance(1.0);
        let free = self.cells(CellState::Free).map(|(x, y)| self.centre(x, y)).filter(|at| room.contains(*at));
        let near = |at: &Vec2| clearance.clearance(clearance.cell(*at));
        free.max_by(|a, b| near(a).total_cmp(&near(b)))
    }

    /// What is occupied inside the rooms and no part of their walls, as segments: a row of cells each.
    pub fn walls_away_from(&self, outlines: &[Vec<[f64; 2]>]) -> Vec<[[f64; 2]; 2]> {
        let rooms: Vec<Polygon> =
            outlines.iter().map(|o| Polygon::new(o.iter().map(|&[x, y]| vec2(x, y)).collect())).collect();
        let boxes: Vec<(Vec2, Vec2)> = rooms.iter().map(Polygon::bounds).collect();
        let inner = |at: Vec2| {
            let margin = Vec2::repeat(WALL_M);
            let near = |(low, high): &(Vec2, Vec2)| at >= low - margin && at <= high + margin;
            let near: Vec<&Polygon> = rooms.iter().zip(&boxes).filter(|(_, b)| near(b)).map(|(room, _)| room).collect();
            let edge =
                |room: &Polygon| room.edges().map(|(a, b)| distance_to_segment(at, a, b)).fold(f64::INFINITY, f64::min);
            near.iter().any(|room| room.contains(at)) && near.iter().all(|room| edge(room) > WALL_M)
        };
        let half = self.cell_m / 2.0;
        let mut walls: Vec<[[f64; 2]; 2]> = Vec::new();
        for (x, y) in self.cells(CellState::Occupied).filter(|&(x, y)| inner(self.centre(x, y))) {
            let at = self.centre(x, y);
            let too_many = walls.len() > HOME_INNER_WALLS.count();
            match walls.last_mut() {
                // The next cell of the same row lengthens the segment.
                Some([_, end]) if end[1] == at.y && (at.x - half - end[0]).abs() < 1e-6 => end[0] = at.x + half,
                // The check of the map says how many are too many.
                _ if too_many => break,
                _ => walls.push([[at.x - half, at.y], [at.x + half, at.y]]),
            }
        }
        walls
    }
}

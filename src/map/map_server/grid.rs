//! The occupancy grid of a `map_server` image.

use std::path::Path;

use zune_ppm::PPMDecoder;
use zune_ppm::zune_core::bytestream::ZCursor;
use zune_ppm::zune_core::result::DecodingResult;

use crate::geometry::{ClearanceGrid, Polygon, Pose, Vec2, distance_to_segment, vec2};
use crate::limits::MAP_CELLS;

/// A cell this near to a room's outline belongs to its wall, metres.
const WALL_M: f64 = 0.25;

/// From which shares of darkness on a cell is occupied, and free.
#[derive(Clone, Copy, Debug)]
pub(super) struct Thresholds {
    pub occupied: f64,
    pub free: f64,
    pub negate: bool,
}

/// What a cell is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CellState {
    Free,
    Occupied,
    Unknown,
}

/// Cells by column and row, row 0 at the south.
pub(super) struct Grid {
    pub width: usize,
    pub height: usize,
    pub cell_m: f64,
    origin: Vec2,
    cells: Vec<CellState>,
}

impl Grid {
    pub fn read(path: &Path, cell_m: f64, origin: Vec2, thresholds: Thresholds) -> Result<Self, String> {
        let bytes = std::fs::read(path).map_err(|error| error.to_string())?;
        let mut decoder = PPMDecoder::new(ZCursor::new(bytes.as_slice()));
        let unreadable = |what: String| format!("not a binary PGM (P5) that can be read: {what}");
        decoder.decode_headers().map_err(|error| unreadable(format!("{error:?}")))?;
        let (width, height) = decoder.dimensions().ok_or_else(|| unreadable("no size".to_string()))?;
        MAP_CELLS.check(width.saturating_mul(height)).map_err(|error| format!("{error}; scale the map down"))?;
        let levels: Vec<f64> = match decoder.decode().map_err(|error| unreadable(format!("{error:?}")))? {
            DecodingResult::U8(levels) => levels.iter().map(|&level| f64::from(level) / 255.0).collect(),
            DecodingResult::U16(levels) => levels.iter().map(|&level| f64::from(level) / 65535.0).collect(),
            _ => return Err(unreadable("not 8 or 16 bits a pixel".to_string())),
        };
        if levels.len() != width * height {
            return Err(unreadable("it has colours; save it as grey levels".to_string()));
        }
        let rows = (0..height).rev();
        let cells = rows.flat_map(|row| &levels[row * width..(row + 1) * width]).map(|&level| state(level, thresholds));
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
        for y in 0..self.height {
            for x in 0..self.width {
                if self.at(self.centre(x, y)) != CellState::Free && self.borders_free(x, y) {
                    let at = self.centre(x, y);
                    clearance.add_polygon(&Polygon::rectangle(Pose::new(at.x, at.y, 0.0), self.cell_m, self.cell_m));
                }
            }
        }
        clearance
    }

    fn borders_free(&self, x: usize, y: usize) -> bool {
        let steps = [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)];
        steps.iter().any(|&(dx, dy)| self.at(self.centre(x, y) + vec2(dx, dy) * self.cell_m) == CellState::Free)
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
        let inner = |at: Vec2| {
            let edge =
                |room: &Polygon| room.edges().map(|(a, b)| distance_to_segment(at, a, b)).fold(f64::INFINITY, f64::min);
            rooms.iter().any(|room| room.contains(at)) && rooms.iter().all(|room| edge(room) > WALL_M)
        };
        let half = self.cell_m / 2.0;
        let mut walls: Vec<[[f64; 2]; 2]> = Vec::new();
        for (x, y) in self.cells(CellState::Occupied).filter(|&(x, y)| inner(self.centre(x, y))) {
            let at = self.centre(x, y);
            match walls.last_mut() {
                // The next cell of the same row lengthens the segment.
                Some([_, end]) if end[1] == at.y && (at.x - half - end[0]).abs() < 1e-6 => end[0] = at.x + half,
                _ => walls.push([[at.x - half, at.y], [at.x + half, at.y]]),
            }
        }
        walls
    }
}

fn state(level: f64, thresholds: Thresholds) -> CellState {
    let dark = if thresholds.negate { level } else { 1.0 - level };
    if dark > thresholds.occupied {
        CellState::Occupied
    } else if dark < thresholds.free {
        CellState::Free
    } else {
        CellState::Unknown
    }
}

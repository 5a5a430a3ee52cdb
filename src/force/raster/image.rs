//! A raster object: cells with membership.

use crate::geometry::{Vec2, vec2};
use crate::limits::RASTER_CELLS;

/// An object as a grid of cells, row 0 on top, each with a membership from 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    width: usize,
    height: usize,
    levels: Vec<u8>,
    /// The level that means full membership.
    full: u8,
    cell: f64,
}

/// What keeps a grid from being a raster object, or two of them from being compared.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RasterError {
    /// No row, no column, or no cell with membership.
    #[error("the grid is empty; mark at least one cell")]
    Empty,
    /// A row of another length.
    #[error("row {row} has {found} cells where the first row has {expected}; make all rows equally long")]
    Ragged {
        /// 1-based.
        row: usize,
        /// Its cells.
        found: usize,
        /// Cells of the first row.
        expected: usize,
    },
    /// A character that means nothing.
    #[error(
        "row {row}, column {column}: `{found}` is no cell; use `.` or a space for outside, `#` for inside, 0–9 for membership"
    )]
    Character {
        /// 1-based.
        row: usize,
        /// 1-based.
        column: usize,
        /// The character.
        found: char,
    },
    /// Cells without a size.
    #[error("the cell size {0} is not a positive number of metres")]
    Cell(f64),
    /// Too many cells.
    #[error("{width} × {height} cells are more than {}; use larger cells or cut out the part that matters", RASTER_CELLS.value)]
    TooManyCells {
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// Levels that do not fill the grid.
    #[error("{found} levels for a grid of {width} × {height} cells")]
    Count {
        /// Levels given.
        found: usize,
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// Two grids of different extent.
    #[error("the grids have {0} × {1} and {2} × {3} cells; both objects must lie on one grid")]
    DifferentSizes(usize, usize, usize, usize),
    /// Two grids of different resolution.
    #[error("the cells measure {0} m and {1} m; both objects must lie on one grid")]
    DifferentCells(f64, f64),
}

impl Raster {
    /// A raster from rows of characters, top row first: `.` or a space is outside, `#` inside, digits 0–9 give
    /// membership in ninths. `cell` is a cell's side in metres.
    ///
    /// # Errors
    /// [`RasterError`] says which row, column or number is wrong.
    pub fn from_rows(rows: &[impl AsRef<str>], cell: f64) -> Result<Self, RasterError> {
        let width = rows.first().map_or(0, |row| row.as_ref().chars().count());
        require_few(width, rows.len())?;
        let mut levels = Vec::with_capacity(width * rows.len());
        for (r, row) in rows.iter().enumerate() {
            let start = levels.len();
            for (c, found) in row.as_ref().chars().enumerate() {
                levels.push(ninths(found).ok_or(RasterError::Character { row: r + 1, column: c + 1, found })?);
            }
            if levels.len() - start != width {
                return Err(RasterError::Ragged { row: r + 1, found: levels.len() - start, expected: width });
            }
        }
        Self::from_levels(width, rows.len(), levels, 9, cell)
    }

    /// A raster from levels, row by row from the top; `full` is the level of full membership.
    ///
    /// # Errors
    /// [`RasterError`] for empty or too large grids, a wrong number of levels, a cell size that is not positive.
    pub fn from_levels(
        width: usize,
        height: usize,
        mut levels: Vec<u8>,
        full: u8,
        cell: f64,
    ) -> Result<Self, RasterError> {
        require_few(width, height)?;
        if !(cell.is_finite() && cell > 0.0) {
            return Err(RasterError::Cell(cell));
        }
        if levels.len() != width * height {
            return Err(RasterError::Count { found: levels.len(), width, height });
        }
        let unit = levels.iter().fold(full, |unit, level| if unit == 1 { 1 } else { common_divisor(unit, *level) });
        if full == 0 || levels.iter().all(|level| *level == 0) {
            return Err(RasterError::Empty);
        }
        // In the largest unit, so that black and white images count in ones, whatever their white is.
        if unit > 1 {
            levels.iter_mut().for_each(|level| *level /= unit);
        }
        Ok(Self { width, height, levels, full: full / unit, cell })
    }

    /// Columns and rows.
    pub fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// The side of a cell, metres.
    pub fn cell(&self) -> f64 {
        self.cell
    }

    /// Square metres, cells weighed by membership.
    pub fn area(&self) -> f64 {
        let levels: u64 = self.levels.iter().map(|level| u64::from(*level)).sum();
        levels as f64 / f64::from(self.full) * self.cell * self.cell
    }

    /// The diagonal of the box around all cells with membership, metres.
    pub fn diameter(&self) -> f64 {
        let (low, high) = self.bounds();
        (high - low).norm()
    }

    /// The way from the middle of another raster's bounds to the middle of this one's, metres.
    pub(in crate::force) fn offset_from(&self, other: &Self) -> Vec2 {
        let (own, others) = (self.bounds(), other.bounds());
        ((own.0 + own.1) - (others.0 + others.1)) / 2.0
    }

    /// The lowest and highest x and y of cells with membership, metres from the grid's lower left corner.
    pub fn bounds(&self) -> (Vec2, Vec2) {
        let (mut low, mut high) = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY));
        for (row, cells) in self.rows().enumerate() {
            let inside = |level: &u8| *level > 0;
            let (Some(first), Some(last)) = (cells.iter().position(inside), cells.iter().rposition(inside)) else {
                continue;
            };
            let below = (self.height - row - 1) as f64;
            low = low.inf(&vec2(first as f64, below));
            high = high.sup(&vec2(last as f64 + 1.0, below + 1.0));
        }
        (low * self.cell, high * self.cell)
    }

    /// The membership of a cell, 0 to 1; zero outside the grid.
    pub fn membership(&self, column: usize, row: usize) -> f64 {
        let inside = column < self.width && row < self.height;
        if inside { f64::from(self.levels[row * self.width + column]) / f64::from(self.full) } else { 0.0 }
    }

    pub(super) fn full(&self) -> u8 {
        self.full
    }

    pub(super) fn levels(&self) -> &[u8] {
        &self.levels
    }

    pub(in crate::force) fn rows(&self) -> impl Iterator<Item = &[u8]> {
        self.levels.chunks_exact(self.width)
    }

    pub(super) fn require_alike(&self, other: &Self) -> Result<(), RasterError> {
        if self.size() != other.size() {
            return Err(RasterError::DifferentSizes(self.width, self.height, other.width, other.height));
        }
        if (self.cell - other.cell).abs() > 1e-12 * self.cell {
            return Err(RasterError::DifferentCells(self.cell, other.cell));
        }
        Ok(())
    }
}

fn require_few(width: usize, height: usize) -> Result<(), RasterError> {
    match width.checked_mul(height) {
        Some(0) => Err(RasterError::Empty),
        Some(cells) if cells <= RASTER_CELLS.count() => Ok(()),
        _ => Err(RasterError::TooManyCells { width, height }),
    }
}

fn ninths(cell: char) -> Option<u8> {
    match cell {
        '.' | ' ' => Some(0),
        '#' => Some(9),
        digit => digit.to_digit(10).map(|d| d as u8),
    }
}

fn common_divisor(a: u8, b: u8) -> u8 {
    if b == 0 { a } else { common_divisor(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_ninths_and_white_is_one_whatever_its_number() {
        let fuzzy = Raster::from_rows(&["0.36#"], 1.0).expect("a grid");
        assert_eq!((fuzzy.full(), fuzzy.levels()), (3, [0, 0, 1, 2, 3].as_slice()));
        let image = Raster::from_levels(2, 1, vec![0, 255], 255, 1.0).expect("a grid");
        assert_eq!((image.full(), image.levels()), (1, [0, 1].as_slice()));
    }

    #[test]
    fn each_kind_of_bad_grid_is_called_by_its_name() {
        let error = |rows: &[&str], cell| Raster::from_rows(rows, cell).expect_err("a bad grid");
        assert_eq!(error(&[], 1.0), RasterError::Empty);
        assert_eq!(error(&[".."], 1.0), RasterError::Empty);
        assert_eq!(error(&["##", "#"], 1.0), RasterError::Ragged { row: 2, found: 1, expected: 2 });
        assert_eq!(error(&["##", "#x"], 1.0), RasterError::Character { row: 2, column: 2, found: 'x' });
        assert_eq!(error(&["##"], -1.0), RasterError::Cell(-1.0));
        let huge = Raster::from_levels(1 << 15, 1 << 15, Vec::new(), 1, 1.0).expect_err("too large");
        assert!(matches!(huge, RasterError::TooManyCells { .. }));
    }

    #[test]
    fn bounds_are_measured_from_the_lower_left() {
        let raster = Raster::from_rows(&["..#", "...", "..."], 0.5).expect("a grid");
        assert_eq!(raster.bounds(), (vec2(1.0, 1.0), vec2(1.5, 1.5)));
        assert_eq!(raster.area(), 0.25);
    }
}

//! A grid over the plane that knows, for each cell, how far the nearest obstacle is.

use super::{Polygon, Vec2, distance_to_segment, vec2};

/// Metres to the nearest obstacle for each cell of a grid; distances past the reach are not told apart.
#[derive(Clone, Debug)]
pub struct ClearanceGrid {
    low: Vec2,
    cell_m: f64,
    width: usize,
    height: usize,
    reach_m: f64,
    clearance: Vec<f32>,
}

/// Column and row of a cell.
pub type Cell = (i32, i32);

impl ClearanceGrid {
    /// A grid without obstacles over the rectangle from `low` to `high`.
    pub fn new(low: Vec2, high: Vec2, cell_m: f64, reach_m: f64) -> Self {
        let size = (high - low) / cell_m;
        let (width, height) = (size.x.ceil().max(1.0) as usize, size.y.ceil().max(1.0) as usize);
        Self { low, cell_m, width, height, reach_m, clearance: vec![reach_m as f32; width * height] }
    }

    /// Side of a cell, metres.
    pub fn cell_m(&self) -> f64 {
        self.cell_m
    }

    /// Columns and rows.
    pub fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// Adds a wall.
    pub fn add_segment(&mut self, a: Vec2, b: Vec2) {
        self.lower(a.inf(&b), a.sup(&b), |point, _| distance_to_segment(point, a, b));
    }

    /// Adds something solid.
    pub fn add_polygon(&mut self, polygon: &Polygon) {
        self.add_about(polygon, 0.0);
    }

    /// Adds something solid that may reach beyond its outline by `margin_m`.
    pub fn add_about(&mut self, polygon: &Polygon, margin_m: f64) {
        let (low, high) = polygon.bounds();
        let margin = Vec2::repeat(margin_m);
        self.lower(low - margin, high + margin, |point, to_box| {
            let distance = if to_box > 1e-6 { polygon.distance_to_border(point) } else { polygon.distance_to(point) };
            (distance - margin_m).max(0.0)
        });
    }

    /// Adds a solid square of side `side_m` about its middle.
    pub fn add_square(&mut self, middle: Vec2, side_m: f64) {
        let half = Vec2::repeat(side_m / 2.0);
        let (low, high) = (middle - half, middle + half);
        self.lower(low, high, |_, to_box| to_box);
    }

    /// Adds a solid square that others surround: it is nearest to none but a cell whose middle it covers.
    pub fn add_inner_square(&mut self, middle: Vec2, side_m: f64) {
        let cell = self.cell(middle);
        if (self.centre(cell) - middle).amax() <= side_m / 2.0
            && let Some(index) = self.index(cell)
        {
            self.clearance[index] = 0.0;
        }
    }

    /// Adds every cell for which `solid` holds, whole, in time that does not grow with how many there are.
    ///
    /// Distances along rows first, then the least over the rows in reach: the square of the distance to a square cell
    /// is a sum over both axes (Saito & Toriwaki, "New algorithms for Euclidean distance transformation", 1994).
    pub fn add_cells(&mut self, solid: impl Fn(usize, usize) -> bool) {
        let (width, height) = (self.width, self.height);
        let far = width + height;
        let mut along = vec![far as u32; width * height];
        for (y, row) in along.chunks_exact_mut(width).enumerate() {
            let mut since = far;
            for (x, steps) in row.iter_mut().enumerate() {
                since = if solid(x, y) { 0 } else { (since + 1).min(far) };
                *steps = since as u32;
            }
            for x in (0..width - 1).rev() {
                row[x] = row[x].min(row[x + 1] + 1);
            }
        }
        // From a cell's middle to the nearest side of one so many steps off.
        let off = |steps: usize| if steps == 0 { 0.0 } else { (steps as f64 - 0.5) * self.cell_m };
        let rows = ((self.reach_m / self.cell_m).ceil() as usize + 1).min(height);
        for y in 0..height {
            for x in 0..width {
                let known = f64::from(self.clearance[y * width + x]);
                let mut least = known * known;
                for step in 0..rows {
                    let down = off(step) * off(step);
                    if down >= least {
                        break;
                    }
                    for other in [y.checked_sub(step), Some(y + step).filter(|&other| other < height)] {
                        let steps = other.map_or(far, |other| along[other * width + x] as usize);
                        least = least.min(down + if steps < far { off(steps) * off(steps) } else { f64::INFINITY });
                    }
                }
                self.clearance[y * width + x] = least.sqrt() as f32;
            }
        }
    }

    /// `distance` is told how far the point lies from the box from `low` to `high`, that holds the obstacle, metres.
    fn lower(&mut self, low: Vec2, high: Vec2, distance: impl Fn(Vec2, f64) -> f64) {
        let reach = Vec2::repeat(self.reach_m);
        let (first, last) = (self.cell(low - reach), self.cell(high + reach));
        for y in first.1.max(0)..=last.1.min(self.height as i32 - 1) {
            for x in first.0.max(0)..=last.0.min(self.width as i32 - 1) {
                let centre = self.centre((x, y));
                let cell = &mut self.clearance[y as usize * self.width + x as usize];
                // What is farther than what the cell knows already need not be measured.
                let to_box = (low - centre).sup(&(centre - high)).sup(&Vec2::zeros()).norm_squared();
                let known = f64::from(*cell) + 1e-6;
                if to_box < known * known {
                    *cell = cell.min(distance(centre, to_box.sqrt()) as f32);
                }
            }
        }
    }

    /// The cell that holds `point`; it may lie outside the grid.
    pub fn cell(&self, point: Vec2) -> Cell {
        let p = (point - self.low) / self.cell_m;
        (p.x.floor() as i32, p.y.floor() as i32)
    }

    /// The middle of a cell.
    pub fn centre(&self, cell: Cell) -> Vec2 {
        self.low + vec2(f64::from(cell.0) + 0.5, f64::from(cell.1) + 0.5) * self.cell_m
    }

    /// Metres from the cell's middle to the nearest obstacle; zero outside the grid.
    pub fn clearance(&self, cell: Cell) -> f64 {
        self.index(cell).map_or(0.0, |index| f64::from(self.clearance[index]))
    }

    /// Where a cell is kept; nothing outside the grid.
    fn index(&self, (x, y): Cell) -> Option<usize> {
        let inside = x >= 0 && y >= 0 && (x as usize) < self.width && (y as usize) < self.height;
        inside.then(|| y as usize * self.width + x as usize)
    }

    /// The least clearance along the straight line between two points.
    pub fn clearance_along(&self, a: Vec2, b: Vec2) -> f64 {
        let steps = ((b - a).norm() / (self.cell_m / 2.0)).ceil().max(1.0) as usize;
        let at = |i: usize| self.clearance(self.cell(a + (b - a) * (i as f64 / steps as f64)));
        (0..=steps).map(at).fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Pose;

    #[test]
    fn clearance_is_the_distance_to_the_nearest_obstacle() {
        let mut grid = ClearanceGrid::new(vec2(0.0, 0.0), vec2(4.0, 4.0), 0.1, 1.0);
        grid.add_segment(vec2(0.0, 0.0), vec2(4.0, 0.0));
        grid.add_polygon(&Polygon::rectangle(Pose::new(2.0, 2.0, 0.0), 1.0, 1.0));
        let at = |x, y| grid.clearance(grid.cell(vec2(x, y)));
        assert!((at(2.0, 0.5) - 0.55).abs() < 0.051);
        assert_eq!(at(2.0, 2.0), 0.0);
        assert_eq!(at(9.0, 9.0), 0.0);
        assert!((at(3.95, 3.95) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn what_may_reach_farther_leaves_less_room() {
        let mut grid = ClearanceGrid::new(vec2(0.0, 0.0), vec2(4.0, 4.0), 0.1, 1.0);
        grid.add_about(&Polygon::rectangle(Pose::new(2.0, 2.0, 0.0), 1.0, 1.0), 0.2);
        let at = |x, y| grid.clearance(grid.cell(vec2(x, y)));
        assert!((at(2.05, 0.55) - 0.75).abs() < 1e-6 && at(2.05, 1.45) == 0.0);
    }

    #[test]
    fn cells_all_at_once_are_as_squares_one_by_one() {
        let mut grid = ClearanceGrid::new(vec2(-1.0, 2.0), vec2(3.0, 5.0), 0.1, 0.7);
        let mut alike = grid.clone();
        let solid = |x: usize, y: usize| (x * 7 + y * 13).is_multiple_of(41) || (x < 3 && y > 20);
        for (x, y) in (0..40).flat_map(|x| (0..30).map(move |y| (x, y))).filter(|&(x, y)| solid(x, y)) {
            alike.add_square(alike.centre((x as i32, y as i32)), 0.1);
        }
        grid.add_cells(solid);
        for cell in (0..40).flat_map(|x| (0..30).map(move |y| (x, y))) {
            let (one, other) = (grid.clearance(cell), alike.clearance(cell));
            assert!((one - other).abs() < 1e-6, "{cell:?}: {one} {other}");
        }
    }

    #[test]
    fn squares_side_by_side_are_one_obstacle() {
        let mut grid = ClearanceGrid::new(vec2(0.0, 0.0), vec2(4.0, 4.0), 0.1, 1.0);
        let mut alike = grid.clone();
        for (x, y) in (0..20).flat_map(|x| (0..10).map(move |y| (x, y))) {
            let middle = vec2(1.525 + 0.05 * f64::from(x), 1.025 + 0.05 * f64::from(y));
            if (1..19).contains(&x) && (1..9).contains(&y) {
                grid.add_inner_square(middle, 0.05);
            } else {
                grid.add_square(middle, 0.05);
            }
        }
        alike.add_polygon(&Polygon::rectangle(Pose::new(2.0, 1.25, 0.0), 1.0, 0.5));
        let cells = (0..40).flat_map(|x| (0..40).map(move |y| (x, y)));
        assert!(cells.into_iter().all(|cell| (grid.clearance(cell) - alike.clearance(cell)).abs() < 1e-6));
    }

    #[test]
    fn the_line_through_an_obstacle_has_no_clearance() {
        let mut grid = ClearanceGrid::new(vec2(0.0, 0.0), vec2(4.0, 4.0), 0.1, 1.0);
        grid.add_polygon(&Polygon::rectangle(Pose::new(2.0, 2.0, 0.0), 1.0, 1.0));
        assert_eq!(grid.clearance_along(vec2(0.5, 2.0), vec2(3.5, 2.0)), 0.0);
        assert!(grid.clearance_along(vec2(0.5, 0.5), vec2(3.5, 0.5)) > 0.9);
    }
}

//! A way on the grid from here to there that keeps the robot's swing clear of everything known.

use pathfinding::prelude::astar;

use crate::geometry::{Cell, ClearanceGrid, Vec2};

/// Straight and diagonal steps in tenths of a cell.
const STRAIGHT: u32 = 10;
const DIAGONAL: u32 = 14;
/// Extra cost of a step close to something, so that the way keeps to the middle where there is room.
const CROWDED: u32 = 8;
/// Clearance beyond the radius at which a step costs nothing extra, metres.
const ROOMY_M: f64 = 0.25;
/// How far from a blocked goal a free one may lie, metres.
const NEAR_GOAL_M: f64 = 1.5;

/// The corners of a way from `from` to `to` on which the clearance is at least `radius_m`, metres.
///
/// A goal that is not free is replaced by the nearest free place; so is a
/// start, since a robot that stands too near to something must still get away.
/// Nothing when there is no such way.
pub fn route(grid: &ClearanceGrid, from: Vec2, to: Vec2, radius_m: f64) -> Option<Vec<Vec2>> {
    let start = nearest_free(grid, from, radius_m, 0.8)?;
    let goal = nearest_free(grid, to, radius_m, NEAR_GOAL_M)?;
    let (cells, _) =
        astar(&start, |&cell| steps(grid, cell, radius_m), |&cell| octile(cell, goal), |&cell| cell == goal)?;
    let mut points: Vec<Vec2> = cells.into_iter().map(|cell| grid.centre(cell)).collect();
    if grid.clearance_along(points[points.len() - 1], to) >= radius_m {
        points.push(to);
    }
    Some(shortened(grid, from, &points, radius_m))
}

/// Metres along the corners, from `from` on.
pub fn length(from: Vec2, points: &[Vec2]) -> f64 {
    let mut at = from;
    points
        .iter()
        .map(|&point| {
            let step = (point - at).norm();
            at = point;
            step
        })
        .sum()
}

/// The free cell nearest to `point` within `reach_m`.
pub fn nearest_free(grid: &ClearanceGrid, point: Vec2, radius_m: f64, reach_m: f64) -> Option<Cell> {
    let home = grid.cell(point);
    if grid.clearance(home) >= radius_m {
        return Some(home);
    }
    let reach = (reach_m / grid.cell_m()).ceil() as i32;
    let mut best: Option<(f64, Cell)> = None;
    for y in home.1 - reach..=home.1 + reach {
        for x in home.0 - reach..=home.0 + reach {
            let distance = (grid.centre((x, y)) - point).norm();
            let better = distance <= reach_m && best.is_none_or(|(least, _)| distance < least);
            if better && grid.clearance((x, y)) >= radius_m {
                best = Some((distance, (x, y)));
            }
        }
    }
    best.map(|(_, cell)| cell)
}

fn steps(grid: &ClearanceGrid, (x, y): Cell, radius_m: f64) -> Vec<(Cell, u32)> {
    let mut free = Vec::with_capacity(8);
    for (dx, dy) in [(1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)] {
        let next = (x + dx, y + dy);
        let clearance = grid.clearance(next);
        if clearance >= radius_m {
            let crowd = 1.0 - ((clearance - radius_m) / ROOMY_M).min(1.0);
            let step = if dx != 0 && dy != 0 { DIAGONAL } else { STRAIGHT };
            free.push((next, step + (crowd * f64::from(CROWDED)) as u32));
        }
    }
    free
}

fn octile(a: Cell, b: Cell) -> u32 {
    let (dx, dy) = (a.0.abs_diff(b.0), a.1.abs_diff(b.1));
    DIAGONAL * dx.min(dy) + STRAIGHT * dx.abs_diff(dy)
}

/// Leaves out corners that a straight line can skip.
fn shortened(grid: &ClearanceGrid, from: Vec2, points: &[Vec2], radius_m: f64) -> Vec<Vec2> {
    let mut kept = Vec::new();
    let mut at = from;
    let mut i = 0;
    while i < points.len() {
        let clear = |j: &usize| grid.clearance_along(at, points[*j]) >= radius_m;
        let furthest = (i..points.len()).rev().find(clear).unwrap_or(i);
        at = points[furthest];
        kept.push(at);
        i = furthest + 1;
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Polygon, Pose, vec2};

    fn room_with_block() -> ClearanceGrid {
        let mut grid = ClearanceGrid::new(vec2(0.0, 0.0), vec2(6.0, 4.0), 0.1, 1.0);
        for (a, b) in Polygon::rectangle(Pose::new(3.0, 2.0, 0.0), 6.0, 4.0).edges() {
            grid.add_segment(a, b);
        }
        grid.add_polygon(&Polygon::rectangle(Pose::new(3.0, 1.5, 0.0), 1.0, 2.0));
        grid
    }

    #[test]
    fn the_way_goes_round_what_stands_in_it() {
        let grid = room_with_block();
        let points = route(&grid, vec2(1.0, 1.0), vec2(5.0, 1.0), 0.4).expect("a way");
        assert!(points.len() > 1);
        let mut at = vec2(1.0, 1.0);
        for point in points {
            assert!(grid.clearance_along(at, point) >= 0.35);
            at = point;
        }
        assert!((at - vec2(5.0, 1.0)).norm() < 0.1);
    }

    #[test]
    fn a_goal_inside_furniture_becomes_the_nearest_free_place() {
        let grid = room_with_block();
        let points = route(&grid, vec2(1.0, 1.0), vec2(2.8, 1.5), 0.4).expect("a way");
        let end = points[points.len() - 1];
        assert!((end - vec2(2.1, 1.5)).norm() < 0.2, "{end:?}");
    }

    #[test]
    fn no_way_through_a_wall() {
        let mut grid = room_with_block();
        grid.add_segment(vec2(3.0, 0.0), vec2(3.0, 4.0));
        assert!(route(&grid, vec2(1.0, 1.0), vec2(5.0, 1.0), 0.4).is_none());
    }
}

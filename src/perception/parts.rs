//! One frame taken apart: its points, floor, walls and pieces.

use super::floor_grid::{FloorGrid, project};
use super::points::{Points, points};
use super::segment::Segments;
use super::walls::{Wall, walls};
use crate::frame::RgbdFrame;
use crate::map::RoomMap;

/// One frame taken apart.
pub(crate) struct Parts {
    pub points: Points,
    pub grid: FloorGrid,
    pub walls: Vec<Wall>,
    pub segments: Segments,
}

/// A frame's points, floor and walls.
pub(crate) fn room(frame: &RgbdFrame, map: Option<&RoomMap>) -> (Points, FloorGrid, Vec<Wall>) {
    let points = points(frame);
    let grid = project(frame, &points);
    let walls = walls(&grid, &points, map);
    (points, grid, walls)
}

//! Pieces from a true segmentation, in place of the detector's own.

use super::floor_grid::{FloorGrid, NOWHERE};
use super::parts::{Parts, room};
use super::patches::Sums;
use super::points::{Points, STRIDE};
use super::segment::segments;
use crate::frame::RgbdFrame;
use crate::map::RoomMap;

/// A frame cut into the items that its pixels are said to belong to, in one pass; 0 is no item.
pub(crate) fn parts_of_items(frame: &RgbdFrame, map: Option<&RoomMap>, item_of: &[u16]) -> Parts {
    let (points, grid, walls) = room(frame, map);
    let mut groups: Vec<(Vec<u32>, Sums)> = Vec::new();
    for (cell, item) in item_of_cells(frame, &points, &grid, item_of).into_iter().enumerate() {
        if item == 0 {
            continue;
        }
        groups.resize_with(groups.len().max(usize::from(item)), Default::default);
        let (cells, sums) = &mut groups[usize::from(item) - 1];
        cells.push(cell as u32);
        sums.add_cell(&grid, cell);
    }
    let segments = segments(&grid, &points, groups);
    Parts { points, grid, walls, segments }
}

/// The item that most points of each cell belong to; of equals the first.
fn item_of_cells(frame: &RgbdFrame, points: &Points, grid: &FloorGrid, item_of: &[u16]) -> Vec<u16> {
    let item_at = |at: usize| item_of[((at / points.columns) * frame.width + at % points.columns) * STRIDE];
    let filled = grid.cell_of.iter().enumerate().filter(|(_, cell)| **cell != NOWHERE);
    let mut claims: Vec<(u32, u16)> = filled.map(|(at, &cell)| (cell, item_at(at))).collect();
    claims.sort_unstable();
    let mut items = vec![0; grid.cells.len()];
    for of_cell in claims.chunk_by(|a, b| a.0 == b.0) {
        let by_item = of_cell.chunk_by(|a, b| a == b);
        let most = by_item.fold(&of_cell[..0], |most, claim| if claim.len() > most.len() { claim } else { most });
        items[of_cell[0].0 as usize] = most[0].1;
    }
    items
}

//! Outlines of rooms: given, or the box of walls round a point.

use std::collections::VecDeque;

use super::grid::Grid;
use super::{RoomKey, Source};
use crate::geometry::{Cell, ClearanceGrid, Vec2, vec2};
use crate::map::WorldError;

/// Openings narrower than twice this part two rooms, metres.
const HALF_DOOR_M: f64 = 0.6;

/// The outline of each room, metres.
pub(super) fn outlines(rooms: &[RoomKey], grid: &Grid, source: &Source) -> Result<Vec<Vec<[f64; 2]>>, WorldError> {
    let clearance = grid.clearance(HALF_DOOR_M + 2.0 * grid.cell_m);
    let mut taken: Vec<(Vec<bool>, &str)> = Vec::new();
    let mut outlines = Vec::new();
    for room in rooms {
        let item = format!("room `{}`", room.name);
        outlines.push(match (&room.outline, room.seed) {
            (Some(outline), _) => outline.clone(),
            (None, Some([x, y])) => {
                let core = core_of(&clearance, vec2(x, y)).ok_or_else(|| {
                    let message = format!("seed ({x}, {y}) lies within {HALF_DOOR_M} m of a wall or outside; put it into the middle of the room, or give its `outline`");
                    source.wrong(&item, message)
                })?;
                if let Some((_, other)) = taken.iter().find(|(cells, _)| cells[core.seed]) {
                    let message = format!("no wall parts it from `{other}`; give the `outline` of both");
                    return Err(source.wrong(&item, message));
                }
                let corners = core.outline(&clearance);
                taken.push((core.cells, &room.name));
                corners
            }
            (None, None) => return Err(source.wrong(&item, "needs a `seed`, a free point in it, or an `outline`")),
        });
    }
    Ok(outlines)
}

/// The cells of a room that are farther from every wall than half a door.
struct Core {
    cells: Vec<bool>,
    seed: usize,
    low: Vec2,
    high: Vec2,
}

fn core_of(clearance: &ClearanceGrid, seed: Vec2) -> Option<Core> {
    let (width, height) = clearance.size();
    let index = |(x, y): Cell| {
        let inside = x >= 0 && y >= 0 && (x as usize) < width && (y as usize) < height;
        inside.then(|| y as usize * width + x as usize)
    };
    let open = |cell: Cell| clearance.clearance(cell) >= HALF_DOOR_M;
    let first = clearance.cell(seed);
    if !open(first) {
        return None;
    }
    let at = clearance.centre(first);
    let mut core = Core { cells: vec![false; width * height], seed: index(first)?, low: at, high: at };
    let mut waiting = VecDeque::from([first]);
    while let Some(cell) = waiting.pop_front() {
        let Some(i) = index(cell).filter(|&i| !core.cells[i] && open(cell)) else { continue };
        core.cells[i] = true;
        let at = clearance.centre(cell);
        (core.low, core.high) = (core.low.inf(&at), core.high.sup(&at));
        let (x, y) = cell;
        waiting.extend([(x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)]);
    }
    Some(core)
}

impl Core {
    /// The box of the core, out to the walls, to the centimetre.
    fn outline(&self, clearance: &ClearanceGrid) -> Vec<[f64; 2]> {
        let to_wall = Vec2::repeat(HALF_DOOR_M + clearance.cell_m() / 2.0);
        let round = |v: f64| (v * 100.0).round() / 100.0;
        let (low, high) = ((self.low - to_wall).map(round), (self.high + to_wall).map(round));
        vec![[low.x, low.y], [high.x, low.y], [high.x, high.y], [low.x, high.y]]
    }
}

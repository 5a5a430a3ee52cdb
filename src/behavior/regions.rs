//! Where to go on looking when what was meant has not been seen.

use super::motion::RoomFrame;
use super::route::nearest_free;
use crate::geometry::{ClearanceGrid, Vec2, vec2};

/// Places from which together the room can be seen: its middle, then its quarters, nearest to `from` first;
/// where a robot that needs `to_turn` metres can turn.
pub fn lookouts(grid: &ClearanceGrid, room: &RoomFrame, from: Vec2, to_turn: f64) -> Vec<Vec2> {
    let ((near, far), (right, left)) = room.extent();
    let at = |depth: f64, across: f64| {
        room.entry.to_world(vec2(near + depth * (far - near), right + across * (left - right)))
    };
    let free = |point: Vec2| {
        let cell = nearest_free(grid, point, to_turn, 1.0)?;
        Some(grid.centre(cell)).filter(|&centre| room.outline.contains(centre))
    };
    let mut quarters = [(0.25, 0.25), (0.25, 0.75), (0.75, 0.25), (0.75, 0.75)].map(|(d, a)| at(d, a));
    quarters.sort_by(|a, b| (a - from).norm().total_cmp(&(b - from).norm()));
    [at(0.5, 0.5)].into_iter().chain(quarters).filter_map(free).collect()
}

//! Where two rooms meet: one line for the wall between them, and the doors in it.

use super::RoomKey;
use super::grid::Grid;
use super::mode::CellState;
use crate::geometry::{Vec2, vec2};
use crate::map::Door;

/// Walls thicker than this part two rooms for good, metres.
const THICKEST_M: f64 = 0.6;
/// Openings narrower than this are no doors, metres.
const NARROWEST_M: f64 = 0.6;
/// Rooms that face each other over less than this do not meet, metres.
const LEAST_SHARED_M: f64 = 0.5;

/// A door between two rooms by their numbers.
#[derive(Clone, Debug)]
pub(super) struct Opening {
    rooms: (usize, usize),
    middle: Vec2,
    width: f64,
}

/// A side of a rectangular room: on which axis it lies, where, and from where to where along the other.
#[derive(Clone, Copy, Debug)]
struct Side {
    room: usize,
    axis: usize,
    high: bool,
    at: f64,
    from: f64,
    to: f64,
}

/// Moves the facing sides of neighbouring rectangular rooms onto one line, and finds the doors there.
pub(super) fn join_walls(outlines: &mut [Vec<[f64; 2]>], grid: &Grid) -> Vec<Opening> {
    let sides: Vec<Side> = (0..outlines.len()).flat_map(|room| sides_of(room, &outlines[room])).collect();
    let mut line: Vec<usize> = (0..sides.len()).collect();
    let mut pairs = Vec::new();
    for i in 0..sides.len() {
        for j in i + 1..sides.len() {
            if faces(&sides[i], &sides[j]) {
                pairs.push((i, j));
                let (old, new) = (line[j], line[i]);
                line.iter_mut().filter(|l| **l == old).for_each(|l| *l = new);
            }
        }
    }
    let thickness = |(i, j): (usize, usize)| (sides[i].at - sides[j].at).abs();
    let at_of = |i: usize| {
        let same: Vec<f64> = (0..sides.len()).filter(|&k| line[k] == line[i]).map(|k| sides[k].at).collect();
        let mean = same.iter().sum::<f64>() / same.len() as f64;
        (mean * 100.0).round() / 100.0
    };
    for (i, side) in sides.iter().enumerate() {
        let other = 1 - side.axis;
        let moved = at_of(i);
        for corner in &mut outlines[side.room] {
            // The two corners of this side: the axis tells which.
            if (corner[side.axis] - side.at).abs() < 1e-9 && corner[other].is_finite() {
                corner[side.axis] = moved;
            }
        }
    }
    pairs.into_iter().flat_map(|(i, j)| openings(&sides[i], &sides[j], at_of(i), thickness((i, j)), grid)).collect()
}

/// The four sides of a rectangular outline; none of another.
fn sides_of(room: usize, outline: &[[f64; 2]]) -> Vec<Side> {
    let along = |axis: usize, high: bool| {
        let values = |axis: usize| outline.iter().map(move |corner| corner[axis]);
        let least = |axis| values(axis).fold(f64::INFINITY, f64::min);
        let most = |axis| values(axis).fold(f64::NEG_INFINITY, f64::max);
        let (at, other) = (if high { most(axis) } else { least(axis) }, 1 - axis);
        Side { room, axis, high, at, from: least(other), to: most(other) }
    };
    let square = outline.len() == 4
        && (0..4).all(|i| (0..2).any(|axis| (outline[i][axis] - outline[(i + 1) % 4][axis]).abs() < 1e-9));
    if square { vec![along(0, false), along(0, true), along(1, false), along(1, true)] } else { Vec::new() }
}

/// Whether a wall can lie between two sides.
fn faces(a: &Side, b: &Side) -> bool {
    let (low, high) = if a.high { (a, b) } else { (b, a) };
    let gap = high.at - low.at;
    let shared = a.to.min(b.to) - a.from.max(b.from);
    a.room != b.room && a.axis == b.axis && a.high != b.high && gap.abs() < THICKEST_M && shared > LEAST_SHARED_M
}

/// The runs along the wall between two sides that are open through its whole thickness.
fn openings(a: &Side, b: &Side, at: f64, thickness: f64, grid: &Grid) -> Vec<Opening> {
    let (from, to) = (a.from.max(b.from), a.to.min(b.to));
    let step = grid.cell_m / 2.0;
    let depth = (thickness / 2.0 + grid.cell_m).max(2.0 * grid.cell_m);
    let point = |along: f64, across: f64| if a.axis == 0 { vec2(across, along) } else { vec2(along, across) };
    let is_open = |along: f64| {
        let steps = (2.0 * depth / step).ceil() as usize;
        (0..=steps).all(|i| grid.at(point(along, at - depth + step * i as f64)) == CellState::Free)
    };
    let count = ((to - from) / step) as usize;
    let mut found = Vec::new();
    let mut begun: Option<f64> = None;
    for i in 0..=count + 1 {
        let along = from + step * (i as f64 + 0.5);
        let open = i <= count && is_open(along);
        match (open, begun) {
            (true, None) => begun = Some(along - step / 2.0),
            (false, Some(start)) => {
                let end = along - step / 2.0;
                if end - start >= NARROWEST_M {
                    let middle = point((start + end) / 2.0, at);
                    found.push(Opening { rooms: (a.room, b.room), middle, width: end - start });
                }
                begun = None;
            }
            _ => {}
        }
    }
    found
}

/// The openings as doors, named after the rooms they part.
pub(super) fn named(openings: Vec<Opening>, rooms: &[RoomKey]) -> Vec<Door> {
    let round = |v: f64| (v * 1000.0).round() / 1000.0;
    let name = |opening: &Opening| {
        let (a, b) = (&rooms[opening.rooms.0], &rooms[opening.rooms.1]);
        // Named after the room it leads into.
        if b.passage { (b.name.clone(), a.name.clone()) } else { (a.name.clone(), b.name.clone()) }
    };
    let doors = openings.iter().enumerate().map(|(i, opening)| {
        let (from, into) = name(opening);
        let id = format!("{into}_door_{}", i + 1);
        let (x, y) = (round(opening.middle.x), round(opening.middle.y));
        Door { id, between: [from, into], at: [x, y], width: round(opening.width - 0.002) }
    });
    doors.collect()
}

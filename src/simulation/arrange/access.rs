//! Whether the robot can get to where each piece of furniture can be looked at.

use std::collections::VecDeque;
use std::f64::consts::TAU;

use crate::behavior::{Clearances, grid_of};
use crate::catalogue::FurnitureShape;
use crate::geometry::{Cell, ClearanceGrid, Vec2, vec2};
use crate::map::RoomMap;
use crate::robot::p3dx;
use crate::simulation::{Item, Scene};

/// Room beyond the swing that a place to stand and look needs, metres.
const SPARE_M: f64 = 0.06;
/// From a piece's edge and from its middle to the robot at least, and how much farther still does, metres.
const FROM_EDGE_M: f64 = 0.5;
const FROM_MIDDLE_M: f64 = 1.15;
const SLACK_M: f64 = 0.5;
/// Places are tried at this distance from one another, metres.
const STEP_M: f64 = 0.1;
/// Directions tried round a piece.
const DIRECTIONS: usize = 16;
/// A line of sight passes walls by this, metres.
const SIGHT_M: f64 = 0.1;

/// Whether every piece that holds an object, and every table, can be looked at by a robot that comes from the start.
pub fn everything_is_accessible(map: &RoomMap, scene: &Scene) -> bool {
    inaccessible(map, scene).is_empty()
}

/// The pieces that hold an object, or are tables, and cannot be looked at by a robot that comes from the start.
pub fn inaccessible<'s>(map: &RoomMap, scene: &'s Scene) -> Vec<&'s Item> {
    let rooms = grid_of(map);
    let mut grid = rooms.clone();
    scene.furniture.iter().for_each(|item| grid.add_polygon(&item.footprint()));
    let to_turn = Clearances::of(&p3dx::BODY).to_turn;
    let reached = reached_cells(&grid, map.start.position(), to_turn);
    let wanted = scene.furniture.iter().filter(|item| holds_something(scene, item) || is_table(item));
    wanted.filter(|item| !is_accessible(item, &grid, &rooms, &reached, to_turn)).collect()
}

fn holds_something(scene: &Scene, item: &Item) -> bool {
    scene.objects.iter().any(|object| object.on == item.id)
}

fn is_table(item: &Item) -> bool {
    matches!(item.kind().shape, FurnitureShape::Table | FurnitureShape::RoundTable | FurnitureShape::HexagonTable)
}

fn is_accessible(item: &Item, grid: &ClearanceGrid, rooms: &ClearanceGrid, reached: &Reached, to_turn: f64) -> bool {
    let centre = item.pose().position();
    let outline = item.footprint();
    (0..DIRECTIONS).any(|i| {
        let angle = TAU * i as f64 / DIRECTIONS as f64;
        let direction = vec2(angle.cos(), angle.sin());
        let edge = outline.corners().iter().map(|c| (c - centre).dot(&direction)).fold(0.0, f64::max);
        let nearest = (edge + FROM_EDGE_M).max(FROM_MIDDLE_M);
        (0..=(SLACK_M / STEP_M) as usize).any(|step| {
            let place = centre + direction * (nearest + STEP_M * step as f64);
            let cell = grid.cell(place);
            grid.clearance(cell) >= to_turn + SPARE_M
                && reached.holds(cell)
                && rooms.clearance_along(place, centre) >= SIGHT_M
        })
    })
}

/// The cells that a robot can turn in and get to.
struct Reached {
    width: usize,
    cells: Vec<bool>,
}

impl Reached {
    fn holds(&self, (x, y): Cell) -> bool {
        let inside = x >= 0 && y >= 0 && (x as usize) < self.width;
        inside && self.cells.get(y as usize * self.width + x as usize).copied().unwrap_or(false)
    }
}

fn reached_cells(grid: &ClearanceGrid, from: Vec2, to_turn: f64) -> Reached {
    let (width, height) = grid.size();
    let mut reached = Reached { width, cells: vec![false; width * height] };
    let mut open = VecDeque::from([grid.cell(from)]);
    while let Some((x, y)) = open.pop_front() {
        if grid.clearance((x, y)) < to_turn || reached.holds((x, y)) {
            continue;
        }
        reached.cells[y as usize * width + x as usize] = true;
        open.extend([(x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)]);
    }
    reached
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::SHIPPED_HOMES;

    #[test]
    fn in_every_shipped_home_everything_can_be_looked_at() {
        for home in SHIPPED_HOMES {
            let (map, scene) = home.load();
            let stuck: Vec<&str> = inaccessible(&map, &scene).iter().map(|item| item.id.as_str()).collect();
            assert!(stuck.is_empty(), "{}: {stuck:?}", home.map.name);
        }
    }

    #[test]
    fn a_table_walled_in_by_furniture_is_named() {
        let mut scene = Scene::apartment();
        for item in &mut scene.furniture {
            match item.id.as_str() {
                "dinner-table-1" => (item.x, item.y) = (6.4, 7.0),
                "couch-1" => (item.x, item.y, item.length, item.width) = (4.5, 5.3, Some(0.9), Some(5.5)),
                _ => {}
            }
        }
        let stuck: Vec<&str> =
            inaccessible(&RoomMap::apartment(), &scene).iter().map(|item| item.id.as_str()).collect();
        assert_eq!(stuck, ["dinner-table-1"]);
    }
}

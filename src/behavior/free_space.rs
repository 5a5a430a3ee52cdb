//! What the depth shows to be empty: an outline that is believed to reach there does not.
//!
//! The hidden sides of a piece are completed to what such pieces measure, and a
//! bad look puts a piece where there is none; both close ways that are open.
//! Of each cell inside an outline the column above the floor is held against
//! the picture: where the depth goes past it at every height, nothing stands.
//! That the floor shows would not do, it shows below a table, too.

use std::collections::{BTreeMap, BTreeSet};

use crate::frame::RgbdFrame;
use crate::geometry::{ClearanceGrid, Polygon, Vec2, vec2};

/// Side of a cell, metres.
const CELL_M: f64 = 0.05;
/// Farther off the depth is too coarse to tell, metres.
const FARTHEST_M: f64 = 3.5;
/// The lowest height looked at, and from there to the next, less than the thickness of a table's top, metres.
const LOWEST_M: f64 = 0.08;
const STEP_M: f64 = 0.04;
/// Heights looked at: up to the robot's own.
const HEIGHTS: usize = 28;
/// Heights of a column that may be unknown in all, as single pixels are lost.
const MOST_UNKNOWN: usize = 5;
/// So many more looks show a cell empty than not, a filled one counting for [`FILLED`].
const EMPTY: i8 = 3;
const FILLED: i8 = 2;
/// Looks beyond this count no more: what has changed must be believed some day.
const MOST: i8 = 8;
/// A piece of which more than this share is empty is not there.
const NOT_THERE: f64 = 0.6;

type Cell = (i32, i32);

/// How many more looks showed each cell empty than filled.
#[derive(Clone, Debug, Default)]
pub struct FreeSpace {
    looks: BTreeMap<Cell, i8>,
}

/// What a look shows of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Column {
    Empty,
    Filled,
    Unknown,
}

impl FreeSpace {
    /// Takes in what a frame shows of the space within `outlines`; true when some of it is now known to be empty, or no
    /// longer.
    pub fn take_in<'o>(&mut self, frame: &RgbdFrame, outlines: impl Iterator<Item = (&'o Polygon, f64)>) -> bool {
        let mut cells: Vec<Cell> = outlines.flat_map(|(outline, margin)| cells_of(outline, margin)).collect();
        cells.sort_unstable();
        cells.dedup();
        let mut changed = false;
        for cell in cells {
            let by = match column(frame, centre(cell)) {
                Column::Empty => 1,
                Column::Filled => -FILLED,
                Column::Unknown => continue,
            };
            let before = self.is_empty(cell);
            let looks = self.looks.entry(cell).or_default();
            *looks = (*looks + by).clamp(-MOST, MOST);
            changed |= self.is_empty(cell) != before;
        }
        changed
    }

    /// Adds a piece to a grid, as far as its space is not known to be empty.
    pub fn add_to(&self, grid: &mut ClearanceGrid, outline: &Polygon, margin: f64) {
        let cells = cells_of(outline, margin);
        let filled: BTreeSet<Cell> = cells.iter().copied().filter(|cell| !self.is_empty(*cell)).collect();
        if filled.len() == cells.len() {
            grid.add_about(outline, margin);
            return;
        }
        for &(x, y) in &filled {
            let around = [(x - 1, y), (x + 1, y), (x, y - 1), (x, y + 1)];
            if around.iter().all(|cell| filled.contains(cell)) {
                grid.add_inner_square(centre((x, y)), CELL_M);
            } else {
                grid.add_square(centre((x, y)), CELL_M);
            }
        }
    }

    /// Whether most of an outline's space is known to be empty.
    pub fn refutes(&self, outline: &Polygon) -> bool {
        let cells = cells_of(outline, 0.0);
        let empty = cells.iter().filter(|cell| self.is_empty(**cell)).count();
        empty as f64 > NOT_THERE * cells.len() as f64
    }

    fn is_empty(&self, cell: Cell) -> bool {
        self.looks.get(&cell).is_some_and(|looks| *looks >= EMPTY)
    }
}

/// The cells whose middles lie within an outline, or within a margin of it.
fn cells_of(outline: &Polygon, margin: f64) -> Vec<Cell> {
    let (low, high) = outline.bounds();
    let at = |v: f64| (v / CELL_M).floor() as i32;
    let columns = at(low.x - margin)..=at(high.x + margin);
    let rows = at(low.y - margin)..=at(high.y + margin);
    let cells = columns.flat_map(|x| rows.clone().map(move |y| (x, y)));
    cells.filter(|&cell| outline.distance_to(centre(cell)) <= margin).collect()
}

fn centre((x, y): Cell) -> Vec2 {
    vec2(f64::from(x) + 0.5, f64::from(y) + 0.5) * CELL_M
}

/// What the depth says of the column over a place.
fn column(frame: &RgbdFrame, place: Vec2) -> Column {
    let eye = frame.eye();
    if (place - vec2(eye[0], eye[1])).norm() > FARTHEST_M {
        return Column::Unknown;
    }
    let (mut unknown, mut filled, mut gap) = (0, 0, 0);
    for i in 0..HEIGHTS {
        match beyond(frame, [place.x, place.y, LOWEST_M + STEP_M * i as f64]) {
            Some(true) => gap = 0,
            // One pixel may be noise.
            Some(false) if filled > 0 => return Column::Filled,
            Some(false) => filled += 1,
            None => (unknown, gap) = (unknown + 1, gap + 1),
        }
        // A top seen at a grazing angle gives no depth at several heights.
        if gap > 1 || unknown > MOST_UNKNOWN {
            return Column::Unknown;
        }
    }
    if filled == 0 { Column::Empty } else { Column::Unknown }
}

/// Whether the depth at a point's pixel lies beyond it; nothing where it lies before it, or is not known.
fn beyond(frame: &RgbdFrame, point: [f64; 3]) -> Option<bool> {
    let (column, row, here) = frame.pixel(point)?;
    let off = frame.depth_at(column, row)? - here;
    // Half a cell, and four times the depth's noise.
    let tolerance = 0.04 + 0.006 * here * here;
    (off > -tolerance).then_some(off > tolerance)
}

#[cfg(test)]
mod tests {
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;

    use super::*;
    use crate::frame::RgbdFrame;
    use crate::geometry::Pose;
    use crate::map::RoomMap;
    use crate::simulation::Scene;
    use crate::simulation::camera::{Kinect, SolidScene};

    /// A dinner table in the living room, and what a Kinect sees of it from all sides.
    fn table() -> (Polygon, Vec<RgbdFrame>) {
        let scene = r#"{"version":1,"name":"one table","map":"apartment","furniture":[
            {"id":"table","category":"dinner_table","x":4.6,"y":4.8}]}"#;
        let scene: Scene = serde_json::from_str(scene).expect("a scene");
        let map = RoomMap::apartment();
        let (solids, kinect) = (SolidScene::new(&map, &scene), Kinect::default());
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let mut looks = Vec::new();
        for look in 0..48 {
            let bearing = f64::from(look) * std::f64::consts::TAU / 24.0;
            let away = if look < 24 { 2.0 } else { 2.8 };
            let here = vec2(4.6, 4.8) - vec2(bearing.cos(), bearing.sin()) * away;
            let pose = Pose::new(here.x, here.y, bearing);
            let mut frame = kinect.capture(&solids, pose, &mut rng).0;
            frame.world_from_camera = kinect.camera.world_from_camera(pose);
            looks.push(frame);
        }
        (scene.furniture[0].footprint(), looks)
    }

    fn seen(looks: &[RgbdFrame], outline: &Polygon) -> FreeSpace {
        let mut space = FreeSpace::default();
        looks.iter().for_each(|frame| {
            space.take_in(frame, [(outline, 0.0)].into_iter());
        });
        space
    }

    fn grid_with(space: &FreeSpace, outline: &Polygon) -> ClearanceGrid {
        let mut grid = ClearanceGrid::new(vec2(0.0, 0.0), vec2(9.0, 9.0), 0.1, 0.8);
        space.add_to(&mut grid, outline, 0.0);
        grid
    }

    #[test]
    fn where_an_outline_reaches_too_far_there_is_room() {
        let (_, looks) = table();
        let believed = Polygon::rectangle(Pose::new(4.6, 4.8, 0.0), 2.6, 2.6);
        let (before, after) =
            (grid_with(&FreeSpace::default(), &believed), grid_with(&seen(&looks, &believed), &believed));
        let beside = |grid: &ClearanceGrid| grid.clearance(grid.cell(vec2(4.6, 3.95)));
        assert!(beside(&before) == 0.0 && beside(&after) > 0.3, "{}", beside(&after));
    }

    #[test]
    fn below_a_table_there_is_none_though_the_floor_shows() {
        let (outline, looks) = table();
        let space = seen(&looks, &outline);
        let middle = outline.centroid();
        let inner = Polygon::new(outline.corners().iter().map(|corner| middle + (corner - middle) * 0.8).collect());
        let cells = cells_of(&inner, 0.0);
        assert!(cells.len() > 200 && !cells.iter().any(|cell| space.is_empty(*cell)));
    }

    #[test]
    fn a_piece_where_there_is_only_air_is_refuted_and_a_true_one_is_not() {
        let (outline, looks) = table();
        let phantom = Polygon::rectangle(Pose::new(4.6, 3.4, 0.3), 0.6, 0.5);
        assert!(seen(&looks, &phantom).refutes(&phantom));
        assert!(!seen(&looks, &outline).refutes(&outline));
    }
}

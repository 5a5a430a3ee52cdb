//! All frames of a scene as one record: the furniture, and a grid map of what is free, filled and unseen.

use schemars::JsonSchema;
use serde::Serialize;

use super::View;
use super::floor_grid::project;
use super::fusion::FurnitureMap;
use super::points::points;
use super::stage::text_line;
use crate::frame::RgbdFrame;
use crate::geometry::{Vec2, vec2};
use crate::record::Detection;

/// Side of a cell of the map, metres.
const MAP_CELL_M: f64 = 0.1;

/// One frame's part in a scene.
#[derive(Clone, Debug)]
pub struct SceneView {
    scene: String,
    frame: String,
    furniture: Vec<Detection>,
    /// Places of floor and of what stands on it, metres.
    free: Vec<Vec2>,
    filled: Vec<Vec2>,
}

impl SceneView {
    /// What `frame` showed of `scene`.
    pub fn new(scene: String, name: String, frame: &RgbdFrame, view: View) -> Self {
        let points = points(frame);
        let grid = project(frame, &points);
        let places = |is: fn(u16, u16) -> bool| -> Vec<Vec2> {
            let cells = grid.cells.iter().enumerate().filter(|(_, cell)| is(cell.floor, cell.count));
            cells.map(|(index, _)| points.camera.to_world(grid.centre(index))).collect()
        };
        let (free, filled) = (places(|floor, count| floor > 0 && count == 0), places(|_, count| count > 0));
        Self { scene, frame: name, furniture: view.furniture, free, filled }
    }
}

/// The scene a frame's name tells: all before its last underscore.
pub fn scene_of(frame: &str) -> &str {
    frame.rsplit_once('_').map_or(frame, |(scene, _)| scene)
}

/// Scenes in the order in which they appear.
#[derive(Clone, Debug, Default)]
pub struct Scenes {
    scenes: Vec<(SceneRecord, FurnitureMap, Vec<SceneView>)>,
}

/// What the frames of one scene show together.
#[derive(Clone, Debug, Default, Serialize, JsonSchema)]
pub struct SceneRecord {
    /// Its name.
    pub scene: String,
    /// Its frames.
    pub frames: Vec<String>,
    /// The furniture.
    pub detections: Vec<Detection>,
    /// Where floor was seen, and where something stands.
    pub grid: GridMap,
}

/// A map of the floor: `#` something stands there, `.` free, a blank where nothing was seen.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct GridMap {
    /// The corner of the lowest, leftmost cell, metres.
    pub low: [f64; 2],
    /// Side of a cell, metres.
    pub cell_m: f64,
    /// Rows from north to south, columns from west to east.
    pub rows: Vec<String>,
}

impl Scenes {
    /// Adds a frame.
    pub fn add(&mut self, view: SceneView) {
        let known = self.scenes.iter().position(|(record, _, _)| record.scene == view.scene);
        let at = known.unwrap_or_else(|| {
            let record = SceneRecord { scene: view.scene.clone(), ..SceneRecord::default() };
            self.scenes.push((record, FurnitureMap::default(), Vec::new()));
            self.scenes.len() - 1
        });
        let (record, map, views) = &mut self.scenes[at];
        record.frames.push(view.frame.clone());
        map.add(&view.furniture);
        views.push(view);
    }

    /// One record a scene.
    pub fn fused(self) -> impl Iterator<Item = SceneRecord> {
        self.scenes.into_iter().map(|(record, map, views)| SceneRecord {
            detections: map.furniture(),
            grid: GridMap::of(&views),
            ..record
        })
    }
}

impl SceneRecord {
    /// For people.
    pub fn text(&self) -> String {
        let head = format!("{}, {} frames", self.scene, self.frames.len());
        let lines = std::iter::once(head).chain(self.detections.iter().map(text_line));
        lines.chain(self.grid.rows.iter().map(|row| row.trim_end().to_string())).collect::<Vec<_>>().join("\n")
    }
}

impl GridMap {
    fn of(views: &[SceneView]) -> Self {
        let all = views.iter().flat_map(|view| view.free.iter().chain(&view.filled));
        let start = (Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY));
        let (low, high) = all.fold(start, |(low, high), p| (low.inf(p), high.sup(p)));
        if !low.x.is_finite() {
            return Self { cell_m: MAP_CELL_M, ..Self::default() };
        }
        let low = vec2((low.x / MAP_CELL_M).floor(), (low.y / MAP_CELL_M).floor()) * MAP_CELL_M;
        let size = (high - low) / MAP_CELL_M;
        let (width, height) = (size.x as usize + 1, size.y as usize + 1);
        let mut cells = vec![b' '; width * height];
        for view in views {
            for (places, mark) in [(&view.free, b'.'), (&view.filled, b'#')] {
                for place in places {
                    let at = (place - low) / MAP_CELL_M;
                    let cell = &mut cells[(at.y as usize).min(height - 1) * width + (at.x as usize).min(width - 1)];
                    *cell = if *cell == b'#' { b'#' } else { mark };
                }
            }
        }
        let row = |cells: &[u8]| cells.iter().map(|cell| char::from(*cell)).collect();
        let rows = cells.chunks(width).rev().map(row).collect();
        let corner = [low.x, low.y].map(|v| crate::record::Rounded(v).value());
        Self { low: corner, cell_m: MAP_CELL_M, rows }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn free_filled_and_unseen_cells_are_told_apart() {
        let view = SceneView {
            scene: "a".to_string(),
            frame: "a_0".to_string(),
            furniture: Vec::new(),
            free: vec![vec2(0.05, 0.05), vec2(0.15, 0.05)],
            filled: vec![vec2(0.15, 0.15), vec2(0.15, 0.05)],
        };
        assert_eq!(GridMap::of(&[view]).rows, [" #", ".#"]);
    }

    #[test]
    fn the_frames_name_tells_the_scene() {
        assert_eq!((scene_of("kitchen_03"), scene_of("alone")), ("kitchen", "alone"));
    }
}

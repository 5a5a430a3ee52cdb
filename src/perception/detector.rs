//! From one RGB-D frame to what is in it.

use super::View;
use super::classify::classify;
use super::floor_grid::project;
use crate::frame::RgbdFrame;
use crate::geometry::vec2;
use crate::world::RoomMap;

/// Finds furniture and small objects in frames.
#[derive(Clone, Debug, Default)]
pub struct Detector {}

impl Detector {
    /// What one frame shows, in the frame's world; `map` tells which surfaces are walls.
    pub fn detect(&self, frame: &RgbdFrame, _map: Option<&RoomMap>) -> View {
        let camera = vec2(frame.world_from_camera[0][3], frame.world_from_camera[1][3]);
        let Some(grid) = project(frame) else { return View::default() };
        let furniture = grid.components().iter().filter_map(|cells| classify(&grid, cells, camera)).collect();
        View { furniture, objects: Vec::new() }
    }
}

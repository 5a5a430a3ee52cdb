//! The shortest ways in a home, all of its furniture known: what a trial's way is held against.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use super::scene::{Item, Scene};
use crate::behavior::{Beliefs, Clearances, Ways, grid_of, length, route};
use crate::map::RoomMap;
use crate::record::Detection;
use crate::robot::p3dx;

/// The shortest ways in one home that were asked for already: many trials are judged by the same.
#[derive(Debug, Default)]
pub(super) struct ShortestWays(Mutex<BTreeMap<String, Option<f64>>>);

impl ShortestWays {
    pub(super) fn to(&self, map: &RoomMap, scene: &Scene, item: &Item) -> Option<f64> {
        let known = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(way) = known().get(&item.id) {
            return *way;
        }
        let way = shortest_way(map, scene, item);
        known().insert(item.id.clone(), way);
        way
    }
}

impl Clone for ShortestWays {
    /// A copy of a home is made to be changed: nothing is known of it.
    fn clone(&self) -> Self {
        Self::default()
    }
}

/// Metres from the start to where a piece can be looked at, all furniture known.
fn shortest_way(map: &RoomMap, scene: &Scene, item: &Item) -> Option<f64> {
    let rooms = grid_of(map);
    let mut grid = rooms.clone();
    for other in &scene.furniture {
        grid.add_polygon(&other.footprint());
    }
    let start = map.start.position();
    let piece = Beliefs::of(vec![ideal_detection(item)]).furniture.pop()?;
    let Clearances { to_turn, narrow, .. } = Clearances::of(&p3dx::BODY);
    let ways = Ways { grid: &grid, rooms: &rooms, from: start, to_turn, narrowest: narrow };
    let ways = ways.viewpoints(&piece).into_iter().filter_map(|pose| {
        let way = route(&grid, start, pose.position(), to_turn)?;
        Some(length(start, &way))
    });
    ways.fold(None, |least: Option<f64>, way| Some(least.map_or(way, |l| l.min(way))))
}

/// A piece as eyes without any fault report it, all of it in view.
pub fn ideal_detection(item: &Item) -> Detection {
    let size = item.size();
    Detection {
        category: item.kind().noun.to_string(),
        confidence: 1.0,
        scores: Default::default(),
        x: item.x,
        y: item.y,
        yaw: item.has_front().then_some(item.pose().heading),
        length: size.length,
        width: size.width,
        height: size.height,
        footprint: item.footprint().corners().iter().map(|c| [c.x, c.y]).collect(),
        attributes: item.attributes(),
        why: String::new(),
    }
}

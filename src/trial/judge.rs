//! What a trial was worth, by the truth.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use super::Home;
use crate::behavior::{Beliefs, NARROW_M, SWING_M, Ways, grid_of, length, route};
use crate::geometry::Vec2;
use crate::record::{Detection, Outcome};
use crate::world::Item;

/// The judge's verdict.
#[derive(Clone, Debug, Default)]
pub struct Verdict {
    /// Ids of the furniture approached.
    pub approached: Vec<String>,
    /// The furniture at which the object was found.
    pub target_id: Option<String>,
    /// Whether the first furniture approached holds the object.
    pub right_first: Option<bool>,
    /// Success weighted by path length.
    pub spl: Option<f64>,
}

/// Judges a trial: what was approached, where the object was found, how long the way was against the shortest.
pub fn judge(
    home: &Home,
    object: Option<&str>,
    approached: &[Vec2],
    found_at: Option<Vec2>,
    outcome: Outcome,
    distance_m: f64,
) -> Verdict {
    let id_at = |point: &Vec2| home.scene.furniture_at(*point).map(|item| item.id.clone());
    let holders = holders(home, object);
    // What is not there is the wrong place, too.
    let right_first = approached.first().map(|first| {
        let first = id_at(first);
        holders.iter().any(|item| Some(&item.id) == first.as_ref())
    });
    let approached: Vec<String> = approached.iter().filter_map(id_at).collect();
    let shortest = holders.iter().filter_map(|item| home.ways.to(home, item)).fold(f64::INFINITY, f64::min);
    let spl = if outcome == Outcome::Found && shortest.is_finite() {
        Some(shortest / shortest.max(distance_m).max(1e-9))
    } else {
        (!holders.is_empty()).then_some(0.0)
    };
    let target_id = found_at.and_then(|point| home.scene.furniture_at(point)).map(|item| item.id.clone());
    Verdict { approached, target_id, right_first, spl }
}

/// The furniture that holds the object; any that holds something when none is named.
fn holders<'h>(home: &'h Home, object: Option<&str>) -> Vec<&'h Item> {
    match object {
        Some(name) => home.scene.holders_of(name),
        None => home.scene.objects.iter().filter_map(|object| home.scene.item(&object.on)).collect(),
    }
}

/// The shortest ways in one home that were asked for already: many trials are judged by the same.
#[derive(Debug, Default)]
pub(super) struct ShortestWays(Mutex<BTreeMap<String, Option<f64>>>);

impl ShortestWays {
    fn to(&self, home: &Home, item: &Item) -> Option<f64> {
        let known = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(way) = known().get(&item.id) {
            return *way;
        }
        let way = shortest_way(home, item);
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
fn shortest_way(home: &Home, item: &Item) -> Option<f64> {
    let rooms = grid_of(&home.map);
    let mut grid = rooms.clone();
    for other in &home.scene.furniture {
        grid.add_polygon(&other.footprint());
    }
    let start = home.map.start.position();
    let piece = Beliefs::of(vec![ideal_detection(item)]).furniture.pop()?;
    let ways = Ways { grid: &grid, rooms: &rooms, from: start, narrowest: NARROW_M };
    let ways = ways.viewpoints(&piece).into_iter().filter_map(|pose| {
        let way = route(&grid, start, pose.position(), SWING_M)?;
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

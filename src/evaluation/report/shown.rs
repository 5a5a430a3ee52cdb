//! What the page's script needs to show a trial again: whole centimetres, tenths of seconds, whole degrees.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::geometry::Vec2;
use crate::map::RoomMap;
use crate::record::PathPoint;
use crate::recording::{BelievedPiece, Story, TruePiece};

/// A piece that moved by less is not sent again, centimetres.
const MOVED_CM: i64 = 5;
/// It stands while it moves by no more, centimetres and degrees.
const STANDS: i64 = 1;

/// The home, once for all trials.
#[derive(Serialize)]
pub(super) struct ShownHome {
    /// From, to.
    walls: Vec<[i64; 4]>,
    rooms: Vec<(String, i64, i64)>,
    /// Corners, one after the other.
    pieces: Vec<(String, Vec<i64>)>,
    objects: Vec<(String, i64, i64)>,
}

/// One trial.
#[derive(Serialize)]
pub(super) struct ShownTrial {
    /// Time, x, y, heading.
    path: Vec<[i64; 4]>,
    /// What the robot did and why.
    said: Vec<(i64, String)>,
    /// What has changed in what it believes: the corners of each piece; none where it no longer believes in it.
    believed: Vec<(i64, BTreeMap<String, Vec<i64>>)>,
    looks: Vec<i64>,
}

impl ShownHome {
    pub fn of(map: &RoomMap, truth: &[TruePiece]) -> Self {
        let middle = |room: &crate::map::Room| {
            let at = room.polygon().centroid();
            (room.name.replace('_', " "), cm(at.x), cm(at.y))
        };
        Self {
            walls: map.walls().iter().map(|(a, b)| [cm(a.x), cm(a.y), cm(b.x), cm(b.y)]).collect(),
            rooms: map.rooms.iter().map(middle).collect(),
            pieces: truth.iter().map(|piece| (piece.spoken(), corners(&piece.corners))).collect(),
            objects: truth
                .iter()
                .flat_map(|piece| &piece.holds)
                .map(|(name, at)| (name.replace('_', " "), cm(at.x), cm(at.y)))
                .collect(),
        }
    }
}

impl ShownTrial {
    pub fn of(path: &[PathPoint], story: &Story) -> Self {
        Self {
            path: thinned(path.iter().map(point).collect()),
            said: story.told.iter().map(|(time_s, text)| (tenths(*time_s), text.clone())).collect(),
            believed: changes(&story.believed),
            looks: story.looks.iter().map(|time_s| tenths(*time_s)).collect(),
        }
    }
}

/// Without the points at which the robot stands as it stood.
fn thinned(path: Vec<[i64; 4]>) -> Vec<[i64; 4]> {
    let mut kept: Vec<[i64; 4]> = Vec::new();
    for (at, point) in path.iter().enumerate() {
        let stands = |last: &[i64; 4]| (1..4).all(|axis| (last[axis] - point[axis]).abs() <= STANDS);
        // The last point at which it stands is kept, so that it does not creep until it moves on.
        let moves_on = path.get(at + 1).is_none_or(|next| (1..4).any(|axis| (next[axis] - point[axis]).abs() > STANDS));
        if moves_on || kept.last().is_none_or(|last| !stands(last)) {
            kept.push(*point);
        }
    }
    kept
}

fn point(point: &PathPoint) -> [i64; 4] {
    let pose = point.pose();
    [tenths(point.0.0), cm(pose.x), cm(pose.y), pose.heading.to_degrees().round() as i64]
}

/// What differs from one time to the next.
fn changes(believed: &[(f64, Vec<BelievedPiece>)]) -> Vec<(i64, BTreeMap<String, Vec<i64>>)> {
    let mut shown: BTreeMap<String, Vec<i64>> = BTreeMap::new();
    let mut found = Vec::new();
    for (time_s, pieces) in believed {
        let now: BTreeMap<String, Vec<i64>> = pieces.iter().map(|(name, c)| (name.clone(), corners(c))).collect();
        let mut change: BTreeMap<String, Vec<i64>> =
            shown.keys().filter(|name| !now.contains_key(*name)).map(|name| (name.clone(), Vec::new())).collect();
        change.extend(now.into_iter().filter(|(name, new)| shown.get(name).is_none_or(|old| has_moved(old, new))));
        if !change.is_empty() {
            shown.extend(change.clone());
            shown.retain(|_, corners| !corners.is_empty());
            found.push((tenths(*time_s), change));
        }
    }
    found
}

fn has_moved(old: &[i64], new: &[i64]) -> bool {
    old.len() != new.len() || old.iter().zip(new).any(|(a, b)| (a - b).abs() >= MOVED_CM)
}

fn corners(corners: &[Vec2]) -> Vec<i64> {
    corners.iter().flat_map(|corner| [cm(corner.x), cm(corner.y)]).collect()
}

fn cm(metres: f64) -> i64 {
    (metres * 100.0).round() as i64
}

fn tenths(seconds: f64) -> i64 {
    (seconds * 10.0).round() as i64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::vec2;

    #[test]
    fn only_what_has_changed_is_sent_and_what_is_gone_is_empty() {
        let piece = |name: &str, x: f64| (name.to_string(), vec![vec2(x, 0.0), vec2(x + 1.0, 0.0)]);
        let believed = [
            (0.0, vec![piece("bed 1", 0.0)]),
            (1.0, vec![piece("bed 1", 0.01), piece("desk 1", 3.0)]),
            (2.0, vec![piece("desk 1", 3.2)]),
        ];
        let changes = changes(&believed);
        assert_eq!(changes[0].1["bed 1"], [0, 0, 100, 0]);
        assert_eq!(changes[1].1.keys().collect::<Vec<_>>(), ["desk 1"]);
        assert_eq!((changes[2].0, changes[2].1["bed 1"].len(), changes[2].1["desk 1"][0]), (20, 0, 320));
    }
}

//! Walls: long upright planes with nothing behind them, found in the frame or known from the room map.

use super::floor_grid::{CELL_M, FloorGrid};
use super::points::Points;
use crate::geometry::{Pose, Vec2, cross, distance_to_segment, vec2};
use crate::map::RoomMap;

/// Steps of direction in half a turn, and the width of a step of distance, metres.
const DIRECTIONS: usize = 120;
const DISTANCE_STEP_M: f64 = 0.05;
/// Distances from the camera run to here, metres.
const REACH_M: f64 = 8.0;
/// Not more walls than this are looked for.
const MOST_WALLS: usize = 4;
/// A wall shows at least this length of itself, metres.
const LEAST_LENGTH_M: f64 = 0.7;
/// Higher than any wardrobe, metres.
const ABOVE_FURNITURE_M: f32 = 2.28;

/// A stretch of wall in the camera's frame on the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    /// Its ends, metres; the camera is on the left of the way from one to the other.
    pub ends: (Vec2, Vec2),
}

impl Wall {
    fn between(a: Vec2, b: Vec2) -> Self {
        // The origin is the camera.
        if cross(b - a, -a) < 0.0 { Self { ends: (b, a) } } else { Self { ends: (a, b) } }
    }

    /// Metres from the wall's line, positive on the camera's side.
    fn before(&self, place: Vec2) -> f64 {
        let (a, b) = self.ends;
        cross((b - a).normalize(), place - a)
    }

    /// Metres from the stretch of wall.
    pub fn distance(&self, place: Vec2) -> f64 {
        distance_to_segment(place, self.ends.0, self.ends.1)
    }

    /// Whether a cell is the wall itself, or noise behind it.
    fn swallows(&self, place: Vec2) -> bool {
        let (a, b) = self.ends;
        let along = (place - a).dot(&(b - a).normalize());
        let range = place.norm_squared();
        let before = self.before(place);
        along > -0.3
            && along < (b - a).norm() + 0.3
            && before < 0.045 + 0.0035 * range
            && before > -(0.12 + 0.012 * range)
    }
}

/// The walls of a frame: those of the map where it is given, and those that show themselves.
pub fn walls(grid: &FloorGrid, points: &Points, map: Option<&RoomMap>) -> Vec<Wall> {
    let mut high = high_cells(grid, points);
    let mut walls = map.map_or_else(Vec::new, |map| known_walls(map, points.camera, &high));
    high.retain(|place| !walls.iter().any(|wall| wall.distance(*place) < 0.15));
    for _ in 0..MOST_WALLS {
        let Some((wall, support)) = longest_line(&high) else { break };
        if is_wall(&wall, grid, &high) {
            walls.push(support.stretch(&high).unwrap_or(wall));
        }
        high.retain(|place| !support.contains_line(*place));
        if high.len() < 30 {
            break;
        }
    }
    walls
}

/// Cells that reach as high as the picture shows, or nearly.
fn high_cells(grid: &FloorGrid, points: &Points) -> Vec<Vec2> {
    let reaches = |index: &usize| {
        let ahead = ((index / grid.width) as f64 * CELL_M) as f32;
        let shown = points.camera_height + points.climb * ahead;
        grid.cells[*index].count > 0 && grid.cells[*index].top > (shown - 0.2).min(1.85)
    };
    (0..grid.cells.len()).filter(reaches).map(|index| grid.centre(index)).collect()
}

/// The map's walls near to what is high, each moved onto it: the robot's pose is only believed.
fn known_walls(map: &RoomMap, camera: Pose, high: &[Vec2]) -> Vec<Wall> {
    const BELIEF_M: f64 = 0.25;
    let local = map.walls().into_iter().map(|(a, b)| Wall::between(camera.to_local(a), camera.to_local(b)));
    let near = local.filter(|wall| wall.distance(Vec2::zeros()) < 7.0 && (wall.ends.1 - wall.ends.0).norm() > 0.05);
    near.map(|wall| {
        let beside: Vec<Vec2> = high.iter().copied().filter(|p| wall.distance(*p) < BELIEF_M).collect();
        let length = (wall.ends.1 - wall.ends.0).norm();
        let refined = Line::through(&beside).filter(|_| beside.len() > 25);
        match refined.and_then(|line| line.like(&wall)) {
            Some(line) if length > 0.6 => {
                let on = |p: Vec2| line.at + line.along * (p - line.at).dot(&line.along);
                Wall::between(on(wall.ends.0), on(wall.ends.1))
            }
            _ => wall,
        }
    })
    .collect()
}

/// A line in the plane.
#[derive(Clone, Copy, Debug)]
struct Line {
    at: Vec2,
    along: Vec2,
}

impl Line {
    /// The principal axis of some places.
    fn through(places: &[Vec2]) -> Option<Self> {
        if places.len() < 8 {
            return None;
        }
        let at = places.iter().sum::<Vec2>() / places.len() as f64;
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for d in places.iter().map(|place| place - at) {
            xx += d.x * d.x;
            xy += d.x * d.y;
            yy += d.y * d.y;
        }
        let heading = (2.0 * xy).atan2(xx - yy) / 2.0;
        Some(Self { at, along: vec2(heading.cos(), heading.sin()) })
    }

    fn distance(&self, place: Vec2) -> f64 {
        cross(self.along, place - self.at).abs()
    }

    fn contains_line(&self, place: Vec2) -> bool {
        self.distance(place) < 0.06 + 0.006 * place.norm_squared()
    }

    /// All of the line that is covered, over the gaps too.
    fn stretch(&self, places: &[Vec2]) -> Option<Wall> {
        let along = places.iter().filter(|p| self.contains_line(**p)).map(|p| (p - self.at).dot(&self.along));
        let (first, last) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), t| (a.min(t), b.max(t)));
        (first < last).then(|| Wall::between(self.at + self.along * first, self.at + self.along * last))
    }

    /// This line, when it runs like the wall within 6°.
    fn like(self, wall: &Wall) -> Option<Self> {
        let along = (wall.ends.1 - wall.ends.0).normalize();
        (cross(along, self.along).abs() < 0.1).then_some(self)
    }
}

/// The line on which most high cells lie, by a Hough transform refined by its inliers, and the stretch they cover.
fn longest_line(high: &[Vec2]) -> Option<(Wall, Line)> {
    let bins = (2.0 * REACH_M / DISTANCE_STEP_M) as usize;
    let mut votes = vec![0_u32; DIRECTIONS * bins];
    let normals: Vec<Vec2> = (0..DIRECTIONS)
        .map(|i| std::f64::consts::PI * i as f64 / DIRECTIONS as f64)
        .map(|angle| vec2(angle.cos(), angle.sin()))
        .collect();
    for place in high.iter().step_by(1 + high.len() / 1500) {
        for (i, normal) in normals.iter().enumerate() {
            let bin = ((normal.dot(place) + REACH_M) / DISTANCE_STEP_M) as usize;
            votes[i * bins + bin.min(bins - 1)] += 1;
        }
    }
    let best = (0..votes.len()).max_by_key(|i| (votes[*i], std::cmp::Reverse(*i)))?;
    let normal = normals[best / bins];
    let distance = ((best % bins) as f64 + 0.5) * DISTANCE_STEP_M - REACH_M;
    let mut line = Line { at: normal * distance, along: vec2(-normal.y, normal.x) };
    for _ in 0..2 {
        let inliers: Vec<Vec2> = high.iter().copied().filter(|p| line.contains_line(*p)).collect();
        line = Line::through(&inliers)?;
    }
    let mut along: Vec<f64> =
        high.iter().filter(|p| line.contains_line(**p)).map(|p| (p - line.at).dot(&line.along)).collect();
    along.sort_by(f64::total_cmp);
    let (first, last) = longest_run(&along)?;
    Some((Wall::between(line.at + line.along * first, line.at + line.along * last), line))
}

/// First and last of the longest stretch without a wide gap: where the line meets another wall is no part of it.
fn longest_run(sorted: &[f64]) -> Option<(f64, f64)> {
    const GAP_M: f64 = 0.3;
    let mut best: Option<(f64, f64)> = None;
    let mut start = *sorted.first()?;
    for (i, &t) in sorted.iter().enumerate() {
        if sorted.get(i + 1).is_none_or(|next| next - t > GAP_M) {
            if best.is_none_or(|(a, b)| t - start > b - a) {
                best = Some((start, t));
            }
            start = sorted.get(i + 1).copied().unwrap_or(t);
        }
    }
    best
}

/// A wall hides what is behind it beyond its ends too; round a wardrobe's ends the room goes on.
fn is_wall(wall: &Wall, grid: &FloorGrid, high: &[Vec2]) -> bool {
    let (a, b) = wall.ends;
    let length = (b - a).norm();
    if length < LEAST_LENGTH_M {
        return false;
    }
    let along = (b - a) / length;
    let tallest = high.iter().filter(|p| wall.distance(**p) < 0.15).filter_map(|p| grid.index(*p));
    let above = tallest.filter(|index| grid.cells[*index].top > ABOVE_FURNITURE_M).count();
    let away = vec2(along.y, -along.x);
    let open = |end: Vec2, outward: Vec2| {
        let places = (0..24).flat_map(|i| (0..24).map(move |j| (0.08 + 0.025 * f64::from(i), f64::from(j) * 0.025)));
        let margin = 0.12 + 0.012 * end.norm_squared();
        let seen = places.filter(|(out, behind)| {
            let place = end + outward * *out + away * (margin + behind);
            grid.index(place).is_some_and(|index| grid.cells[index].count + grid.cells[index].floor > 0)
        });
        seen.count() > 8
    };
    let (left, right) = (open(a, -along), open(b, along));
    let tall = above > 12;
    match (left, right) {
        (false, false) => true,
        (true, true) => length > if tall { 2.6 } else { 3.4 },
        _ => tall || length > 2.6,
    }
}

/// Which cells hold furniture: something between floor and ceiling that is no wall.
pub fn furniture_cells(grid: &FloorGrid, walls: &[Wall]) -> Vec<bool> {
    let is_furniture = |(index, cell): (usize, &super::floor_grid::CellStack)| {
        cell.count > 0 && !walls.iter().any(|wall| wall.swallows(grid.centre(index)))
    };
    grid.cells.iter().enumerate().map(is_furniture).collect()
}

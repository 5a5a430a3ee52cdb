//! From where to look at a piece of furniture so that a small object on it can be recognised.

use std::f64::consts::{PI, TAU};

use super::Furniture;
use super::driving::NARROW_M;
use super::pilot::SWING_M;
use super::route::{length, route};
use crate::geometry::{ClearanceGrid, Pose, Vec2, vec2, wrap_angle};

/// Directions tried round the furniture.
const DIRECTIONS: usize = 16;
/// From the furniture's edge to the robot's centre at least, metres.
const FROM_EDGE_M: f64 = 0.5;
/// From the furniture's middle to the camera at least: nearer, what lies on a low top leaves the picture below.
const FROM_MIDDLE_M: f64 = 1.15;
/// How much farther than that is still good: beyond, small things blur.
const SLACK_M: f64 = 0.6;
/// From a small object to the camera, where it is best seen.
const BEST_VIEW_M: f64 = 1.25;
/// Furniture longer than this may hide an object at its far end, so it is looked at from both sides.
const LONG_M: f64 = 1.2;

/// From here a piece of furniture is seen whole and large, metres.
const STUDY_M: f64 = 2.2;
/// So far round a piece from where it was looked at before, it is another look, radians.
const OTHER_SIDE_RAD: f64 = PI / 3.0;

/// Nothing is seen through a wall: a line of sight keeps this clear of them, metres.
const SIGHT_M: f64 = 0.06;

/// Poses from which to look at `furniture`, the cheapest to reach first; for long furniture also one from across.
/// What was looked at before is looked at from other sides, where that can be done.
///
/// `rooms` is the grid of the rooms alone, `grid` has all known furniture as well.
pub fn viewpoints(grid: &ClearanceGrid, rooms: &ClearanceGrid, from: Vec2, furniture: &Furniture) -> Vec<Pose> {
    // Outlines that are believed too large leave a gap too narrow that is wide enough.
    let roomy = viewpoints_at(grid, rooms, from, furniture, SWING_M);
    if roomy.is_empty() { viewpoints_at(grid, rooms, from, furniture, NARROW_M) } else { roomy }
}

/// The same, keeping `clear` metres from everything on the way.
fn viewpoints_at(
    grid: &ClearanceGrid,
    rooms: &ClearanceGrid,
    from: Vec2,
    furniture: &Furniture,
    clear: f64,
) -> Vec<Pose> {
    let centre = furniture.centre();
    let mut places: Vec<(f64, Vec2)> = (0..DIRECTIONS)
        .filter_map(|i| free_place(grid, furniture, TAU * i as f64 / DIRECTIONS as f64, clear))
        .filter(|&point| rooms.clearance_along(point, centre) >= SIGHT_M)
        .map(|point| ((point - from).norm() + 0.5 * (point - centre).norm(), point))
        .collect();
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    let fresh: Vec<(f64, Vec2)> =
        places.iter().copied().filter(|(_, point)| is_other_side(furniture, *point)).collect();
    let first = cheapest(grid, from, &fresh, clear).or_else(|| cheapest(grid, from, &places, clear));
    let Some(first) = first else { return Vec::new() };
    let mut poses = vec![facing(first, centre)];
    if furniture.detection.length.max(furniture.detection.width) > LONG_M {
        let across =
            |point: &Vec2| crate::geometry::angle_between(bearing(centre, *point), bearing(centre, first)) > PI / 2.0;
        let others: Vec<(f64, Vec2)> = places.into_iter().filter(|(_, point)| across(point)).collect();
        poses.extend(cheapest(grid, first, &others, clear).map(|point| facing(point, centre)));
    }
    poses
}

/// A pose from which it is best told what `furniture` is: the whole of it in the picture, large. The cheapest to reach.
pub fn vantage(grid: &ClearanceGrid, rooms: &ClearanceGrid, from: Vec2, furniture: &Furniture) -> Option<Pose> {
    let centre = furniture.centre();
    let around = (0..DIRECTIONS).map(|i| TAU * i as f64 / DIRECTIONS as f64);
    let mut places: Vec<(f64, Vec2)> = around
        .map(|angle| centre + vec2(angle.cos(), angle.sin()) * STUDY_M)
        .filter(|&point| grid.clearance(grid.cell(point)) >= SWING_M + 0.05)
        .filter(|&point| rooms.clearance_along(point, centre) >= SIGHT_M)
        .map(|point| ((point - from).norm(), point))
        .collect();
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    cheapest(grid, from, &places, SWING_M).map(|point| facing(point, centre))
}

/// Whether `furniture` was never looked at from the side of `point`.
fn is_other_side(furniture: &Furniture, point: Vec2) -> bool {
    let centre = furniture.centre();
    let turn = |from: &Vec2| crate::geometry::angle_between(bearing(centre, point), bearing(centre, *from));
    furniture.looked_from.iter().all(|from| turn(from) > OTHER_SIDE_RAD)
}

/// A pose from which an object at `point` is well seen: at the best distance, on the side where the robot is.
pub fn better_view(grid: &ClearanceGrid, rooms: &ClearanceGrid, from: Vec2, point: Vec2) -> Option<Pose> {
    let toward = bearing(point, from);
    let turns = [0.0, 0.3, -0.3, 0.6, -0.6, 1.0, -1.0];
    let place = |turn: &f64| point + vec2((toward + turn).cos(), (toward + turn).sin()) * BEST_VIEW_M;
    let free =
        |place: &Vec2| grid.clearance(grid.cell(*place)) >= SWING_M && rooms.clearance_along(*place, point) >= SIGHT_M;
    turns.iter().map(place).find(free).map(|place| facing(place, point))
}

/// The nearest free place to the furniture in one direction from it.
fn free_place(grid: &ClearanceGrid, furniture: &Furniture, angle: f64, clear: f64) -> Option<Vec2> {
    let centre = furniture.centre();
    let direction = vec2(angle.cos(), angle.sin());
    let edge = furniture.footprint.corners().iter().map(|c| (c - centre).dot(&direction)).fold(0.0, f64::max);
    let nearest = (edge + FROM_EDGE_M).max(FROM_MIDDLE_M);
    let steps = (SLACK_M / 0.1) as usize;
    let place = |i: usize| centre + direction * (nearest + 0.1 * i as f64);
    (0..=steps).map(place).find(|&point| grid.clearance(grid.cell(point)) >= clear + 0.05)
}

/// The places come sorted by straight distance; the first few that have a way are compared by its length.
fn cheapest(grid: &ClearanceGrid, from: Vec2, places: &[(f64, Vec2)], clear: f64) -> Option<Vec2> {
    let reachable = places.iter().filter_map(|&(_, point)| {
        let points = route(grid, from, point, clear)?;
        let end = points.last().copied().unwrap_or(from);
        ((end - point).norm() < 0.15).then(|| (length(from, &points), point))
    });
    reachable.take(3).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, point)| point)
}

fn bearing(from: Vec2, to: Vec2) -> f64 {
    (to.y - from.y).atan2(to.x - from.x)
}

fn facing(point: Vec2, centre: Vec2) -> Pose {
    Pose::new(point.x, point.y, wrap_angle(bearing(point, centre)))
}

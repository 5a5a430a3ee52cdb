//! From where to look at a piece of furniture so that a small object on it can be recognised.

use std::f64::consts::{PI, TAU};

use super::Furniture;
use super::route::{length, route};
use crate::geometry::{ClearanceGrid, Pose, Vec2, angle_between, vec2, wrap_angle};

/// Directions tried round the furniture.
const DIRECTIONS: usize = 16;
/// From the furniture's edge to the robot's centre at least, metres.
const FROM_EDGE_M: f64 = 0.5;
/// From the furniture's middle to the camera at least: nearer, what lies on a low top leaves the picture below.
const FROM_MIDDLE_M: f64 = 1.15;
/// How much farther than that is still good: beyond, small things blur.
const SLACK_M: f64 = 0.6;
/// From a small object to the camera, where it is best seen, and where else it is well seen.
const VIEWS_M: [f64; 3] = [1.25, 1.5, 1.75];
/// Round an object from the side where the robot is, radians.
const VIEW_TURNS: [f64; 13] = [0.0, 0.3, -0.3, 0.6, -0.6, 1.0, -1.0, 1.5, -1.5, 2.1, -2.1, 2.7, -2.7];
/// Furniture longer than this may hide an object at its far end, so it is looked at from both sides.
const LONG_M: f64 = 1.2;

/// From here a piece of furniture is seen whole and large, metres.
const STUDY_M: f64 = 2.2;
/// So far round a piece from where it was looked at before, it is another look, radians.
const OTHER_SIDE_RAD: f64 = PI / 3.0;

/// Nothing is seen through a wall: a line of sight keeps this clear of them, metres.
const SIGHT_M: f64 = 0.06;

/// Where the robot is, and where it can go.
#[derive(Clone, Copy)]
pub struct Ways<'g> {
    /// The rooms and all known furniture.
    pub grid: &'g ClearanceGrid,
    /// The rooms alone.
    pub rooms: &'g ClearanceGrid,
    /// Where the robot is.
    pub from: Vec2,
    /// What it needs round it to turn in place, metres.
    pub to_turn: f64,
    /// What a way keeps clear where it is nowhere wider, metres.
    pub narrowest: f64,
}

impl Ways<'_> {
    /// Poses from which to look at `furniture`, the cheapest to reach first; for long furniture also one from across.
    /// What was looked at before is looked at from other sides, where that can be done.
    pub fn viewpoints(&self, furniture: &Furniture) -> Vec<Pose> {
        // Outlines that are believed too large leave a gap too narrow that is wide enough.
        let roomy = self.viewpoints_at(furniture, self.to_turn);
        if roomy.is_empty() { self.viewpoints_at(furniture, self.narrowest) } else { roomy }
    }

    /// The same, keeping `clear` metres from everything on the way.
    fn viewpoints_at(&self, furniture: &Furniture, clear: f64) -> Vec<Pose> {
        let centre = furniture.centre();
        let mut places: Vec<(f64, Vec2)> = (0..DIRECTIONS)
            .filter_map(|i| self.free_place(furniture, TAU * i as f64 / DIRECTIONS as f64, clear))
            .filter(|&point| self.sees(point, centre))
            .map(|point| ((point - self.from).norm() + 0.5 * (point - centre).norm(), point))
            .collect();
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        let fresh: Vec<(f64, Vec2)> =
            places.iter().copied().filter(|(_, point)| is_other_side(furniture, *point)).collect();
        let first = self.cheapest(&fresh, clear).or_else(|| self.cheapest(&places, clear));
        let Some(first) = first else { return Vec::new() };
        let mut poses = vec![facing(first, centre)];
        if furniture.detection().length.max(furniture.detection().width) > LONG_M {
            let across = |point: &Vec2| angle_between(bearing(centre, *point), bearing(centre, first)) > PI / 2.0;
            let others: Vec<(f64, Vec2)> = places.into_iter().filter(|(_, point)| across(point)).collect();
            let there = Self { from: first, ..*self };
            poses.extend(there.cheapest(&others, clear).map(|point| facing(point, centre)));
        }
        poses
    }

    /// A pose from which it is best told what `furniture` is: the whole of it in the picture, large. The cheapest to reach.
    pub fn vantage(&self, furniture: &Furniture) -> Option<Pose> {
        let centre = furniture.centre();
        let around = (0..DIRECTIONS).map(|i| TAU * i as f64 / DIRECTIONS as f64);
        let mut places: Vec<(f64, Vec2)> = around
            .map(|angle| centre + vec2(angle.cos(), angle.sin()) * STUDY_M)
            .filter(|&point| self.is_clear(point, self.to_turn + 0.05) && self.sees(point, centre))
            .map(|point| ((point - self.from).norm(), point))
            .collect();
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        self.cheapest(&places, self.to_turn).map(|point| facing(point, centre))
    }

    /// A pose from which an object at `point` is well seen: at the best distance, on the side where the robot is, as far
    /// as there is a free place.
    pub fn better_view(&self, point: Vec2) -> Option<Pose> {
        let toward = bearing(point, self.from);
        let place = |away: f64| move |turn: f64| point + vec2((toward + turn).cos(), (toward + turn).sin()) * away;
        let view = |clear: f64| {
            let free = |place: &Vec2| self.is_clear(*place, clear) && self.sees(*place, point);
            VIEWS_M.into_iter().find_map(|away| VIEW_TURNS.into_iter().map(place(away)).find(free))
        };
        view(self.to_turn).or_else(|| view(self.narrowest)).map(|place| facing(place, point))
    }

    fn is_clear(&self, point: Vec2, clear: f64) -> bool {
        self.grid.clearance(self.grid.cell(point)) >= clear
    }

    /// Whether no wall is between two points.
    fn sees(&self, from: Vec2, to: Vec2) -> bool {
        self.rooms.clearance_along(from, to) >= SIGHT_M
    }

    /// The nearest free place to the furniture in one direction from it.
    fn free_place(&self, furniture: &Furniture, angle: f64, clear: f64) -> Option<Vec2> {
        let centre = furniture.centre();
        let direction = vec2(angle.cos(), angle.sin());
        let edge = furniture.footprint().corners().iter().map(|c| (c - centre).dot(&direction)).fold(0.0, f64::max);
        let nearest = (edge + FROM_EDGE_M).max(FROM_MIDDLE_M);
        let steps = (SLACK_M / 0.1) as usize;
        let place = |i: usize| centre + direction * (nearest + 0.1 * i as f64);
        (0..=steps).map(place).find(|&point| self.is_clear(point, clear + 0.05))
    }

    /// The places come sorted by straight distance; the first few that have a way are compared by its length.
    fn cheapest(&self, places: &[(f64, Vec2)], clear: f64) -> Option<Vec2> {
        let reachable = places.iter().filter_map(|&(_, point)| {
            let points = route(self.grid, self.from, point, clear)?;
            let end = points.last().copied().unwrap_or(self.from);
            ((end - point).norm() < 0.15).then(|| (length(self.from, &points), point))
        });
        reachable.take(3).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, point)| point)
    }
}

/// Whether `furniture` was never looked at from the side of `point`.
fn is_other_side(furniture: &Furniture, point: Vec2) -> bool {
    let centre = furniture.centre();
    let turn = |from: &Vec2| angle_between(bearing(centre, point), bearing(centre, *from));
    furniture.looked_from.iter().all(|from| turn(from) > OTHER_SIDE_RAD)
}

fn bearing(from: Vec2, to: Vec2) -> f64 {
    (to.y - from.y).atan2(to.x - from.x)
}

fn facing(point: Vec2, centre: Vec2) -> Pose {
    Pose::new(point.x, point.y, wrap_angle(bearing(point, centre)))
}

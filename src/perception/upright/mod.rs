//! Where the camera was, when nobody says: over the floor that the depth shows, looking along x.
//!
//! For pictures without a pose, of a lab's own, a data set or a camera held in the hand. Which way is up, level and
//! upright surfaces tell together; the floor is the lowest level surface, under which nothing is. Which way is north no
//! picture tells. Where no surface is surely the floor, this says so: a pose over a bed or a table top would lift all
//! furniture by half a metre.

mod level;
mod surface;

use std::ops::RangeInclusive;

use level::{Evidence, HEIGHTS_M, Level};
pub use surface::Depths;
use surface::{Point, Surface, surfaces};

use crate::record::PoseSource;

/// Surfaces from which a level plane is tried.
const TRIES: usize = 400;
/// Directions up that are followed down to the lowest surface, and planes that are refined.
const BEST: usize = 24;
/// Where the lowest surface is looked for: so large a share of all points may lie under it.
const LOWEST: [f64; 5] = [0.002, 0.005, 0.01, 0.02, 0.04];
/// A height or tilt that is told holds within this, metres and degrees.
const TOLD_M: f64 = 0.12;
const TOLD_DEG: f64 = 5.0;
/// Heights that can be told of a camera, metres.
pub const CAMERA_HEIGHTS_M: RangeInclusive<f64> = 0.05..=5.0;
/// Tilts that can be told of a camera, degrees down.
pub const CAMERA_TILTS_DEG: RangeInclusive<f64> = -45.0..=80.0;
/// Level and upright surfaces that agree on a direction up, as a share of all: fewer tell nothing.
const LEAST_GRAVITY: f64 = 0.12;

/// What is known of a camera beforehand.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Told {
    /// Metres above the floor.
    pub height_m: Option<f64>,
    /// Looking down by this much, degrees.
    pub tilt_deg: Option<f64>,
}

/// Why a picture does not tell where its camera was.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NoPose {
    /// Nothing in it is level or upright.
    #[error("no floor shows from which it could be told")]
    Nothing,
    /// Up is known, and no floor.
    #[error("no floor shows; level and upright surfaces tell only that the camera looks {tilt_deg:.0}° down")]
    NoFloor {
        /// Degrees.
        tilt_deg: f64,
    },
    /// The lowest surface may be something else.
    #[error("what might be the floor, {height_m:.2} m below the camera, may as well be the top of something")]
    Unsure {
        /// Metres.
        height_m: f64,
    },
}

type Pose = [[f64; 4]; 4];

impl Told {
    fn allows(&self, level: &Level) -> bool {
        self.height_m.is_none_or(|height| (height - level.height).abs() < TOLD_M) && self.allows_tilt(level)
    }

    fn allows_tilt(&self, level: &Level) -> bool {
        self.tilt_deg.is_none_or(|tilt| (tilt - level.tilt_deg()).abs() < TOLD_DEG)
    }

    /// The camera held level, when both are told.
    fn level(&self) -> Option<Level> {
        let (sin, cos) = self.tilt_deg?.to_radians().sin_cos();
        Some(Level { up: Point::new(0.0, -cos, -sin), height: self.height_m? })
    }
}

/// The camera's pose over the floor it sees, 4 × 4 by rows as `T_world_cam` has it: at x = y = 0, looking along x.
///
/// # Errors
/// When no surface is surely the floor and what is told does not make up for it.
pub fn camera_over_floor(depths: &Depths, told: Told) -> Result<(Pose, PoseSource), NoPose> {
    let surfaces = surfaces(depths);
    let hypotheses = hypotheses(&surfaces);
    match floor(&hypotheses, &surfaces, told) {
        Some((level, evidence)) if told.height_m.is_some() && evidence.is_floor_as_told() || evidence.is_floor() => {
            Ok((pose(&level), PoseSource::Floor))
        }
        found => without_floor(&hypotheses, &surfaces, told, found.map(|(level, _)| level)),
    }
}

/// A pose by what is told, with gravity by what the picture shows.
fn without_floor(
    hypotheses: &[Level],
    surfaces: &[Surface],
    told: Told,
    found: Option<Level>,
) -> Result<(Pose, PoseSource), NoPose> {
    if let Some(level) = told.level() {
        return Ok((pose(&level), PoseSource::Told));
    }
    let Some(level) = gravity(hypotheses, surfaces, told) else { return Err(NoPose::Nothing) };
    if let Some(height) = told.height_m {
        return Ok((pose(&Level { height, ..level }), PoseSource::Gravity));
    }
    match found.filter(|level| HEIGHTS_M.contains(&level.height)) {
        Some(level) => Err(NoPose::Unsure { height_m: level.height }),
        None => Err(NoPose::NoFloor { tilt_deg: level.tilt_deg() }),
    }
}

/// The plane for which most speaks, among those that what is told allows.
fn floor(hypotheses: &[Level], surfaces: &[Surface], told: Told) -> Option<(Level, Evidence)> {
    let score = |level: &Level| level.evidence(surfaces.iter().step_by(3)).score();
    let lowest = best(hypotheses.iter().map(|l| (l.evidence(surfaces.iter().step_by(3)).gravity(), *l)))
        .into_iter()
        .flat_map(|level| lowest(level.up, surfaces));
    let tried = hypotheses.iter().copied().chain(lowest).chain(told.level());
    let tried = tried.filter(|level| level.is_plausible() && told.allows(level)).map(|level| (score(&level), level));
    let refined = best(tried).into_iter().map(|level| {
        let again = |level: Level| level.refined(surfaces).filter(|level| told.allows(level));
        let refined = again(level).and_then(again).and_then(again).unwrap_or(level);
        (refined, refined.evidence(surfaces.iter()))
    });
    refined.max_by(|a, b| a.1.score().total_cmp(&b.1.score()))
}

/// The direction up with most level and upright surfaces.
fn gravity(hypotheses: &[Level], surfaces: &[Surface], told: Told) -> Option<Level> {
    let walls = upright_pairs(surfaces);
    let tried = hypotheses.iter().copied().chain(walls).filter(|level| told.allows_tilt(level));
    let weighed = tried.map(|level| (level.evidence(surfaces.iter().step_by(3)).gravity(), level));
    let (weight, level) = weighed.max_by(|a, b| a.0.total_cmp(&b.0))?;
    (weight > LEAST_GRAVITY).then_some(level)
}

/// Level planes through surfaces all over the picture, each as its like neighbours lie.
fn hypotheses(surfaces: &[Surface]) -> Vec<Level> {
    let level = |s: &&Surface| s.normal.is_some_and(|up| Level { up, height: 1.0 }.is_plausible());
    let level: Vec<Surface> = surfaces.iter().filter(level).copied().collect();
    let smoothed = |surface: &Surface| {
        let up = surface.normal?;
        let near = level.iter().filter(|other| (other.at - surface.at).norm() < 0.4);
        let like = near.filter_map(|other| other.normal).filter(|normal| normal.dot(&up) > 0.93);
        let up = like.sum::<Point>().try_normalize(1e-9)?;
        Some(Level::through(up, &surface.at)).filter(Level::is_plausible)
    };
    level.iter().step_by(1 + level.len() / TRIES).filter_map(smoothed).collect()
}

/// Directions up from two walls that meet.
fn upright_pairs(surfaces: &[Surface]) -> impl Iterator<Item = Level> {
    let normals: Vec<Point> = surfaces.iter().filter_map(|s| s.normal).filter(|n| n.y.abs() < 0.7).collect();
    let step = 1 + normals.len() / 40;
    let some: Vec<Point> = normals.into_iter().step_by(step).collect();
    let pairs = some.clone().into_iter().enumerate().flat_map(move |(i, a)| {
        some[i + 1..].iter().map(move |b| a.cross(b)).filter(|up| up.norm() > 0.5).collect::<Vec<_>>()
    });
    let ups = pairs.map(|up| up.normalize() * -up.y.signum());
    ups.map(|up| Level { up, height: 1.0 }).filter(Level::is_plausible)
}

/// Planes near the lowest points.
fn lowest(up: Point, surfaces: &[Surface]) -> impl Iterator<Item = Level> {
    let mut below: Vec<f64> = surfaces.iter().map(|surface| -up.dot(&surface.at)).collect();
    below.sort_by(|a, b| b.total_cmp(a));
    LOWEST.into_iter().filter_map(move |share| {
        let height = *below.get((share * below.len() as f64) as usize)?;
        Some(Level { up, height })
    })
}

fn best(weighed: impl Iterator<Item = (f64, Level)>) -> Vec<Level> {
    let mut weighed: Vec<(f64, Level)> = weighed.collect();
    weighed.sort_by(|a, b| b.0.total_cmp(&a.0));
    weighed.into_iter().take(BEST).map(|(_, level)| level).collect()
}

fn pose(Level { up, height }: &Level) -> Pose {
    // x is where the optical axis points along the floor, y to its left.
    let x = (Point::z() - up * up.z).normalize();
    let y = up.cross(&x);
    let row = |axis: Point, at: f64| [axis.x, axis.y, axis.z, at];
    [row(x, 0.0), row(y, 0.0), row(*up, *height), [0.0, 0.0, 0.0, 1.0]]
}

#[cfg(test)]
mod tests;

//! What measures distances, as readings of sonars round the robot's outline: laser scans, ranges, clouds.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use nalgebra::{Isometry3, Point3, Quaternion, Translation3, UnitQuaternion, Vector3};

use super::{Scan, Transform};
use crate::geometry::{Vec2, angle_between, vec2};
use crate::robot::p3dx::SonarArray;
use crate::robot::sonar::HALF_CONE_RAD;
use crate::robot::{Body, SonarReading};

/// Readings made of a scan, all round.
const SECTORS: u32 = 24;
/// Of the beams that look ahead, so many must have measured something, or nothing in reach.
const KNOWN_SHARE: f64 = 0.3;
/// Beams within this of straight ahead look ahead, radians.
const AHEAD_RAD: f64 = 0.7;
/// A chain of frames is no longer than this.
const LONGEST_CHAIN: usize = 16;
/// No more frames are remembered: robots have dozens.
const MOST_FRAMES: usize = 1024;

/// Where the robot's frames are, one in another.
#[derive(Clone, Debug, Default)]
pub struct Frames(BTreeMap<String, (String, Isometry3<f64>)>);

impl Frames {
    /// Takes in what was told.
    pub fn take(&mut self, told: &Transform) {
        let [x, y, z, w] = told.rotation;
        let all = told.translation.iter().chain(&told.rotation);
        if !all.into_iter().all(|value| value.is_finite()) || w * w + x * x + y * y + z * z < 1e-6 {
            return;
        }
        let [a, b, c] = told.translation;
        let rotation = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
        let place = Isometry3::from_parts(Translation3::new(a, b, c), rotation);
        if self.0.len() < MOST_FRAMES || self.0.contains_key(&told.child) {
            self.0.insert(told.child.clone(), (told.header.frame.clone(), place));
        }
    }

    /// Where `frame` is in `base`, when the transforms tell.
    pub fn within(&self, base: &str, frame: &str) -> Option<Isometry3<f64>> {
        let up = |from: &str| {
            let (mut chain, mut name, mut place) =
                (vec![(from.to_string(), Isometry3::identity())], from, Isometry3::identity());
            while let Some((parent, in_parent)) = self.0.get(name)
                && chain.len() < LONGEST_CHAIN
            {
                place = in_parent * place;
                name = parent;
                chain.push((parent.clone(), place));
            }
            chain
        };
        let (ours, theirs) = (up(base), up(frame));
        let met = theirs.iter().find_map(|(name, there)| {
            ours.iter().find(|(other, _)| other == name).map(|(_, here)| here.inverse() * there)
        });
        met
    }
}

/// Which readings a scan makes; nothing when it measured too little ahead to be driven by.
pub fn of_scan(scan: &Scan, place: &Isometry3<f64>, body: &Body) -> Option<Vec<SonarReading>> {
    let origin = vec2(place.translation.x, place.translation.y);
    let (mut ahead, mut known) = (0_u32, 0_u32);
    let mut sectors: Vec<Option<SonarReading>> = vec![None; SECTORS as usize];
    let usable = scan.first_rad.is_finite() && scan.step_rad.is_finite();
    for (i, &range) in scan.ranges_m.iter().enumerate().filter(|_| usable) {
        let bearing = scan.first_rad + scan.step_rad * i as f64;
        let range = f64::from(range);
        let toward = place.rotation * Vector3::new(bearing.cos(), bearing.sin(), 0.0);
        let axis = vec2(toward.x, toward.y);
        let looks_ahead = axis.y.atan2(axis.x).abs() <= AHEAD_RAD;
        ahead += u32::from(looks_ahead);
        // Drivers say "nothing" by infinity or by more than the most; less than the least, or no number, is unknown.
        if range.is_nan() || range < scan.least_m {
            continue;
        }
        known += u32::from(looks_ahead);
        let point = (range <= scan.most_m).then(|| origin + axis * range);
        if point.is_some_and(|point| holds(body, point)) {
            continue;
        }
        for sector in 0..SECTORS {
            widen(&mut sectors[sector as usize], sector, point, axis, origin, body);
        }
    }
    let enough = ahead == 0 || f64::from(known) >= KNOWN_SHARE * f64::from(ahead);
    (enough && known > 0).then(|| sectors.into_iter().flatten().collect())
}

/// One beam in one sector: a reading at the outline, no longer than what the beam met.
fn widen(held: &mut Option<SonarReading>, sector: u32, point: Option<Vec2>, axis: Vec2, origin: Vec2, body: &Body) {
    let bearing = f64::from(sector) * TAU / f64::from(SECTORS);
    let mount = edge(body, origin, bearing);
    let from = point.map_or(axis, |point| point - mount);
    if angle_between(from.y.atan2(from.x), bearing).abs() > HALF_CONE_RAD {
        return;
    }
    let range_m = point.map_or(body.sonar_range_m, |point| (point - mount).norm()).min(body.sonar_range_m);
    let bearing = crate::geometry::wrap_angle(bearing);
    let nearer = held.is_none_or(|held| range_m < held.range_m);
    if nearer {
        *held = Some(SonarReading { mount, bearing, range_m });
    }
}

fn holds(body: &Body, point: Vec2) -> bool {
    point.x < body.front_m && point.x > -body.rear_m && point.y.abs() < body.width_m / 2.0
}

/// Where a ray from `origin` leaves the outline; where it begins, when that is outside.
fn edge(body: &Body, origin: Vec2, bearing: f64) -> Vec2 {
    if !holds(body, origin) {
        return origin;
    }
    let axis = vec2(bearing.cos(), bearing.sin());
    let out = |from: f64, along: f64, low: f64, high: f64| match along {
        along if along > 1e-9 => (high - from) / along,
        along if along < -1e-9 => (low - from) / along,
        _ => f64::INFINITY,
    };
    let half = body.width_m / 2.0;
    let way = out(origin.x, axis.x, -body.rear_m, body.front_m).min(out(origin.y, axis.y, -half, half));
    origin + axis * way
}

/// What one range sensor reads; nothing when it is no number.
pub fn of_range([_, least, most, range]: [f64; 4], place: &Isometry3<f64>, body: &Body) -> Option<SonarReading> {
    let toward = place.rotation * Vector3::x();
    let mount = vec2(place.translation.x, place.translation.y);
    let far = range > most || range == f64::INFINITY;
    let range_m = if far { body.sonar_range_m } else { range.max(least).min(body.sonar_range_m) };
    (!range.is_nan()).then(|| SonarReading { mount, bearing: toward.y.atan2(toward.x), range_m })
}

/// What a cloud of sonars' echoes reads: in the order of a Pioneer's sonars, where there are so many.
pub fn of_cloud(points: &[[f32; 3]], place: &Isometry3<f64>, body: &Body) -> Option<Vec<SonarReading>> {
    let is_pioneer = matches!(points.len(), 8 | 16);
    let readings = points.iter().enumerate().map(|(i, point)| {
        let [x, y, z] = point.map(f64::from);
        let point = place * Point3::new(x, y, z);
        let point = vec2(point.x, point.y);
        let known = u8::try_from(i).ok().filter(|_| is_pioneer).and_then(|i| SonarArray::Newer.sonar(i));
        let (mount, bearing) = known.unwrap_or_else(|| {
            let bearing = point.y.atan2(point.x);
            (edge(body, vec2(0.0, 0.0), bearing), bearing)
        });
        SonarReading { mount, bearing, range_m: (point - mount).norm().min(body.sonar_range_m) }
    });
    let readings: Vec<SonarReading> = readings.filter(|reading| reading.range_m.is_finite()).collect();
    (!readings.is_empty()).then_some(readings)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Pose;
    use crate::robot::p3dx;
    use crate::robot::ros::Header;

    fn scan(of: impl Fn(f64) -> f32) -> Scan {
        let step_rad = TAU / 360.0;
        let ranges_m = (0..360).map(|i| of(f64::from(i) * step_rad)).collect();
        Scan { step_rad, least_m: 0.05, most_m: 10.0, ranges_m, ..Scan::default() }
    }

    fn ahead(readings: &[SonarReading]) -> &SonarReading {
        readings.iter().min_by(|a, b| a.bearing.abs().total_cmp(&b.bearing.abs())).expect("one")
    }

    #[test]
    fn a_wall_ahead_is_as_far_as_it_is_from_the_robots_front() {
        let wall = scan(|bearing| if bearing.cos() > 0.1 { (1.0 / bearing.cos()) as f32 } else { f32::INFINITY });
        let readings = of_scan(&wall, &Isometry3::identity(), &p3dx::BODY).expect("usable");
        assert_eq!(readings.len(), 24);
        assert!((ahead(&readings).range_m - (1.0 - p3dx::FRONT_M)).abs() < 1e-6, "{:?}", ahead(&readings));
    }

    #[test]
    fn a_scanner_that_hangs_upside_down_does_not_swap_left_and_right() {
        let place = Isometry3::from_parts(
            Translation3::identity(),
            UnitQuaternion::from_euler_angles(std::f64::consts::PI, 0.0, 0.0),
        );
        // By its own bearings at the right: the robot's left.
        let left = scan(|bearing| if angle_between(bearing, -1.57).abs() < 0.1 { 1.0 } else { f32::INFINITY });
        let readings = of_scan(&left, &place, &p3dx::BODY).expect("usable");
        let near = readings.iter().min_by(|a, b| a.range_m.total_cmp(&b.range_m)).expect("one");
        assert!(near.bearing > 1.2 && near.bearing < 1.9, "{near:?}");
    }

    #[test]
    fn a_scan_of_no_numbers_is_none_and_some_of_them_are_passed_over() {
        assert_eq!(of_scan(&scan(|_| f32::NAN), &Isometry3::identity(), &p3dx::BODY), None);
        assert_eq!(of_scan(&scan(|_| 0.0), &Isometry3::identity(), &p3dx::BODY), None);
        let holes = scan(|bearing| if (bearing * 100.0) as i32 % 3 == 0 { f32::NAN } else { 2.0 });
        assert!(of_scan(&holes, &Isometry3::identity(), &p3dx::BODY).is_some());
    }

    #[test]
    fn a_frame_is_found_over_its_parents_and_a_loop_ends() {
        let mut frames = Frames::default();
        let told = |parent: &str, child: &str, x: f64| {
            Transform::flat(Header { frame: parent.into(), ..Header::default() }, child, Pose::new(x, 0.0, 0.0))
        };
        frames.take(&told("base_footprint", "base_link", 0.0));
        frames.take(&told("base_link", "plate", 0.1));
        frames.take(&told("plate", "laser", 0.05));
        let place = frames.within("base_footprint", "laser").expect("found");
        assert!((place.translation.x - 0.15).abs() < 1e-12);
        frames.take(&told("b", "a", 0.0));
        frames.take(&told("a", "b", 0.0));
        assert_eq!(frames.within("base_link", "a"), None);
    }
}

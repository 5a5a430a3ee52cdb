//! Where the robot is on the room map: odometry, corrected by the compass and by the walls its sonars hear.
//!
//! An extended Kalman filter over position, heading and the compass's own
//! error (Leonard & Durrant-Whyte 1991: geometric beacons). A reading corrects
//! the pose only when it fits the wall it should come from; what furniture and
//! people send back is nearer, does not fit, and is left out.

use nalgebra::{Matrix4, Vector4};

use crate::geometry::{Polygon, Pose, Vec2, vec2, wrap_angle};
use crate::map::RoomMap;
use crate::robot::sonar::{self, Echo, Segment};
use crate::robot::{MobileBase, SonarReading};

/// Deviations at the start: position (m), heading and compass error (rad).
const START_M: f64 = 0.1;
const START_RAD: f64 = 0.05;
const COMPASS_BIAS_RAD: f64 = 0.1;
/// Odometry: metres along the way per metre, and radians per radian turned and per metre driven.
const DRIVE_SHARE: f64 = 0.03;
const TURN_SHARE: f64 = 0.04;
const BEND_RAD_PER_M: f64 = 0.02;
/// Deviation of one compass reading, radians; readings close in time share their error, so they count less.
const COMPASS_RAD: f64 = 0.15;
/// Deviation of a sonar range: metres, and a share of it.
const SONAR_M: f64 = 0.03;
const SONAR_SHARE: f64 = 0.015;
/// A reading farther than so many deviations from its wall is no echo of it; shorter ones are furniture sooner.
const GATE: f64 = 2.5;
const GATE_SHORTER: f64 = 2.0;
/// No reading moves the gate beyond this, metres.
const WIDEST_GATE_M: f64 = 0.4;
/// Echoes from farther away are not trusted, metres.
const FARTHEST_M: f64 = 4.0;
/// Furniture within this behind or before the expected echo may be what is heard, metres.
const FURNITURE_M: f64 = 0.3;
/// When fewer of the readings than this fit, the robot is less sure of itself.
const FITTING: f64 = 0.2;
/// Memory of that share, readings.
const MEMORY: f64 = 60.0;
/// Doubt added then, a reading, and the most there can be.
const DOUBT_M: f64 = 0.01;
const DOUBT_RAD: f64 = 0.004;
const MOST_DOUBT_M: f64 = 0.25;

/// Follows the robot over the room map.
#[derive(Clone, Debug)]
pub struct Localizer {
    walls: Vec<Segment>,
    sonar_range_m: f64,
    /// x, y, heading, compass error.
    state: Vector4<f64>,
    covariance: Matrix4<f64>,
    odometry: Pose,
    heard: Vec<f64>,
    fitting: f64,
    odometry_only: bool,
}

impl Localizer {
    /// Begins at the odometry's pose; with `odometry_only` it stays with the odometry.
    pub fn new(map: &RoomMap, base: &dyn MobileBase, odometry_only: bool) -> Self {
        let pose = base.pose();
        let deviations = Vector4::new(START_M, START_M, START_RAD, COMPASS_BIAS_RAD);
        Self {
            walls: map.walls(),
            sonar_range_m: base.body().sonar_range_m,
            state: Vector4::new(pose.x, pose.y, pose.heading, 0.0),
            covariance: Matrix4::from_diagonal(&deviations.component_mul(&deviations)),
            odometry: pose,
            heard: base.sonar().iter().map(|reading| reading.range_m).collect(),
            fitting: 1.0,
            odometry_only,
        }
    }

    /// The likeliest pose.
    pub fn pose(&self) -> Pose {
        Pose::new(self.state[0], self.state[1], self.state[2])
    }

    /// Standard deviation of the position along its worse axis, metres.
    pub fn deviation_m(&self) -> f64 {
        self.covariance[(0, 0)].max(self.covariance[(1, 1)]).sqrt()
    }

    /// Takes in what the base reports since the last call. `furniture` is what may be heard beside the walls.
    pub fn update(&mut self, base: &dyn MobileBase, furniture: &[Polygon]) {
        self.roll(base.pose());
        if self.odometry_only {
            return;
        }
        if let Some(heading) = base.compass() {
            let jacobian = Vector4::new(0.0, 0.0, 1.0, 1.0);
            let innovation = wrap_angle(heading - self.state[2] - self.state[3]);
            self.correct(jacobian, innovation, COMPASS_RAD * COMPASS_RAD);
        }
        for (index, reading) in base.sonar().iter().enumerate() {
            // A sonar that has not fired since still shows its last range.
            let is_fresh = self.heard.get(index).is_none_or(|last| *last != reading.range_m);
            if is_fresh && reading.range_m < FARTHEST_M {
                self.hear(reading, furniture);
            }
        }
        self.heard.clear();
        self.heard.extend(base.sonar().iter().map(|reading| reading.range_m));
    }

    fn roll(&mut self, odometry: Pose) {
        let moved = self.odometry.to_local(odometry.position());
        let turned = wrap_angle(odometry.heading - self.odometry.heading);
        self.odometry = odometry;
        let metres = moved.norm();
        if metres == 0.0 && turned == 0.0 {
            return;
        }
        let (sin, cos) = self.state[2].sin_cos();
        let step = vec2(cos * moved.x - sin * moved.y, sin * moved.x + cos * moved.y);
        self.state += Vector4::new(step.x, step.y, turned, 0.0);
        self.state[2] = wrap_angle(self.state[2]);
        let mut jacobian = Matrix4::identity();
        jacobian[(0, 2)] = -step.y;
        jacobian[(1, 2)] = step.x;
        // Variances grow with the way, so that they come out the same for any length of step.
        let along = DRIVE_SHARE * DRIVE_SHARE * metres;
        let turning = TURN_SHARE * TURN_SHARE * turned.abs() + BEND_RAD_PER_M * BEND_RAD_PER_M * metres;
        let noise = Vector4::new(along, along, turning, 1e-9 * (metres + turned.abs()));
        self.covariance = jacobian * self.covariance * jacobian.transpose() + Matrix4::from_diagonal(&noise);
    }

    fn hear(&mut self, reading: &SonarReading, furniture: &[Polygon]) {
        let pose = self.pose();
        let origin = pose.to_world(reading.mount);
        let heading = pose.heading + reading.bearing;
        let axis = vec2(heading.cos(), heading.sin());
        let Some(expected) = sonar::echo(&self.walls, origin, axis, self.sonar_range_m) else { return };
        if !expected.steady || furniture.iter().any(|outline| may_be(outline, origin, axis, &expected)) {
            return;
        }
        let toward = (expected.point - origin) / expected.range_m.max(1e-6);
        let arm = origin - pose.position();
        // The range shrinks as the robot goes toward the wall; turning swings the sonar about the robot's middle.
        let jacobian = Vector4::new(-toward.x, -toward.y, toward.x * arm.y - toward.y * arm.x, 0.0);
        let innovation = reading.range_m - expected.range_m;
        let variance = (SONAR_M + SONAR_SHARE * expected.range_m).powi(2);
        let deviation = (jacobian.dot(&(self.covariance * jacobian)) + variance).sqrt();
        let gate = if innovation < 0.0 { GATE_SHORTER } else { GATE } * deviation;
        let fits = innovation.abs() <= gate.min(WIDEST_GATE_M);
        self.fitting += (f64::from(u8::from(fits)) - self.fitting) / MEMORY;
        if fits {
            self.correct(jacobian, innovation, variance);
        } else if self.fitting < FITTING && self.deviation_m() < MOST_DOUBT_M {
            self.covariance +=
                Matrix4::from_diagonal(&Vector4::new(DOUBT_M * DOUBT_M, DOUBT_M * DOUBT_M, DOUBT_RAD * DOUBT_RAD, 0.0));
        }
    }

    /// One scalar measurement (Kalman's update).
    fn correct(&mut self, jacobian: Vector4<f64>, innovation: f64, variance: f64) {
        let spread = self.covariance * jacobian;
        let gain = spread / (jacobian.dot(&spread) + variance);
        self.state += gain * innovation;
        self.state[2] = wrap_angle(self.state[2]);
        self.covariance -= gain * spread.transpose();
        // Kept symmetric against rounding.
        self.covariance = (self.covariance + self.covariance.transpose()) / 2.0;
    }
}

/// Whether a known piece of furniture may be what sends the echo back.
fn may_be(outline: &Polygon, origin: Vec2, axis: Vec2, echo: &Echo) -> bool {
    let heard = |edge| sonar::surface_echo(edge, origin, axis, echo.range_m + FURNITURE_M);
    outline.edges().any(|edge| heard(edge).is_some())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::base::{Obstacles, SimulatedBase};
    use crate::simulation::{Noise, Scene};

    /// Drives rounds through the hallway for `minutes`, and returns how far belief and odometry are off, metres.
    fn patrol(minutes: f64, seed: u64, odometry_only: bool) -> f64 {
        let map = RoomMap::apartment();
        let obstacles = Obstacles::new(&map, &Scene::apartment());
        let mut base = SimulatedBase::with_noise(obstacles, map.start, Noise::default(), seed, 0);
        let mut localizer = Localizer::new(&map, &base, odometry_only);
        let corners = [vec2(-3.5, -0.3), vec2(-3.5, 0.3), vec2(5.5, 0.3), vec2(5.5, -0.3)];
        let mut next = 0;
        while base.time_s() < 60.0 * minutes {
            let off = localizer.pose().bearing_to(corners[next]);
            let linear = if off.abs() > 0.4 { 0.0 } else { 0.4 };
            base.drive(linear, off.clamp(-1.0, 1.0), 0.1).expect("drives");
            localizer.update(&base, &[]);
            if localizer.pose().distance_to(corners[next]) < 0.3 {
                next = (next + 1) % corners.len();
            }
        }
        let truth = base.truth().borrow().pose;
        (truth.position() - localizer.pose().position()).norm()
    }

    #[test]
    fn the_walls_keep_the_robot_from_drifting_for_a_quarter_of_an_hour() {
        for seed in 0..4 {
            let error = patrol(15.0, seed, false);
            assert!(error < 0.15, "seed {seed}: {error} m");
        }
    }

    #[test]
    fn without_the_walls_it_drifts() {
        let worst = (0..4).map(|seed| patrol(4.0, seed, true)).fold(0.0, f64::max);
        assert!(worst > 0.3, "{worst}");
    }
}

//! The base: velocities in, odometry and sonar out, in steps of 20 ms.

use std::cell::RefCell;
use std::rc::Rc;

use super::Obstacles;
use super::ears::Ears;
use super::orders::Orders;
use super::wheels::{Wheels, moved};
use crate::geometry::{Pose, angle_between, wrap_angle};
use crate::robot::{Body, MobileBase, RobotError, SonarReading, Status, p3dx};
use crate::simulation::{Dice, Noise};

/// Integration step, seconds.
const STEP_S: f64 = 0.02;
/// One sonar of each array fires every 40 ms, as the P3DX's controller lets them.
const STEPS_PER_PING: u64 = 2;
/// Clearance is not told apart beyond this, metres.
const CLEARANCE_REACH_M: f64 = 1.0;
/// Clearance is measured again before it could be used up by more than this, and after every so many metres of motion,
/// so that the least clearance is true to a centimetre.
const SLACK_MARGIN_M: f64 = 0.005;
const MOST_SLACK_M: f64 = 0.02;
/// A robot that touched something is free again at this distance, metres.
const FREE_AGAIN_M: f64 = 0.02;
/// Keeps the robot's numbers apart from those of its eyes, which are drawn from the record's own stream.
const ROBOT: u64 = 0x726f_626f_7400_0000;

/// What is true of the simulated robot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Truth {
    /// Where it really is.
    pub pose: Pose,
    /// How often it came to touch something.
    pub collisions: u32,
    /// The least distance between its outline and anything solid so far, metres.
    pub min_clearance_m: f64,
    /// Metres driven.
    pub distance_m: f64,
}

/// A simulated P3DX. What it reports of itself is what its wheels count, its sonars hear and its compass shows.
pub struct SimulatedBase {
    obstacles: Obstacles,
    truth: Rc<RefCell<Truth>>,
    odometry: Pose,
    velocity: (f64, f64),
    steps: u64,
    orders: Orders,
    wheels: Wheels,
    ears: Ears,
    compass_bias_rad: f64,
    compass: f64,
    noise: Noise,
    dice: Dice,
    status: Status,
    /// A lower bound of the clearance: while it stays above zero nothing need be measured.
    slack_m: f64,
    /// Another, for telling without measuring that the clearance is not the least so far.
    known_clear_m: f64,
}

impl SimulatedBase {
    /// A robot without any error at rest at `start`.
    pub fn new(obstacles: Obstacles, start: Pose) -> Self {
        Self::with_noise(obstacles, start, Noise::off(), 0, 0)
    }

    /// A robot at rest that believes to be at `start`; its luck is drawn from `stream` under `seed`.
    pub fn with_noise(obstacles: Obstacles, start: Pose, noise: Noise, seed: u64, stream: u64) -> Self {
        let mut dice = Dice::new(seed, stream ^ ROBOT);
        let pose = Pose::new(
            start.x + dice.error(noise.start_m),
            start.y + dice.error(noise.start_m),
            wrap_angle(start.heading + dice.error(noise.start_rad)),
        );
        let wheels = Wheels::new(&noise, &mut dice);
        let compass_bias_rad = dice.error(noise.compass_bias_rad);
        let ears = Ears::new(noise, &obstacles, pose, &mut dice);
        let truth = Truth { pose, min_clearance_m: CLEARANCE_REACH_M, ..Truth::default() };
        let mut base = Self {
            obstacles,
            truth: Rc::new(RefCell::new(truth)),
            odometry: start,
            velocity: (0.0, 0.0),
            steps: 0,
            orders: Orders::new(&noise, STEP_S),
            wheels,
            ears,
            compass_bias_rad,
            compass: 0.0,
            noise,
            dice,
            status: Status::default(),
            slack_m: 0.0,
            known_clear_m: 0.0,
        };
        base.measure_clearance();
        base.read_compass();
        base
    }

    /// A handle on the truth, for the judge and the simulated eyes.
    pub fn truth(&self) -> Rc<RefCell<Truth>> {
        Rc::clone(&self.truth)
    }

    /// Brakes as hard as the wheels hold, for `seconds`.
    pub fn brake(&mut self, seconds: f64) {
        self.orders.forget();
        self.live(seconds, |base| {
            let (linear, angular) = base.velocity;
            base.velocity = (
                toward(linear, 0.0, 0.0, p3dx::EMERGENCY_BRAKING_M_S2),
                toward(angular, 0.0, 0.0, p3dx::EMERGENCY_TURN_BRAKING_RAD_S2),
            );
        });
    }

    /// Lives for `seconds`, with the velocity of each step made of the one before by `next`.
    fn live(&mut self, seconds: f64, next: impl Fn(&mut Self)) {
        let steps = (seconds / STEP_S).round() as u64;
        for _ in 0..steps {
            next(self);
            self.step();
            if self.steps.is_multiple_of(STEPS_PER_PING) {
                let pose = self.truth.borrow().pose;
                self.ears.fire(&self.obstacles, pose, &mut self.dice);
            }
        }
        self.read_compass();
    }

    fn step(&mut self) {
        let (metres, radians) = (self.velocity.0 * STEP_S, self.velocity.1 * STEP_S);
        // What is held fast by what it touches may still back off without turning, or turn without going on.
        let ways = [(metres, radians), (metres, 0.0), (0.0, radians)];
        let tries = if self.status.stalled { 3 } else { 1 };
        if !ways[..tries].iter().any(|&(metres, radians)| self.goes(metres, radians)) {
            self.touch();
        }
        self.steps += 1;
    }

    /// Rolls on by so much, unless something is in the way.
    fn goes(&mut self, metres: f64, radians: f64) -> bool {
        let before = self.truth.borrow().pose;
        let after = self.wheels.roll(before, metres, radians, &mut self.dice);
        self.truth.borrow_mut().pose = after;
        // No point of the outline moves farther than this in a step.
        let rolled = (after.position() - before.position()).norm();
        let most = rolled + angle_between(after.heading, before.heading) * p3dx::SWING_M;
        self.slack_m -= most;
        self.known_clear_m -= most;
        if self.slack_m <= 0.0 && self.measure_clearance() <= 0.0 {
            self.truth.borrow_mut().pose = before;
            return false;
        }
        self.odometry = moved(self.odometry, metres, radians);
        self.truth.borrow_mut().distance_m += rolled;
        true
    }

    /// The robot stays where it was, its wheels held fast.
    fn touch(&mut self) {
        if !self.status.stalled {
            self.truth.borrow_mut().collisions += 1;
        }
        self.velocity = (0.0, 0.0);
        self.status = Status { stalled: true, bumped: true };
    }

    fn measure_clearance(&mut self) -> f64 {
        let mut truth = self.truth.borrow_mut();
        let of_interest = truth.min_clearance_m.max(FREE_AGAIN_M).max(MOST_SLACK_M + SLACK_MARGIN_M);
        let clearance = if self.known_clear_m > of_interest + 1e-9 {
            self.known_clear_m
        } else {
            self.obstacles.clearance(&p3dx::BODY.outline(truth.pose), truth.pose.position(), CLEARANCE_REACH_M)
        };
        self.known_clear_m = clearance;
        truth.min_clearance_m = truth.min_clearance_m.min(clearance);
        self.slack_m = (clearance - SLACK_MARGIN_M).clamp(0.0, MOST_SLACK_M);
        // Only once it has backed away is another touch another collision.
        if clearance > FREE_AGAIN_M {
            self.status = Status::default();
        }
        clearance
    }

    fn read_compass(&mut self) {
        let error = self.compass_bias_rad + self.dice.error(self.noise.compass_rad);
        self.compass = wrap_angle(self.truth.borrow().pose.heading + error);
    }
}

/// The velocity one step later: accelerations differ for speeding up and braking.
fn toward(now: f64, wanted: f64, accelerate: f64, brake: f64) -> f64 {
    let braking = wanted.abs() < now.abs() || now * wanted < 0.0;
    let most = if braking { brake } else { accelerate } * STEP_S;
    now + (wanted - now).clamp(-most, most)
}

impl MobileBase for SimulatedBase {
    fn body(&self) -> Body {
        p3dx::BODY
    }

    fn pose(&self) -> Pose {
        self.odometry
    }

    fn velocity(&self) -> (f64, f64) {
        self.velocity
    }

    fn time_s(&self) -> f64 {
        self.steps as f64 * STEP_S
    }

    fn drive(&mut self, linear: f64, angular: f64, seconds: f64) -> Result<(), RobotError> {
        let linear = linear.clamp(-p3dx::SPEED_M_S, p3dx::SPEED_M_S);
        let angular = angular.clamp(-p3dx::TURN_RAD_S, p3dx::TURN_RAD_S);
        self.orders.give(self.steps, (linear, angular), &mut self.dice);
        self.live(seconds, |base| {
            let ((linear, angular), now) = (base.orders.at(base.steps), base.velocity);
            let turning = p3dx::TURN_ACCELERATION_RAD_S2;
            base.velocity = (
                toward(now.0, linear, p3dx::ACCELERATION_M_S2, p3dx::BRAKING_M_S2),
                toward(now.1, angular, turning, turning),
            );
        });
        Ok(())
    }

    fn sonar(&self) -> &[SonarReading] {
        self.ears.readings()
    }

    fn compass(&self) -> Option<f64> {
        Some(self.compass)
    }

    fn status(&self) -> Status {
        self.status
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::RoomMap;
    use crate::simulation::Scene;

    fn base_at(pose: Pose) -> SimulatedBase {
        SimulatedBase::new(Obstacles::new(&RoomMap::apartment(), &Scene::apartment()), pose)
    }

    #[test]
    fn it_speeds_up_no_faster_than_the_real_one() {
        let mut base = base_at(Pose::new(0.0, 0.0, 0.0));
        base.drive(0.5, 0.0, 1.0).expect("drives");
        assert!((base.velocity().0 - 0.3).abs() < 1e-9);
    }

    #[test]
    fn a_turn_in_place_stays_in_place() {
        let mut base = base_at(Pose::new(0.0, 0.0, 0.0));
        base.drive(0.0, 1.0, 2.0).expect("turns");
        assert!(base.pose().position().norm() < 1e-12 && base.pose().heading > 1.0);
    }

    #[test]
    fn a_wall_stops_it_and_is_counted_once() {
        let mut base = base_at(Pose::new(6.0, 0.0, 0.0));
        base.drive(0.5, 0.0, 8.0).expect("drives");
        let truth = base.truth().borrow().clone();
        assert!(base.status().stalled && truth.collisions == 1, "{truth:?}");
        assert!(truth.pose.x < 7.2 - p3dx::FRONT_M + 1e-6 && truth.pose.x > 6.9);
    }

    #[test]
    fn a_robot_with_noise_does_not_know_where_it_is() {
        let obstacles = Obstacles::new(&RoomMap::apartment(), &Scene::apartment());
        let start = Pose::new(-3.0, 0.0, 0.0);
        let mut base = SimulatedBase::with_noise(obstacles, start, Noise::default(), 7, 0);
        base.drive(0.5, 0.0, 10.0).expect("drives");
        let truth = base.truth().borrow().pose;
        let error = (truth.position() - base.pose().position()).norm();
        assert!(error > 0.01 && error < 1.0, "{truth:?} {:?}", base.pose());
    }

    #[test]
    fn the_front_sonar_measures_the_wall_ahead() {
        let base = base_at(Pose::new(6.0, 0.0, 0.0));
        let front = base.sonar()[3];
        assert!((front.range_m - (7.2 - 6.166)).abs() < 0.05, "{front:?}");
    }
}

//! What the motion commands mean: set-points, limits, and the velocity of the next step.

use crate::geometry::wrap_angle;
use crate::robot::p3dx;

/// The simulated base integrates in steps of this, seconds.
pub const STEP_S: f64 = 0.02;

/// What the wheels shall do together.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Forward {
    /// m/s.
    Velocity(f64),
    /// Metres still to go.
    Distance(f64),
}

/// What the wheels shall do against each other.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Turn {
    /// rad/s.
    Velocity(f64),
    /// A heading in the robot's own frame, radians.
    Heading(f64),
}

/// Limits in force, those the base can reach: m/s, m/s², rad/s, rad/s².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Fastest, also the speed of MOVE.
    pub speed: f64,
    /// Speeding up.
    pub acceleration: f64,
    /// Slowing down.
    pub braking: f64,
    /// Fastest turn, also the speed of HEAD.
    pub turn: f64,
    /// Turning faster.
    pub turn_acceleration: f64,
    /// Turning slower.
    pub turn_braking: f64,
}

impl Default for Limits {
    fn default() -> Self {
        let turn = p3dx::BODY.turn_rad_s;
        Self {
            speed: p3dx::BODY.speed_m_s,
            acceleration: 0.3,
            braking: 0.3,
            turn,
            turn_acceleration: turn,
            turn_braking: turn,
        }
    }
}

/// Set-points and how they are followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    forward: Forward,
    turn: Turn,
    /// The velocities asked of the base in the last step.
    now: (f64, f64),
    /// An emergency stop is under way.
    emergency: bool,
    /// Limits in force.
    pub limits: Limits,
}

impl Default for Motion {
    fn default() -> Self {
        Self {
            forward: Forward::Velocity(0.0),
            turn: Turn::Velocity(0.0),
            now: (0.0, 0.0),
            emergency: false,
            limits: Limits::default(),
        }
    }
}

impl Motion {
    /// VEL: m/s.
    pub fn set_velocity(&mut self, velocity: f64) {
        self.forward = Forward::Velocity(velocity);
    }

    /// RVEL: rad/s, counter-clockwise.
    pub fn set_turn(&mut self, velocity: f64) {
        self.turn = Turn::Velocity(velocity);
    }

    /// VEL2: both wheels, m/s, recomposed to forward and turn.
    pub fn set_wheels(&mut self, left: f64, right: f64, turn_rad_per_m: f64) {
        self.set_velocity((left + right) / 2.0);
        self.set_turn((right - left) / 2.0 * turn_rad_per_m);
    }

    /// MOVE: metres.
    pub fn move_by(&mut self, distance: f64) {
        self.forward = Forward::Distance(distance);
    }

    /// HEAD: a heading in the robot's own frame, radians.
    pub fn turn_to(&mut self, heading: f64) {
        self.turn = Turn::Heading(wrap_angle(heading));
    }

    /// DCHEAD: relative to the last heading set, or to where it looks.
    pub fn turn_on(&mut self, by: f64, heading: f64) {
        let from = if let Turn::Heading(set) = self.turn { set } else { heading };
        self.turn_to(from + by);
    }

    /// STOP: slows down by its limits.
    pub fn stop(&mut self) {
        self.forward = Forward::Velocity(0.0);
        self.turn = Turn::Velocity(0.0);
    }

    /// Motors without power: nothing more is asked of the base.
    pub fn give_up(&mut self) {
        self.stop();
        self.now = (0.0, 0.0);
    }

    /// E_STOP: as hard as the base can, whatever deceleration is set.
    pub fn stop_in_emergency(&mut self) {
        self.give_up();
        self.emergency = true;
    }

    /// Whether an emergency stop is under way, in which nothing else is obeyed.
    pub fn is_emergency(&self) -> bool {
        self.emergency
    }

    /// The robot stands: the emergency is over.
    pub fn stands(&mut self) {
        self.emergency = false;
    }

    /// Whether the set-points ask for any motion.
    pub fn asks_for_motion(&self) -> bool {
        !matches!(self.forward, Forward::Velocity(0.0)) || !matches!(self.turn, Turn::Velocity(0.0) | Turn::Heading(_))
    }

    /// Whether it goes, or was last asked to go, backward.
    pub fn is_backward(&self) -> bool {
        matches!(self.forward, Forward::Velocity(v) | Forward::Distance(v) if v < 0.0) || self.now.0 < 0.0
    }

    /// The velocities for the next step; `held` when motors or watchdog forbid any.
    pub fn step(&mut self, held: bool, heading: f64) -> (f64, f64) {
        let limits = self.limits;
        let forward = match self.forward {
            _ if held => 0.0,
            Forward::Velocity(velocity) => velocity.clamp(-limits.speed, limits.speed),
            Forward::Distance(left) => left.signum() * (2.0 * limits.braking * left.abs()).sqrt().min(limits.speed),
        };
        let turn = match self.turn {
            _ if held => 0.0,
            Turn::Velocity(velocity) => velocity.clamp(-limits.turn, limits.turn),
            Turn::Heading(goal) => approach(wrap_angle(goal - heading), limits.turn_braking, limits.turn),
        };
        self.now.0 = toward(self.now.0, forward, limits.acceleration, limits.braking);
        self.now.1 = toward(self.now.1, turn, limits.turn_acceleration, limits.turn_braking);
        self.now
    }

    /// The base has moved by so many metres: what is left of a MOVE.
    pub fn moved(&mut self, metres: f64) {
        if let Forward::Distance(left) = &mut self.forward {
            *left -= metres;
            if left.abs() < 0.002 {
                self.forward = Forward::Velocity(0.0);
            }
        }
    }
}

/// The velocity at which `left` can still be braked away, slow enough near the end not to overshoot.
fn approach(left: f64, braking: f64, fastest: f64) -> f64 {
    left.signum() * (2.0 * braking * left.abs()).sqrt().min(fastest).min(left.abs() / (4.0 * STEP_S))
}

/// The velocity one step later.
fn toward(now: f64, wanted: f64, accelerate: f64, brake: f64) -> f64 {
    let braking = wanted.abs() < now.abs() || now * wanted < 0.0;
    let most = if braking { brake } else { accelerate } * STEP_S;
    now + (wanted - now).clamp(-most, most)
}

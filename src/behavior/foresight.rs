//! What a base will have done by the time a command reaches it.
//!
//! Between a velocity that is asked for and the report that shows it lies a
//! dead time: radio bridges, Wi-Fi, the base's own cycle. Steering by the last
//! report as if it were the present overshoots, and beyond a tenth of a second
//! swings for ever. So the commands that are still on their way are played
//! through the base's own limits from the last report on (Smith's predictor),
//! and what comes out is what the next command is for. The dead time itself is
//! the lag at which the turning that was asked for fits the turning that was
//! reported best.

use std::collections::VecDeque;

use crate::geometry::{Pose, wrap_angle};
use crate::robot::Body;

/// Time is counted in steps of this, seconds.
const STEP_S: f64 = 0.02;
/// The longest dead time that is told, steps: 1.6 s.
const LAGS: usize = 80;
/// Steps that are remembered: the longest dead time, and a report that is late by as much.
const MEMORY: usize = 2 * LAGS;
/// Weight of what was known before one report, which is about half a second of turning.
const KEEPS: f64 = 0.85;
/// A turning that no lag explains better than this tells nothing of it: the robot is held, rad/s.
const UNEXPLAINED_RAD_S: f64 = 0.25;
/// Slower than this it hardly turns, rad/s.
const TURNS_RAD_S: f64 = 0.05;
/// So much better another lag must fit than the one held to be right, rad²/s² summed up, and as a share.
const BETTER: f64 = 0.002;
const BETTER_SHARE: f64 = 0.7;
/// Slower than this it stands, m/s and rad/s.
const STANDS_M_S: f64 = 0.01;
const STANDS_RAD_S: f64 = 0.02;

/// Linear (m/s) and angular (rad/s) velocity.
type Velocity = (f64, f64);

/// The commands on their way to a base, and how long they take.
#[derive(Clone, Debug)]
pub(super) struct Foresight {
    body: Body,
    /// What was asked for in each step, and how fast a base without dead time would be at its end; the last one is now.
    asked: VecDeque<Velocity>,
    ideal: VecDeque<Velocity>,
    /// Steps since the beginning.
    steps: u64,
    began_s: f64,
    /// Steps from a command to the report that shows it.
    lag: usize,
    /// How badly each lag explains the turning of late.
    misfit: [f64; LAGS],
    /// Steps from the last report to now.
    age: usize,
}

impl Foresight {
    /// For a base at rest at `time_s`, with the dead time it was found to have, seconds.
    pub fn new(body: Body, time_s: f64, dead_time_s: f64) -> Self {
        let still = || VecDeque::from(vec![(0.0, 0.0); MEMORY]);
        Self {
            body,
            asked: still(),
            ideal: still(),
            steps: 0,
            began_s: time_s,
            lag: steps_in(dead_time_s).min(LAGS - 1),
            misfit: [0.0; LAGS],
            age: 0,
        }
    }

    /// Seconds from a command to the report that shows it.
    pub fn dead_time_s(&self) -> f64 {
        self.lag as f64 * STEP_S
    }

    /// `asked` was asked for until `time_s`, when the last report was `age_s` old and told of `measured`.
    pub fn passed(&mut self, asked: Velocity, time_s: f64, age_s: f64, measured: Velocity) {
        let until = ((time_s - self.began_s) / STEP_S).round().max(0.0) as u64;
        // A program that was held up asks for nothing new meanwhile, and what is older than the memory is forgotten.
        for _ in 0..until.saturating_sub(self.steps).min(MEMORY as u64) {
            let last = self.ideal.back().copied().unwrap_or_default();
            self.ideal.pop_front();
            self.asked.pop_front();
            self.ideal.push_back(follow(&self.body, last, asked));
            self.asked.push_back(asked);
        }
        let is_fresh = until - self.steps.min(until) > steps_in(age_s) as u64;
        self.steps = until;
        self.age = steps_in(age_s).min(LAGS);
        if is_fresh {
            self.compare(measured.1);
        }
    }

    /// Which lag fits what was reported. A base that stands may be late, or held: that tells nothing.
    fn compare(&mut self, turning: f64) {
        if turning.abs() < TURNS_RAD_S {
            return;
        }
        let at_report = MEMORY - 1 - self.age;
        let ideal: [f64; LAGS] = std::array::from_fn(|lag| at_report.checked_sub(lag).map_or(0.0, |i| self.ideal[i].1));
        let errors = ideal.map(|ideal| (ideal - turning).powi(2));
        let (least, most) = errors.iter().fold((f64::INFINITY, 0.0_f64), |(l, m), &e| (l.min(e), m.max(e)));
        // While it turns evenly, or not at all, every lag is as good.
        if least > UNEXPLAINED_RAD_S * UNEXPLAINED_RAD_S || most - least < 1e-6 {
            return;
        }
        for (misfit, error) in self.misfit.iter_mut().zip(errors) {
            *misfit = KEEPS * *misfit + error;
        }
        let best = (0..LAGS).min_by(|&a, &b| self.misfit[a].total_cmp(&self.misfit[b])).unwrap_or(0);
        if self.misfit[best] + BETTER < BETTER_SHARE * self.misfit[self.lag] {
            self.lag = best;
        }
    }

    /// Where a robot reported at `pose` with `velocity` will be, and how fast, when the next command reaches it.
    pub fn ahead(&self, pose: Pose, velocity: Velocity) -> (Pose, Velocity) {
        let on_their_way = self.asked.iter().skip(MEMORY - self.lag - self.age);
        on_their_way.fold((pose, velocity), |(pose, velocity), &asked| {
            let velocity = follow(&self.body, velocity, asked);
            (rolled(pose, velocity.0 * STEP_S, velocity.1 * STEP_S), velocity)
        })
    }

    /// Whether a robot reported with `velocity` stands, and no command on its way will set it in motion.
    pub fn is_at_rest(&self, velocity: Velocity) -> bool {
        let on_their_way = self.asked.iter().skip(MEMORY - self.lag - self.age);
        stands(velocity) && on_their_way.copied().all(stands)
    }
}

/// Whether this is as good as standing.
pub(super) fn stands((linear, angular): Velocity) -> bool {
    linear.abs() < STANDS_M_S && angular.abs() < STANDS_RAD_S
}

/// The speed to ask for now so as to come to rest after `left`, with `period` seconds to the next word: a trapezoid of
/// speeding up from `now`, at most `fastest`, and slowing down. Units of way and time are the caller's.
pub(super) fn trapezoid(left: f64, now: f64, fastest: f64, (speeding, braking): (f64, f64), period: f64) -> f64 {
    // What is gone in one period at that speed, and in braking from it, is what is left.
    let stops = braking * ((period * period + 2.0 * left.abs() / braking).sqrt() - period);
    let wanted = left.signum() * stops.min(fastest);
    // Not against its motion: it brakes first.
    if wanted * now < 0.0 {
        return 0.0;
    }
    wanted.clamp(-now.abs() - speeding * period, now.abs() + speeding * period)
}

fn steps_in(seconds: f64) -> usize {
    (seconds / STEP_S).round().max(0.0) as usize
}

/// The velocity one step later, within the base's limits.
fn follow(body: &Body, now: Velocity, asked: Velocity) -> Velocity {
    let linear = asked.0.clamp(-body.speed_m_s, body.speed_m_s);
    let angular = asked.1.clamp(-body.turn_rad_s, body.turn_rad_s);
    let turning = body.turn_acceleration_rad_s2;
    (toward(now.0, linear, body.acceleration_m_s2, body.braking_m_s2), toward(now.1, angular, turning, turning))
}

fn toward(now: f64, wanted: f64, accelerate: f64, brake: f64) -> f64 {
    let braking = wanted.abs() < now.abs() || now * wanted < 0.0;
    let most = if braking { brake } else { accelerate } * STEP_S;
    now + (wanted - now).clamp(-most, most)
}

/// The pose after an arc of `metres` that turns by `radians`.
fn rolled(from: Pose, metres: f64, radians: f64) -> Pose {
    let middle = from.heading + radians / 2.0;
    Pose::new(from.x + metres * middle.cos(), from.y + metres * middle.sin(), wrap_angle(from.heading + radians))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::p3dx;

    const TICK_S: f64 = 0.1;

    /// A base that does what it is told, `dead` steps later.
    struct Late {
        foresight: Foresight,
        pose: Pose,
        velocity: Velocity,
        on_their_way: VecDeque<Velocity>,
        time_s: f64,
    }

    impl Late {
        fn new(dead: usize, known_s: f64) -> Self {
            let on_their_way = VecDeque::from(vec![(0.0, 0.0); dead]);
            let foresight = Foresight::new(p3dx::BODY, 0.0, known_s);
            Self { foresight, pose: Pose::default(), velocity: (0.0, 0.0), on_their_way, time_s: 0.0 }
        }

        fn tick(&mut self, asked: Velocity) {
            for _ in 0..steps_in(TICK_S) {
                self.on_their_way.push_back(asked);
                let now = self.on_their_way.pop_front().unwrap_or_default();
                self.velocity = follow(&p3dx::BODY, self.velocity, now);
                self.pose = rolled(self.pose, self.velocity.0 * STEP_S, self.velocity.1 * STEP_S);
            }
            self.time_s += TICK_S;
            self.foresight.passed(asked, self.time_s, 0.0, self.velocity);
        }

        /// Turns to `heading`; how often its turning changed its sense.
        fn turn_to(&mut self, heading: f64) -> usize {
            let (mut reversals, mut sense) = (0, 0.0);
            for _ in 0..200 {
                let (pose, velocity) = self.foresight.ahead(self.pose, self.velocity);
                let left = wrap_angle(heading - pose.heading);
                self.tick((0.0, trapezoid(left, velocity.1, 1.2, (1.7, 1.2), TICK_S)));
                if self.velocity.1.abs() > 0.05 {
                    reversals += usize::from(sense * self.velocity.1 < 0.0);
                    sense = self.velocity.1;
                }
            }
            reversals
        }
    }

    #[test]
    fn a_dead_time_that_nobody_knew_is_found_in_one_turn() {
        for dead in [0, 3, 5, 10, 20, 40] {
            let mut base = Late::new(dead, 0.0);
            base.turn_to(1.5);
            let found = base.foresight.lag;
            assert!(found.abs_diff(dead) <= 1, "{dead} steps, found {found}");
        }
    }

    #[test]
    fn with_its_dead_time_known_a_turn_ends_where_it_should_and_never_swings_back() {
        for dead in [0, 5, 10, 20, 40] {
            let mut base = Late::new(dead, dead as f64 * STEP_S);
            let reversals = base.turn_to(2.5);
            let off = wrap_angle(base.pose.heading - 2.5).abs();
            assert!(reversals == 0 && off < 0.02, "{dead} steps: {reversals} reversals, {off} rad off");
        }
    }

    #[test]
    fn it_is_not_at_rest_while_a_command_is_on_its_way() {
        let mut base = Late::new(20, 0.4);
        base.tick((0.3, 0.0));
        base.tick((0.0, 0.0));
        assert!(base.velocity == (0.0, 0.0) && !base.foresight.is_at_rest(base.velocity));
        (0..6).for_each(|_| base.tick((0.0, 0.0)));
        assert!(base.foresight.is_at_rest(base.velocity), "{:?}", base.velocity);
    }

    #[test]
    fn a_robot_that_is_held_fast_says_nothing_of_its_dead_time() {
        let mut foresight = Foresight::new(p3dx::BODY, 0.0, 0.1);
        (1..100).for_each(|tick| foresight.passed((0.0, 1.0), f64::from(tick) * TICK_S, 0.0, (0.0, 0.0)));
        assert!((foresight.dead_time_s() - 0.1).abs() < 1e-9);
    }

    #[test]
    fn a_trapezoid_speeds_up_holds_and_brakes_within_its_limits() {
        let (mut left, mut speed, mut speeds) = (2.0, 0.0, Vec::new());
        while left > 0.01 {
            let wanted = trapezoid(left, speed, 0.5, (0.3, 0.25), TICK_S);
            assert!(wanted - speed < 0.3 * TICK_S + 1e-9 && speed - wanted < 0.25 * TICK_S * 1.2 + 0.01);
            speed = wanted;
            left -= speed * TICK_S;
            speeds.push(speed);
        }
        assert!(left > -0.01 && speeds.iter().any(|speed| (speed - 0.5).abs() < 1e-9), "{left} {speeds:?}");
    }
}

//! From the robot's wheel counters to a pose that never jumps and loses no distance.

use std::time::Duration;

use crate::geometry::{Pose, vec2, wrap_angle};
use crate::robot::arcos::codec::Sip;
use crate::robot::arcos::parameters::Parameters;

/// No two packets are made closer together.
const CYCLE: Duration = Duration::from_millis(100);
/// Packets may be so much older than they seem: they wait in buffers.
const JITTER: Duration = Duration::from_millis(300);
/// A step longer than the speeds explain by this, metres, and this factor, is no step.
const TOLERANCE_M: f64 = 0.1;
const TOLERANCE: f64 = 1.5;
/// All three counters at zero, this far from where they were, have been reset, metres.
const RESET_M: f64 = 0.02;

/// What a packet did to the pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Taken {
    /// The first: where the counters begin.
    First,
    /// A step.
    Step,
    /// The counters were set anew; the step was made up from the velocity.
    Rebased,
}

/// The position counters of a packet, its measured speed, and when it came.
#[derive(Clone, Copy, Debug)]
struct Last {
    x: u16,
    y: u16,
    speed: f64,
    at: Duration,
}

/// Dead reckoning over information packets.
#[derive(Clone, Debug)]
pub struct Odometry {
    parameters: Parameters,
    /// The fastest the robot is allowed to go, m/s.
    top_speed: f64,
    last: Option<Last>,
    pose: Pose,
    /// From the counters' axes to ours, radians.
    turned: f64,
    distance_m: f64,
}

impl Odometry {
    /// Odometry that begins at 0, 0, 0.
    pub fn new(parameters: Parameters, top_speed: f64) -> Self {
        Self { parameters, top_speed, last: None, pose: Pose::default(), turned: 0.0, distance_m: 0.0 }
    }

    /// Where the robot is, from where it was first heard.
    pub fn pose(&self) -> Pose {
        self.pose
    }

    /// Metres driven.
    pub fn distance_m(&self) -> f64 {
        self.distance_m
    }

    /// Takes in a packet that came at `now`.
    ///
    /// Positions wrap at 15 or 16 bits; the difference of the low 15 bits is
    /// right for both, up to 16 m between two packets.
    pub fn take(&mut self, sip: &Sip, now: Duration) -> Taken {
        let speed = f64::from(sip.left_mm_s).midpoint(f64::from(sip.right_mm_s)) * self.parameters.velocity_m_s;
        let this = Last { x: sip.x, y: sip.y, speed, at: now };
        let Some(last) = self.last.replace(this) else {
            self.turned = wrap_angle(self.pose.heading - f64::from(sip.heading) * self.parameters.angle_rad);
            return Taken::First;
        };
        let unit = self.parameters.distance_m;
        let step = vec2(f64::from(delta15(sip.x, last.x)) * unit, f64::from(delta15(sip.y, last.y)) * unit);
        // Packets that waited in a buffer come all at once, but were made a cycle apart.
        let passed = now.saturating_sub(last.at).max(CYCLE);
        let fastest = last.speed.abs().max(speed.abs());
        let could = |fastest: f64, time: Duration| fastest * time.as_secs_f64() * TOLERANCE;
        let at_zero = (sip.x, sip.y, sip.heading) == (0, 0, 0);
        let was_reset = at_zero && step.norm() > could(fastest, passed) + RESET_M;
        let jumped = step.norm() > could(fastest.max(self.top_speed), passed + JITTER) + TOLERANCE_M;
        if was_reset || jumped {
            self.bridge(last.speed.midpoint(speed) * passed.as_secs_f64().min(JITTER.as_secs_f64()));
            self.turned = wrap_angle(self.pose.heading - f64::from(sip.heading) * self.parameters.angle_rad);
            return Taken::Rebased;
        }
        let (sin, cos) = self.turned.sin_cos();
        self.pose.x += cos * step.x - sin * step.y;
        self.pose.y += sin * step.x + cos * step.y;
        self.pose.heading = wrap_angle(f64::from(sip.heading) * self.parameters.angle_rad + self.turned);
        self.distance_m += step.norm();
        Taken::Step
    }

    /// The way between two packets whose counters cannot be compared.
    fn bridge(&mut self, metres: f64) {
        let ahead = self.pose.forward() * metres;
        self.pose.x += ahead.x;
        self.pose.y += ahead.y;
        self.distance_m += metres.abs();
    }
}

/// The difference of two counters of which only the low 15 bits count.
fn delta15(new: u16, old: u16) -> i16 {
    ((new.wrapping_sub(old) << 1) as i16) >> 1
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn sip(x: i32, y: i32, heading: i32) -> Sip {
        let heading = (heading + 2048).rem_euclid(4096) - 2048;
        Sip { x: x as u16, y: y as u16, heading: heading as i16, left_mm_s: 300, right_mm_s: 300, ..Sip::default() }
    }

    fn odometry() -> Odometry {
        Odometry::new(Parameters::P3DX_SH, 0.3)
    }

    #[test]
    fn the_first_packet_is_where_it_begins_and_no_jump() {
        let mut odometry = odometry();
        assert_eq!(odometry.take(&sip(32_500, -7, 0), CYCLE), Taken::First);
        assert_eq!(odometry.pose(), Pose::default());
    }

    proptest! {
        #[test]
        fn positions_wrap_at_15_and_at_16_bits_without_a_jump(start in -70_000..70_000_i32, bits in 15..=16_u32, step in -60..=60_i32) {
            let mut odometry = odometry();
            let mask = (1_i32 << bits) - 1;
            for i in 0..=1000 {
                let taken = odometry.take(&sip((start + i * step) & mask, 0, 0), CYCLE * i as u32);
                prop_assert_eq!(taken, if i == 0 { Taken::First } else { Taken::Step });
            }
            prop_assert!((odometry.pose().x - f64::from(step)).abs() < 1e-9);
            prop_assert!((odometry.distance_m() - f64::from(step.abs())).abs() < 1e-9);
        }

        #[test]
        fn packets_that_are_lost_lose_no_distance(kept in prop::collection::vec(any::<bool>(), 1..200)) {
            let mut odometry = odometry();
            odometry.take(&sip(0, 0, 0), Duration::ZERO);
            for (i, kept) in kept.iter().enumerate() {
                if *kept {
                    odometry.take(&sip(30 * (i as i32 + 1), 0, 0), CYCLE * (i as u32 + 1));
                }
            }
            let last = kept.iter().rposition(|kept| *kept).map_or(0, |i| i + 1);
            prop_assert!((odometry.pose().x - 0.03 * last as f64).abs() < 1e-9);
        }

        #[test]
        fn the_heading_wraps_and_comes_back(turns in prop::collection::vec(-500..500_i32, 1..100)) {
            let mut odometry = odometry();
            let mut heading = 700;
            odometry.take(&sip(0, 0, heading), Duration::ZERO);
            for turn in &turns {
                heading += turn;
                odometry.take(&sip(0, 0, heading), CYCLE);
            }
            let truth = f64::from(turns.iter().sum::<i32>()) * Parameters::P3DX_SH.angle_rad;
            prop_assert!(wrap_angle(odometry.pose().heading - truth).abs() < 1e-9);
        }
    }

    #[test]
    fn a_robot_that_looked_elsewhere_at_first_goes_straight_ahead_all_the_same() {
        let mut odometry = odometry();
        odometry.take(&sip(0, 0, 1024), Duration::ZERO);
        odometry.take(&sip(0, 30, 1024), CYCLE);
        assert!((odometry.pose().x - 0.03).abs() < 1e-12 && odometry.pose().y.abs() < 1e-12);
    }

    #[test]
    fn counters_put_back_to_zero_neither_jump_nor_lose_the_way_in_between() {
        let mut odometry = odometry();
        for i in 0..=50 {
            odometry.take(&sip(30 * i, 0, 0), CYCLE * i as u32);
        }
        assert_eq!(odometry.take(&sip(0, 0, 0), CYCLE * 51), Taken::Rebased);
        for i in 1..=50 {
            assert_eq!(odometry.take(&sip(30 * i, 0, 0), CYCLE * (51 + i as u32)), Taken::Step);
        }
        assert!((odometry.pose().x - 3.03).abs() < 1e-9, "{:?}", odometry.pose());
    }

    #[test]
    fn a_packet_that_cannot_be_true_does_not_move_the_robot_far() {
        let mut odometry = odometry();
        odometry.take(&sip(0, 0, 0), CYCLE);
        odometry.take(&sip(30, 0, 0), CYCLE * 2);
        assert_eq!(odometry.take(&sip(9000, 4000, 0), CYCLE * 3), Taken::Rebased);
        assert_eq!(odometry.take(&sip(90, 0, 0), CYCLE * 4), Taken::Rebased);
        assert!((odometry.pose().x - 0.09).abs() < 1e-9 && odometry.pose().y.abs() < 1e-9);
    }
}

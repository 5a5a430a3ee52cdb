//! Two wheels that roll, and the odometry that counts on them.

use crate::geometry::{Pose, wrap_angle};
use crate::robot::p3dx;
use crate::simulation::Dice;
use crate::simulation::Noise;

/// What the wheels of this robot are like, against what its odometry counts on.
#[derive(Clone, Debug)]
pub(super) struct Wheels {
    /// Metres truly rolled per metre counted, left and right.
    scale: (f64, f64),
    /// Metres between the wheels, in truth.
    track_m: f64,
    slip: f64,
}

impl Wheels {
    pub(super) fn new(noise: &Noise, dice: &mut Dice) -> Self {
        let both = 1.0 + dice.error(noise.wheel_scale);
        let apart = dice.error(noise.wheel_mismatch) / 2.0;
        let track_m = p3dx::TRACK_M * (1.0 + dice.error(noise.track_scale));
        Self { scale: (both - apart, both + apart), track_m, slip: noise.slip }
    }

    /// Where the robot truly gets to while the wheels are counted to turn by `metres` and `radians`.
    pub(super) fn roll(&self, from: Pose, metres: f64, radians: f64, dice: &mut Dice) -> Pose {
        let half_turn = radians * p3dx::TRACK_M / 2.0;
        let (left, right) = ((metres - half_turn) * self.scale.0, (metres + half_turn) * self.scale.1);
        let left = left + dice.error(self.slip * left.abs().sqrt());
        let right = right + dice.error(self.slip * right.abs().sqrt());
        moved(from, (left + right) / 2.0, (right - left) / self.track_m)
    }
}

/// The pose after an arc of `metres` that turns by `radians`.
pub(super) fn moved(from: Pose, metres: f64, radians: f64) -> Pose {
    let middle = from.heading + radians / 2.0;
    Pose::new(from.x + metres * middle.cos(), from.y + metres * middle.sin(), wrap_angle(from.heading + radians))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn end_of_a_long_way(noise: Noise, seed: u64) -> Pose {
        let mut dice = Dice::new(seed, 0);
        let wheels = Wheels::new(&noise, &mut dice);
        (0..1000).fold(Pose::default(), |pose, _| wheels.roll(pose, 0.01, 0.0, &mut dice))
    }

    #[test]
    fn without_noise_the_robot_goes_where_it_counts() {
        let end = end_of_a_long_way(Noise::off(), 1);
        assert!((end.x - 10.0).abs() < 1e-9 && end.y.abs() < 1e-9);
    }

    #[test]
    fn unequal_wheels_bend_the_way_and_wrong_diameters_stretch_it() {
        let bent = end_of_a_long_way(Noise { wheel_mismatch: 0.01, ..Noise::off() }, 1);
        assert!(bent.y.abs() > 0.1, "{bent:?}");
        let stretched = end_of_a_long_way(Noise { wheel_scale: 0.02, ..Noise::off() }, 1);
        assert!((stretched.x - 10.0).abs() > 0.02 && stretched.y.abs() < 1e-9, "{stretched:?}");
    }

    #[test]
    fn slip_differs_from_seed_to_seed_and_not_from_run_to_run() {
        let noise = Noise { slip: 0.01, ..Noise::off() };
        assert_eq!(end_of_a_long_way(noise, 1), end_of_a_long_way(noise, 1));
        assert_ne!(end_of_a_long_way(noise, 1), end_of_a_long_way(noise, 2));
    }
}

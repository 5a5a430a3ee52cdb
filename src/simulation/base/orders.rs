//! Velocities on their way to the wheels: a base does what it is told a dead time later.

use std::collections::VecDeque;

use crate::simulation::Dice;
use crate::simulation::Noise;

/// Linear (m/s) and angular (rad/s) velocity.
type Velocity = (f64, f64);

/// What the wheels follow, and what they will follow next.
#[derive(Clone, Debug)]
pub(super) struct Orders {
    dead_time_s: f64,
    jitter_s: f64,
    step_s: f64,
    now: Velocity,
    /// From which step on each holds.
    on_their_way: VecDeque<(u64, Velocity)>,
}

impl Orders {
    /// Of a base that lives in steps of `step_s` seconds.
    pub fn new(noise: &Noise, step_s: f64) -> Self {
        let Noise { dead_time_s, jitter_s, .. } = *noise;
        Self { dead_time_s, jitter_s, step_s, now: (0.0, 0.0), on_their_way: VecDeque::new() }
    }

    /// Told at step `at`. None overtakes another.
    pub fn give(&mut self, at: u64, velocity: Velocity, dice: &mut Dice) {
        let jitter_s = if self.jitter_s > 0.0 { self.jitter_s * dice.share() } else { 0.0 };
        let from = at + ((self.dead_time_s + jitter_s) / self.step_s).round() as u64;
        let from = self.on_their_way.back().map_or(from, |(last, _)| from.max(*last));
        self.on_their_way.push_back((from, velocity));
    }

    /// What the wheels follow in step `at`.
    pub fn at(&mut self, at: u64) -> Velocity {
        while let Some((_, velocity)) = self.on_their_way.front().filter(|(from, _)| *from <= at) {
            self.now = *velocity;
            self.on_their_way.pop_front();
        }
        self.now
    }

    /// Wheels that brake in an emergency forget what they were told.
    pub fn forget(&mut self) {
        self.on_their_way.clear();
        self.now = (0.0, 0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_told_holds_a_dead_time_later_and_in_order_however_it_jitters() {
        let noise = Noise { dead_time_s: 0.1, jitter_s: 0.06, ..Noise::off() };
        let (mut orders, mut dice) = (Orders::new(&noise, 0.02), Dice::new(1, 0));
        (0..50).for_each(|step| orders.give(step, (step as f64, 0.0), &mut dice));
        let followed: Vec<f64> = (0..50).map(|step| orders.at(step).0).collect();
        assert!(followed[..5].iter().all(|velocity| *velocity == 0.0));
        assert!(followed.windows(2).all(|pair| pair[0] <= pair[1]) && followed[30] >= 22.0, "{followed:?}");
    }
}

//! Random choices, so that families read as what they are.

use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal, StandardUniform};

/// A source of random choices.
pub struct Dice<'r> {
    rng: &'r mut ChaCha8Rng,
}

impl<'r> Dice<'r> {
    /// Choices drawn from `rng`.
    pub fn new(rng: &'r mut ChaCha8Rng) -> Self {
        Self { rng }
    }

    /// Evenly from `low` to `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        let share: f64 = StandardUniform.sample(self.rng);
        low + (high - low) * share
    }

    /// About the middle of `low`–`high` more often than near its ends.
    pub fn about(&mut self, low: f64, high: f64) -> f64 {
        0.5 * (self.between(low, high) + self.between(low, high))
    }

    /// From the normal distribution.
    pub fn normal(&mut self, mean: f64, deviation: f64) -> f64 {
        let standard: f64 = StandardNormal.sample(self.rng);
        mean + deviation * standard
    }

    /// True with this probability.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.between(0.0, 1.0) < probability
    }

    /// A whole number from `low` to `high`, both possible.
    pub fn whole(&mut self, low: usize, high: usize) -> usize {
        low + (self.between(0.0, (high - low + 1) as f64) as usize).min(high - low)
    }

    /// One of the choices, each as likely.
    pub fn pick<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.whole(0, choices.len() - 1)]
    }
}

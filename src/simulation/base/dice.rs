//! The random numbers of one trial.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal, StandardUniform};

/// Keeps the robot's numbers apart from those of its eyes, which are drawn from the record's own stream.
const ROBOT: u64 = 0x726f_626f_7400_0000;

/// A seeded source, one stream per record.
#[derive(Clone, Debug)]
pub(super) struct Dice(ChaCha8Rng);

impl Dice {
    pub(super) fn new(seed: u64, stream: u64) -> Self {
        let mut source = ChaCha8Rng::seed_from_u64(seed);
        source.set_stream(stream ^ ROBOT);
        Self(source)
    }

    /// Normally distributed about zero.
    pub(super) fn normal(&mut self, deviation: f64) -> f64 {
        if deviation == 0.0 {
            return 0.0;
        }
        let value: f64 = StandardNormal.sample(&mut self.0);
        value * deviation
    }

    /// From 0 to 1.
    pub(super) fn share(&mut self) -> f64 {
        StandardUniform.sample(&mut self.0)
    }
}

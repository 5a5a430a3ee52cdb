//! How a trial is run: what the executive may do, what eyes it has, and its random stream.

use serde::{Deserialize, Serialize};

use super::Noise;
use super::camera::Kinect;
use crate::behavior::Options;

/// Everything about a trial that is neither home nor plan.
#[derive(Clone, Copy, Debug, Default)]
pub struct TrialSettings {
    /// What the executive may do.
    pub options: Options,
    /// What the robot's eyes report.
    pub perception: Perception,
    /// The simulated camera: its faults and the light.
    pub kinect: Kinect,
    /// How imperfect the robot is.
    pub noise: NoiseLevel,
    /// The base's dead time and its jitter, seconds, where they are not those of the noise.
    pub dead_time_s: Option<f64>,
    /// See there.
    pub jitter_s: Option<f64>,
    /// Seed of everything random.
    pub seed: u64,
}

/// What the robot's eyes report.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Perception {
    /// Ideal detections of what a camera would show
    #[default]
    Truth,
    /// True boxes with a sensor's noise, misses and confusions
    Boxes,
    /// Rendered Kinect frames truly divided among the items, our classifier
    Masks,
    /// Rendered Kinect frames, nothing true
    Camera,
}

/// How imperfect the simulated robot's wheels, sonars, compass and start are, against what its world says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum NoiseLevel {
    /// A robot without any error
    Off,
    /// As the scene says, or as usual
    #[default]
    Default,
    /// Twice that
    Double,
}

impl NoiseLevel {
    /// The noise of a robot in a world that has `usual`.
    pub fn of(self, usual: Noise) -> Noise {
        match self {
            Self::Off => Noise::off(),
            Self::Default => usual,
            Self::Double => usual.times(2.0),
        }
    }
}

impl TrialSettings {
    /// The noise of the robot in a world that has `usual`.
    pub fn noise_in(&self, usual: Noise) -> Noise {
        let noise = self.noise.of(usual);
        Noise {
            dead_time_s: self.dead_time_s.unwrap_or(noise.dead_time_s),
            jitter_s: self.jitter_s.unwrap_or(noise.jitter_s),
            ..noise
        }
    }
}

/// The random stream of a record: by its id, so that it is the same in any order, job or shard (FNV-1a).
pub fn stream_of(id: &str) -> u64 {
    id.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

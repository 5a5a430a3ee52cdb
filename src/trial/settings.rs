//! How a trial is run: what the executive may do, what eyes it has, and its random stream.

use crate::behavior::Options;
use crate::world::camera::Kinect;

/// Everything about a trial that is neither home nor plan.
#[derive(Clone, Copy, Debug, Default)]
pub struct Settings {
    /// What the executive may do.
    pub options: Options,
    /// What the robot's eyes report.
    pub perception: Perception,
    /// The simulated camera: its faults and the light.
    pub kinect: Kinect,
    /// Seed of everything random.
    pub seed: u64,
}

/// What the robot's eyes report.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
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

/// The random stream of a record: by its id, so that it is the same in any order, job or shard (FNV-1a).
pub fn stream_of(id: &str) -> u64 {
    id.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

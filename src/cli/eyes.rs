//! Options of the simulated robot's eyes, which `drive` and `evaluate` spell alike.

use std::ops::RangeInclusive;

use super::within;
use crate::simulation::camera::{Kinect, KinectFaults, Light};
use crate::simulation::{Perception, TrialSettings};

/// Multiples of the published noise that make sense.
pub(super) const DEPTH_NOISE: RangeInclusive<f64> = 0.0..=10.0;
/// Shares of pixels.
pub(super) const DEPTH_LOSS: RangeInclusive<f64> = 0.0..=1.0;
/// From darkness to glare.
pub(super) const LIGHT: RangeInclusive<f64> = 0.0..=2.0;

/// What the simulated robot's eyes report, and how good its Kinect is.
#[derive(Clone, Copy, Debug, clap::Args)]
#[command(next_help_heading = "Eyes")]
pub struct EyeArguments {
    /// What the robot's eyes report
    #[arg(long, value_enum, default_value = "truth")]
    pub perception: Perception,
    /// Noise of the simulated Kinect's depth, in multiples of the published
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, value_parser = within(DEPTH_NOISE))]
    pub depth_noise: f64,
    /// Share of depth pixels lost besides shadow, grazing and dark surfaces
    #[arg(long, value_name = "SHARE", default_value_t = KinectFaults::default().loss, value_parser = within(DEPTH_LOSS))]
    pub depth_loss: f64,
    /// Light in the rooms; 1 is well lit
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, value_parser = within(LIGHT))]
    pub light: f64,
}

impl EyeArguments {
    /// Settings with these eyes, else the usual ones.
    pub fn settings(&self) -> TrialSettings {
        TrialSettings { perception: self.perception, kinect: self.kinect(), ..TrialSettings::default() }
    }

    /// The simulated camera.
    pub fn kinect(&self) -> Kinect {
        let faults = KinectFaults { noise: self.depth_noise, loss: self.depth_loss, ..KinectFaults::default() };
        let light = Light { level: self.light, ..Light::default() };
        Kinect { faults, light, ..Kinect::default() }
    }
}

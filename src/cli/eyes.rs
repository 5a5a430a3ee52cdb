//! Options of the simulated robot's eyes, which `drive` and `evaluate` spell alike.

use crate::simulation::camera::{Kinect, KinectFaults, Light};
use crate::simulation::{Perception, TrialSettings};

/// What the simulated robot's eyes report, and how good its Kinect is.
#[derive(Clone, Copy, Debug, clap::Args)]
#[command(next_help_heading = "Eyes")]
pub struct EyeArguments {
    /// What the robot's eyes report
    #[arg(long, value_enum, default_value = "truth")]
    pub perception: Perception,
    /// Noise of the simulated Kinect's depth, in multiples of the published
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, value_parser = within(0.0, 10.0))]
    depth_noise: f64,
    /// Share of depth pixels lost besides shadow, grazing and dark surfaces
    #[arg(long, value_name = "SHARE", default_value_t = KinectFaults::default().loss, value_parser = within(0.0, 1.0))]
    depth_loss: f64,
    /// Light in the rooms; 1 is well lit
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, value_parser = within(0.0, 2.0))]
    light: f64,
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

/// Parses a number in a range.
fn within(low: f64, high: f64) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    move |text| match text.parse::<f64>() {
        Ok(value) if (low..=high).contains(&value) => Ok(value),
        _ => Err(format!("a number from {low} to {high} is needed")),
    }
}

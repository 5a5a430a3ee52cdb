//! Where the camera sits on the simulated robot.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The camera's place on the robot's tower, above the middle of the wheels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CameraMount {
    /// Metres above the floor.
    pub height_m: f64,
    /// Looking down by this much, degrees.
    pub tilt_deg: f64,
}

impl Default for CameraMount {
    /// A Kinect on a tower from which it sees table tops.
    fn default() -> Self {
        Self { height_m: 1.2, tilt_deg: 15.0 }
    }
}

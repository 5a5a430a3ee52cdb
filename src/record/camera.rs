//! What `perceive` adds of the camera: `camera`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Rounded;

/// Where a frame's camera stood, and from what that is known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CameraPose {
    /// Camera optical frame (x right, y down, z ahead) to world (z up, floor at 0), 4 × 4 by rows, metres.
    #[serde(rename = "T_world_cam")]
    pub world_from_camera: [[f64; 4]; 4],
    /// Metres above the floor.
    pub height: f64,
    /// Looking down by this much, degrees.
    pub tilt: f64,
    /// Held askew by this much, degrees; positive when its right side is the lower one.
    pub roll: f64,
    /// `record` (the line's `T_world_cam`), `transforms` (of a recording), `assumed_mount` (odometry and the usual place
    /// of a camera), `floor` (in the picture), `gravity` (level and upright surfaces in the picture, and the height that
    /// was told), `told` (height and tilt that were told).
    pub from: PoseSource,
}

/// From what a camera's pose is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PoseSource {
    /// The record's `T_world_cam`.
    Record,
    /// The transforms of a recording.
    Transforms,
    /// Odometry, and the usual place of a camera on a robot.
    AssumedMount,
    /// The floor in the picture.
    Floor,
    /// Level and upright surfaces in the picture, and the height that was told.
    Gravity,
    /// Height and tilt that were told, nothing in the picture.
    Told,
}

impl CameraPose {
    /// The pose as a record tells it.
    pub fn new(world_from_camera: [[f64; 4]; 4], from: PoseSource) -> Self {
        let [right, down, ahead, height] = world_from_camera[2];
        let degrees = |sine: f64| Rounded(sine.clamp(-1.0, 1.0).asin().to_degrees()).value();
        // The picture's right falls by the sine of the roll, foreshortened by the tilt.
        let roll = Rounded((-right).atan2(-down).to_degrees()).value();
        Self { world_from_camera, height: Rounded(height).value(), tilt: degrees(-ahead), roll, from }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn height_tilt_and_roll_are_read_off_the_matrix() {
        let (sin, cos) = 10.0_f64.to_radians().sin_cos();
        // Level, turned about its axis clockwise: its right side goes down.
        let rolled = [[0.0, 0.0, 1.0, 0.0], [-cos, sin, 0.0, 0.0], [-sin, -cos, 0.0, 1.3], [0.0, 0.0, 0.0, 1.0]];
        let pose = CameraPose::new(rolled, PoseSource::Floor);
        assert_eq!((pose.height, pose.tilt, pose.roll), (1.3, 0.0, 10.0));
        let down = [[0.0, -sin, cos, 0.0], [-1.0, 0.0, 0.0, 0.0], [0.0, -cos, -sin, 0.2], [0.0, 0.0, 0.0, 1.0]];
        let pose = CameraPose::new(down, PoseSource::Told);
        assert_eq!((pose.height, pose.tilt, pose.roll), (0.2, 10.0, 0.0));
    }
}

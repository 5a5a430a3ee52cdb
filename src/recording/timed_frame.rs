//! A frame with when and where it was taken, and the frames of reference between robot and camera.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion};

use super::time::nanoseconds;
use crate::frame::RgbdFrame;
use crate::geometry::Pose;
use crate::record::PoseSource;

/// A frame with its times.
#[derive(Clone, Debug, PartialEq)]
pub struct TimedFrame {
    /// When it was taken, by the camera's own stamp, nanoseconds.
    pub stamp_ns: u64,
    /// When it was logged, nanoseconds.
    pub log_ns: u64,
    /// Where the robot stood, when that is known.
    pub robot: Option<Pose>,
    /// The frame.
    pub frame: RgbdFrame,
    /// From what the camera's pose is known.
    pub pose_from: PoseSource,
}

impl TimedFrame {
    /// A frame taken and logged at one time, seconds.
    pub fn at(time_s: f64, robot: Option<Pose>, frame: RgbdFrame) -> Self {
        let stamp_ns = nanoseconds(time_s);
        Self { stamp_ns, log_ns: stamp_ns, robot, frame, pose_from: PoseSource::Transforms }
    }

    /// When it was taken, seconds.
    pub fn time_s(&self) -> f64 {
        self.stamp_ns as f64 / 1e9
    }

    /// The camera's optical frame in the world, metres.
    pub(super) fn world_from_optical(&self) -> Isometry3<f64> {
        let t = &self.frame.world_from_camera;
        let turn = Matrix3::from_fn(|row, column| t[row][column]);
        let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(turn));
        Isometry3::from_parts(Translation3::new(t[0][3], t[1][3], t[2][3]), rotation)
    }
}

/// From `camera_link` (x ahead, y left, z up) to `camera_optical_frame` (x right, y down, z ahead), as REP 103 has it.
pub(super) fn optical_from_link() -> Isometry3<f64> {
    let turn = UnitQuaternion::from_euler_angles(-FRAC_PI_2, 0.0, -FRAC_PI_2).inverse();
    Isometry3::from_parts(Translation3::identity(), turn)
}

/// A pose on the floor as a pose in space.
pub(super) fn in_space(pose: Pose) -> Isometry3<f64> {
    Isometry3::from_parts(
        Translation3::new(pose.x, pose.y, 0.0),
        UnitQuaternion::from_euler_angles(0.0, 0.0, pose.heading),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    #[test]
    fn what_lies_ahead_of_the_link_lies_along_the_optical_axis() {
        let ahead = optical_from_link() * Vector3::new(1.0, 0.0, 0.0);
        let left = optical_from_link() * Vector3::new(0.0, 1.0, 0.0);
        assert!((ahead - Vector3::new(0.0, 0.0, 1.0)).norm() < 1e-12, "{ahead}");
        assert!((left - Vector3::new(-1.0, 0.0, 0.0)).norm() < 1e-12, "{left}");
    }
}

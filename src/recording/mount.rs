//! Where the camera is when transforms alone do not say: odometry, and the usual tower.

use nalgebra::{Isometry3, Translation3, UnitQuaternion};

use super::sensed::Transform;
use super::timed_frame::optical_from_link;
use super::transform_tree::{Placed, TransformTree, Unplaced};
use crate::frame::Camera;

/// Odometry kept beside the transforms, which go before it.
#[derive(Clone, Debug, Default)]
pub(super) struct Mount {
    base: Option<String>,
    odometry: TransformTree,
}

type Found = Result<(Placed, Option<String>), Unplaced>;

impl Mount {
    pub(super) fn odometry(&mut self, pose: Transform) {
        self.base = Some(pose.child.clone());
        self.odometry.insert(&pose, false);
    }

    pub(super) fn forget_before(&mut self, stamp_ns: u64) {
        self.odometry.forget_before(stamp_ns);
    }

    pub(super) fn forget_moving(&mut self) {
        self.odometry.forget_moving();
    }

    pub(super) fn is_settled(&self, tree: &TransformTree, camera: &str, stamp_ns: u64) -> bool {
        let Some(base) = &self.base else { return false };
        let root = tree.place(camera, stamp_ns).map(|placed| placed.root);
        root.is_ok_and(|root| root == *base) && {
            // The parent of odometry is a root, so only the base's own track counts.
            self.odometry.has_since(base, stamp_ns)
        }
    }

    pub(super) fn robot_at(&self, stamp_ns: u64) -> Option<Isometry3<f64>> {
        let base = self.base.as_ref()?;
        self.odometry.place(base, stamp_ns).ok().map(|placed| placed.root_from_frame)
    }

    /// Carries on from where the transforms ended: by odometry, if need be with the camera on the usual tower.
    pub(super) fn complete(
        &self,
        tree: &TransformTree,
        camera: &str,
        stamp_ns: u64,
        found: Result<Placed, Unplaced>,
    ) -> Found {
        let Some(base) = &self.base else { return found.and_then(|placed| trusted(placed, camera)).map(|p| (p, None)) };
        match found {
            Ok(placed) if placed.root == *base => {
                let odom = self.odometry.place(base, stamp_ns)?;
                Ok((Placed { root: odom.root, root_from_frame: odom.root_from_frame * placed.root_from_frame }, None))
            }
            Ok(placed) if trusted(placed.clone(), camera).is_ok() => Ok((placed, None)),
            Err(Unplaced::OtherTime { frame, off_ns }) => Err(Unplaced::OtherTime { frame, off_ns }),
            _ if tree.knows(base) => Err(Unplaced::Unknown(camera.to_string())),
            _ => {
                let odom = self.odometry.place(base, stamp_ns)?;
                let (mount, said) = tower();
                let said = format!("nothing says where `{camera}` is on `{base}`: taken to be {said}");
                Ok((Placed { root: odom.root, root_from_frame: odom.root_from_frame * mount }, Some(said)))
            }
        }
    }
}

/// A chain that ends within the camera itself says nothing of where the camera is.
fn trusted(placed: Placed, camera: &str) -> Result<Placed, Unplaced> {
    let device = |frame: &str| frame.split('_').next().unwrap_or(frame).to_string();
    if device(&placed.root) == device(camera) { Err(Unplaced::Unknown(placed.root)) } else { Ok(placed) }
}

/// The robot's usual camera: base from optical frame, and in words.
fn tower() -> (Isometry3<f64>, String) {
    let camera = Camera::kinect();
    let said = format!("{:.1} m up, looking {:.0}° down", camera.tower_m, camera.tilt.to_degrees());
    (tower_link(&camera) * optical_from_link().inverse(), said)
}

/// Base from the `camera_link` of a camera on the robot's tower.
pub(super) fn tower_link(camera: &Camera) -> Isometry3<f64> {
    let down = UnitQuaternion::from_euler_angles(0.0, camera.tilt, 0.0);
    Isometry3::from_parts(Translation3::new(0.0, 0.0, camera.tower_m), down)
}

//! Where a picture's camera was: by transforms and odometry, and where these do not reach the floor, by the picture.

use nalgebra::{Isometry3, Matrix3, Matrix4, Rotation3, Translation3, UnitQuaternion, Vector3};

use super::mount::{Completed, Mount, Taken, tower};
use super::transform_tree::{Placed, Trees, Unplaced, WORLDS};
use crate::frame::steady;
use crate::perception::{Depths, NoPose, Told, camera_over_floor};
use crate::record::PoseSource;

/// A camera whose place has no floor to stand over is believed within this of what the picture shows, metres and sine.
const AGREE_M: f64 = 0.25;
const AGREE_SINE: f64 = 0.26;
/// A camera is no lower and no higher than this, metres.
const HEIGHTS_M: std::ops::Range<f64> = 0.05..5.0;

type Pose = [[f64; 4]; 4];

/// A camera's place, and how it is known.
pub(super) struct Place {
    pub(super) world_from_camera: Pose,
    pub(super) robot: Option<Isometry3<f64>>,
    pub(super) from: PoseSource,
    /// What was taken for granted, when anything was.
    pub(super) assumed: Option<String>,
}

/// Why a picture has no place.
#[derive(Debug, thiserror::Error)]
pub(super) enum NoPlace {
    #[error("{0}")]
    Transforms(#[from] Unplaced),
    #[error("{0}; and {1}: give the camera's height and tilt (--camera-height METRES, --camera-tilt DEGREES)")]
    Picture(Unplaced, NoPose),
}

impl std::fmt::Display for Unplaced {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Self::Unknown(frame) => {
                let wanted = "tf or tf_static up to map, odom or base_link, or odometry";
                write!(f, "nothing says where `{frame}` is ({wanted})")
            }
            Self::OtherTime { frame, off_ns } => {
                let off_s = *off_ns as f64 / 1e9;
                let differ = "the clocks of the pictures and the poses differ";
                write!(f, "the nearest pose of `{frame}` is {off_s:.1} s off; {differ}")
            }
            Self::OtherBase { root, base } => write!(
                f,
                "the transforms end at `{root}`, and odometry moves `{base}`: nothing says how the two lie; publish a \
                 transform between them, or name the topic of `{root}`'s odometry by --topic"
            ),
            Self::Torn(frame) => {
                write!(
                    f,
                    "`{frame}` is said to be at several places at once: the transforms of several robots are mixed"
                )
            }
            Self::OtherRobots(topics) => {
                let all = topics.join(", ");
                write!(
                    f,
                    "{all} are of several robots, and nothing says whose camera this is; cut the log to one robot"
                )
            }
        }
    }
}

impl std::error::Error for Unplaced {}

/// Where the camera was; by what the picture shows of the floor when nothing else tells.
pub(super) fn place(trees: &Trees, mount: &Mount, taken: Taken, depths: &Depths, told: Told) -> Result<Place, NoPlace> {
    match mount.complete(trees, taken) {
        Ok(Completed::Known(placed)) => Ok(known(trees, mount, taken, &placed, (depths, told))),
        Ok(Completed::Assumed { base, said }) => Ok(assumed(base, &said, depths, told)),
        Err(Unplaced::Unknown(frame)) => {
            let found = camera_over_floor(depths, told);
            let (pose, from) = found.map_err(|why| NoPlace::Picture(Unplaced::Unknown(frame), why))?;
            Ok(Place { world_from_camera: steady(pose), robot: None, from, assumed: None })
        }
        Err(other) => Err(other.into()),
    }
}

/// A place by transforms. Where their chain has no base on the floor – a camera that tells its own motion from where it
/// began – height and tilt are the picture's.
fn known(trees: &Trees, mount: &Mount, taken: Taken, placed: &Placed, (depths, told): (&Depths, Told)) -> Place {
    let (height, up) = (placed.root_from_frame.translation.z, up_in_camera(&rows(&placed.root_from_frame)));
    let stands = HEIGHTS_M.contains(&height) && placed.chain.iter().any(|frame| stands_on_floor(frame));
    let by_transforms = || Place {
        world_from_camera: rows(&placed.root_from_frame),
        robot: robot(trees, mount, taken),
        from: PoseSource::Transforms,
        assumed: None,
    };
    if stands {
        return by_transforms();
    }
    let Ok((pose, from)) = camera_over_floor(depths, told) else { return by_transforms() };
    let is_upright = up.cross(&up_in_camera(&pose)).norm() < AGREE_SINE && up.dot(&up_in_camera(&pose)) > 0.0;
    if is_upright && (height - pose[2][3]).abs() < AGREE_M {
        return by_transforms();
    }
    let at = placed.root_from_frame.translation.vector;
    let heading = placed.root_from_frame * Vector3::z();
    let turned = in_plane(at.x, at.y, heading.y.atan2(heading.x)) * isometry(&pose);
    let world_from_camera = if is_upright { rows(&turned) } else { steady(pose) };
    Place { world_from_camera, robot: None, from, assumed: None }
}

/// A place by odometry, over the robot's middle and looking ahead: by the floor, or on the usual tower.
fn assumed(base: Isometry3<f64>, said: &str, depths: &Depths, told: Told) -> Place {
    let (mount, from, how) = match camera_over_floor(depths, told) {
        Ok((pose, from)) => {
            let how = "height and tilt are the picture's, and it is taken to look ahead from the robot's middle";
            (isometry(&pose), from, how.to_string())
        }
        Err(_) => {
            let (mount, how) = tower();
            (mount, PoseSource::AssumedMount, format!("taken to be {how}"))
        }
    };
    let world_from_camera = rows(&(base * mount));
    Place { world_from_camera, robot: Some(base), from, assumed: Some(format!("{said}: {how}")) }
}

fn robot(trees: &Trees, mount: &Mount, taken: Taken) -> Option<Isometry3<f64>> {
    let base = ["base_link", "base_footprint"].into_iter().find(|frame| trees.knows(frame));
    let placed = base.and_then(|frame| trees.place(frame, taken.stamp_ns).ok()).map(|p| p.root_from_frame);
    placed.or_else(|| mount.robot_at(taken))
}

/// Whether a frame is of something on the floor, by its name: the world, or a robot's base.
fn stands_on_floor(frame: &str) -> bool {
    let name = frame.rsplit('/').next().unwrap_or(frame);
    WORLDS.contains(&name) || name.contains("base") || name.contains("footprint")
}

/// The world's up in the camera's optical frame.
fn up_in_camera(pose: &Pose) -> Vector3<f64> {
    Vector3::new(pose[2][0], pose[2][1], pose[2][2])
}

fn in_plane(x: f64, y: f64, heading: f64) -> Isometry3<f64> {
    let turn = UnitQuaternion::from_euler_angles(0.0, 0.0, heading);
    Isometry3::from_parts(Translation3::new(x, y, 0.0), turn)
}

fn isometry(pose: &Pose) -> Isometry3<f64> {
    let turn = Rotation3::from_matrix_unchecked(Matrix3::from_fn(|row, column| pose[row][column]));
    let at = Translation3::new(pose[0][3], pose[1][3], pose[2][3]);
    Isometry3::from_parts(at, UnitQuaternion::from_rotation_matrix(&turn))
}

fn rows(isometry: &Isometry3<f64>) -> Pose {
    let matrix: Matrix4<f64> = isometry.to_homogeneous();
    steady(std::array::from_fn(|row| std::array::from_fn(|column| matrix[(row, column)])))
}

//! Where the camera is when transforms alone do not say: odometry, and the usual tower.

use std::collections::BTreeMap;

use nalgebra::{Isometry3, Translation3, UnitQuaternion};

use super::sensed::Transform;
use super::spaces::kinship;
use super::timed_frame::optical_from_link;
use super::transform_tree::{Placed, TransformTree, Trees, Unplaced, WORLDS};
use crate::frame::Camera;

/// Odometry kept beside the transforms, which go before it.
#[derive(Clone, Debug, Default)]
pub(super) struct Mount {
    /// By topic: where one base is.
    odometry: BTreeMap<String, TransformTree>,
    /// Topics that were named; when there are any, only they count.
    named: Vec<String>,
}

/// A picture: its camera's frame, topic and time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Taken<'a> {
    pub(super) camera: &'a str,
    pub(super) topic: &'a str,
    pub(super) stamp_ns: u64,
}

/// One topic's odometry: `base` within `parent`.
#[derive(Clone, Copy)]
struct Odometry<'a> {
    topic: &'a str,
    tree: &'a TransformTree,
    base: &'a str,
    parent: &'a str,
}

impl Odometry<'_> {
    /// `/robot1/odom` and `/robot2/odom` are of two robots; `/odom` and `/odometry/filtered` are not.
    fn is_of_another_robot_than(&self, other: &Self) -> bool {
        let name = |topic: &str| topic.rsplit('/').next().map(str::to_string);
        self.topic != other.topic && name(self.topic) == name(other.topic)
    }
}

/// How a camera's place came about.
#[derive(Clone, Debug)]
pub(super) enum Completed {
    /// By transforms, if need be with odometry.
    Known(Placed),
    /// By odometry, with a camera on the usual tower; the base is at `base`.
    Assumed { base: Isometry3<f64>, said: String },
}

impl Mount {
    pub(super) fn new(named: Vec<String>) -> Self {
        Self { odometry: BTreeMap::new(), named }
    }

    pub(super) fn odometry(&mut self, topic: &str, pose: &Transform) {
        self.odometry.entry(topic.to_string()).or_default().insert(pose, false);
    }

    pub(super) fn forget_before(&mut self, stamp_ns: u64) {
        self.odometry.values_mut().for_each(|base| base.forget_before(stamp_ns));
    }

    pub(super) fn forget_moving(&mut self) {
        self.odometry.clear();
    }

    /// The odometry that may be of the robot with this camera, the likeliest first.
    fn candidates(&self, topic: &str) -> Vec<Odometry<'_>> {
        let any_named = self.odometry.keys().any(|name| self.named.contains(name));
        let wanted = self.odometry.iter().filter(|(name, _)| !any_named || self.named.contains(name));
        let mut found: Vec<Odometry> = wanted
            .filter_map(|(topic, tree)| tree.only().map(|(base, parent)| Odometry { topic, tree, base, parent }))
            .collect();
        // Another robot's odometry has less in common with this camera than its own.
        let nearest = found.iter().map(|c| kinship(c.topic, topic)).max().unwrap_or(0);
        found.retain(|c| kinship(c.topic, topic) == nearest);
        // Poses of a goal or a map's origin are written as odometry is.
        found.sort_by_key(|c| !c.topic.contains("odom"));
        found
    }

    pub(super) fn is_settled(&self, trees: &Trees, taken: Taken) -> bool {
        let Ok(placed) = trees.place(taken.camera, taken.stamp_ns) else { return false };
        self.candidates(taken.topic).iter().any(|c| {
            root_from_base(trees, c.base, &placed, taken.stamp_ns).is_some() && c.tree.has_since(c.base, taken.stamp_ns)
        })
    }

    /// Where the robot was, by odometry alone.
    pub(super) fn robot_at(&self, taken: Taken) -> Option<Isometry3<f64>> {
        let first = self.candidates(taken.topic).into_iter().next()?;
        first.tree.place(first.base, taken.stamp_ns).ok().map(|placed| placed.root_from_frame)
    }

    /// Carries on from where the transforms ended: by odometry, if need be with the camera on the usual tower.
    pub(super) fn complete(&self, trees: &Trees, taken: Taken) -> Result<Completed, Unplaced> {
        let found = trees.place(taken.camera, taken.stamp_ns);
        let candidates = self.candidates(taken.topic);
        if let Err(Unplaced::OtherTime { .. } | Unplaced::Torn(_)) = &found {
            return found.map(Completed::Known);
        }
        let placed = found.ok().filter(|placed| !within_device(placed.root(), taken.camera));
        let Some(placed) = placed else { return self.without_transforms(trees, taken) };
        if candidates.is_empty() || is_world(placed.root()) || candidates.iter().any(|c| c.parent == placed.root()) {
            return Ok(Completed::Known(placed));
        }
        let fits = |c: &&Odometry| root_from_base(trees, c.base, &placed, taken.stamp_ns).is_some();
        let fitting: Vec<&Odometry> = candidates.iter().filter(fits).collect();
        let Some(first) = fitting.first() else {
            let base = candidates.first().map_or("", |c| c.base).to_string();
            return Err(Unplaced::OtherBase { root: placed.root().to_string(), base });
        };
        if fitting.iter().any(|other| other.is_of_another_robot_than(first)) {
            return Err(Unplaced::OtherRobots(fitting.iter().map(|c| c.topic.to_string()).collect()));
        }
        // The transforms tell the base's motion themselves.
        if trees.moves(first.base) {
            return Ok(Completed::Known(placed));
        }
        carried_on(trees, first, placed, taken.stamp_ns)
    }

    fn without_transforms(&self, trees: &Trees, taken: Taken) -> Result<Completed, Unplaced> {
        let unknown = Unplaced::Unknown(taken.camera.to_string());
        let candidates = self.candidates(taken.topic);
        let Some(Odometry { tree, base, .. }) = candidates.first() else { return Err(unknown) };
        if trees.knows(base) {
            return Err(unknown);
        }
        let said = format!("nothing says where `{}` is on `{base}`", taken.camera);
        Ok(Completed::Assumed { base: tree.place(base, taken.stamp_ns)?.root_from_frame, said })
    }
}

/// The camera's place, with odometry where the transforms ended.
fn carried_on(trees: &Trees, odometry: &Odometry, placed: Placed, stamp_ns: u64) -> Result<Completed, Unplaced> {
    let odom = odometry.tree.place(odometry.base, stamp_ns)?;
    let root_from_base = root_from_base(trees, odometry.base, &placed, stamp_ns).unwrap_or_default();
    let root_from_frame = odom.root_from_frame * root_from_base.inverse() * placed.root_from_frame;
    let chain = placed.chain.iter().cloned().chain([odom.root().to_string()]).collect();
    Ok(Completed::Known(Placed { chain, root_from_frame }))
}

/// Whether a frame stands still in the room, by its name.
fn is_world(frame: &str) -> bool {
    WORLDS.contains(&frame) || frame.rsplit('/').next().is_some_and(|name| name.contains("odom") || name == "map")
}

/// Where odometry's base is within the frame in which the camera's chain ends, when the transforms tell.
fn root_from_base(trees: &Trees, base: &str, camera: &Placed, stamp_ns: u64) -> Option<Isometry3<f64>> {
    if base == camera.root() {
        return Some(Isometry3::identity());
    }
    trees.place(base, stamp_ns).ok().filter(|placed| placed.root() == camera.root()).map(|p| p.root_from_frame)
}

/// A chain that ends within the camera itself says nothing of where the camera is.
fn within_device(root: &str, camera: &str) -> bool {
    let device = |frame: &str| frame.split('_').next().unwrap_or(frame).to_string();
    device(root) == device(camera)
}

/// The robot's usual camera: base from optical frame, and in words.
pub(super) fn tower() -> (Isometry3<f64>, String) {
    let camera = Camera::kinect();
    let said = format!("{:.1} m up, looking {:.0}° down", camera.tower_m, camera.tilt.to_degrees());
    (tower_link(&camera) * optical_from_link().inverse(), said)
}

/// Base from the `camera_link` of a camera on the robot's tower.
pub(super) fn tower_link(camera: &Camera) -> Isometry3<f64> {
    let down = UnitQuaternion::from_euler_angles(0.0, camera.tilt, 0.0);
    Isometry3::from_parts(Translation3::new(0.0, 0.0, camera.tower_m), down)
}

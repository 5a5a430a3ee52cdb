//! Pictures, cameras and poses brought together by their stamps.

use std::collections::BTreeMap;

use nalgebra::{Isometry3, Matrix4};

use super::losses::Losses;
use super::mount::Mount;
use super::pictures::{self, DEPTH_UNIT_M};
use super::roles::Roles;
use super::sensed::{Header, Image, Info, Sensed};
use super::transform_tree::{Placed, TransformTree, Unplaced};
use super::{Loss, TimedFrame};
use crate::frame::{RgbdFrame, steady};
use crate::geometry::Pose;

/// Colour and depth further apart than this are not one frame, nanoseconds.
const APART_NS: u64 = 50_000_000;
/// What has not come this long after a depth picture, by the log's clock, will not come, nanoseconds.
const PATIENCE_NS: u64 = 1_000_000_000;
/// A stamp that goes back by more than this is a clock that was moved, nanoseconds.
const CLOCK_MOVED_NS: u64 = 1_000_000_000;
/// What is kept of the past, nanoseconds.
const MEMORY_NS: u64 = 5_000_000_000;
/// No more pictures are kept waiting than this.
const MOST_WAITING: usize = 64;

/// Everything that has come and may still become part of a frame.
pub(super) struct Assembly {
    roles: Roles,
    depths: Vec<Waiting>,
    colors: BTreeMap<u64, Image>,
    infos: BTreeMap<String, Info>,
    tree: TransformTree,
    mount: Mount,
    newest_stamp_ns: u64,
    pub(super) losses: Losses,
}

struct Waiting {
    image: Image,
    log_ns: u64,
}

type Items = Vec<Result<TimedFrame, Loss>>;

impl Assembly {
    pub(super) fn new(topics: Vec<String>) -> Self {
        Self {
            roles: Roles::new(topics),
            depths: Vec::new(),
            colors: BTreeMap::new(),
            infos: BTreeMap::new(),
            tree: TransformTree::default(),
            mount: Mount::default(),
            newest_stamp_ns: 0,
            losses: Losses::default(),
        }
    }

    /// Takes a message in; gives out the frames it completes.
    pub(super) fn take(&mut self, topic: &str, log_ns: u64, sensed: Sensed) -> Items {
        let mut items = Items::new();
        match sensed {
            Sensed::Image(image) => self.take_image(topic, log_ns, image, &mut items),
            Sensed::Info(info) => {
                self.infos.insert(info.header.frame.clone(), info);
            }
            Sensed::Transforms(all) => {
                let fixed = topic.ends_with("_static");
                all.iter().for_each(|one| self.tree.insert(one, fixed));
            }
            Sensed::Odometry(pose) => {
                if self.roles.takes_odometry(topic) {
                    self.mount.odometry(pose);
                }
            }
            Sensed::Other => {}
        }
        self.give_out(log_ns, &mut items);
        items
    }

    /// Nothing more comes: gives out what can be made of the rest.
    pub(super) fn finish(&mut self) -> Items {
        let mut items = Items::new();
        self.give_out(u64::MAX, &mut items);
        items.extend(self.losses.totals().map(Err));
        items
    }

    fn take_image(&mut self, topic: &str, log_ns: u64, mut image: Image, items: &mut Items) {
        let is_depth = image.is_depth();
        match self.roles.takes_picture(topic, is_depth) {
            Ok(true) => {}
            Ok(false) => return,
            Err(what) => return items.extend(self.losses.note("pictures on other topics", what).map(Err)),
        }
        if image.header().stamp_ns == 0 {
            image.restamp(log_ns);
        }
        let stamp_ns = image.header().stamp_ns;
        if stamp_ns + CLOCK_MOVED_NS < self.newest_stamp_ns {
            self.clock_moved(stamp_ns, items);
        }
        self.newest_stamp_ns = self.newest_stamp_ns.max(stamp_ns);
        if is_depth {
            self.depths.push(Waiting { image, log_ns });
        } else {
            self.colors.insert(stamp_ns, image);
        }
        let oldest = self.newest_stamp_ns.saturating_sub(MEMORY_NS);
        self.tree.forget_before(oldest);
        self.mount.forget_before(oldest);
        while self.colors.len() > MOST_WAITING {
            self.colors.pop_first();
        }
    }

    /// What was sensed by the old clock no longer fits what comes.
    fn clock_moved(&mut self, stamp_ns: u64, items: &mut Items) {
        let back_s = (self.newest_stamp_ns - stamp_ns) as f64 / 1e9;
        self.give_out(u64::MAX, items);
        self.colors.clear();
        self.tree.forget_moving();
        self.mount.forget_moving();
        self.newest_stamp_ns = 0;
        let what = format!("the clock moved back by {back_s:.1} s; poses from before that are not used after it");
        items.extend(self.losses.note("moves of the clock", what).map(Err));
    }

    /// Gives out the frames that are complete, or have waited long enough at `now_ns` of the log's clock.
    fn give_out(&mut self, now_ns: u64, items: &mut Items) {
        while let Some(first) = self.depths.first() {
            let waited = now_ns.saturating_sub(first.log_ns) > PATIENCE_NS || self.depths.len() > MOST_WAITING;
            if !waited && !self.is_complete(first.image.header()) {
                return;
            }
            let Waiting { image, log_ns } = self.depths.remove(0);
            match self.assemble(&image, log_ns, items) {
                Ok(frame) => items.push(Ok(frame)),
                Err((kind, what)) => items.extend(self.losses.note(kind, what).map(Err)),
            }
        }
    }

    /// Whether nothing that may still come would make the frame better.
    fn is_complete(&self, header: &Header) -> bool {
        let colored = self.colors.range(header.stamp_ns..).next().is_some();
        colored && self.camera_of(header).is_some() && {
            self.tree.is_settled(&header.frame, header.stamp_ns)
                || self.mount.is_settled(&self.tree, &header.frame, header.stamp_ns)
        }
    }

    fn camera_of(&self, header: &Header) -> Option<&Info> {
        let only = || self.infos.values().next().filter(|_| self.infos.len() == 1);
        self.infos.get(&header.frame).or_else(only)
    }

    fn assemble(
        &mut self,
        image: &Image,
        log_ns: u64,
        items: &mut Items,
    ) -> Result<TimedFrame, (&'static str, String)> {
        let header = image.header().clone();
        let at = format!("the depth picture of {:.3} s", header.stamp_ns as f64 / 1e9);
        let depth =
            pictures::depth(image).map_err(|what| ("undecodable pictures", format!("{at} is skipped: {what}")))?;
        let intrinsics = self.camera_of(&header).map(|info| (info.width, info.height, info.intrinsics));
        let Some((_, _, Some(intrinsics))) = intrinsics else {
            let what = "no camera info with its focal lengths (sensor_msgs/CameraInfo, foxglove.CameraCalibration)";
            return Err(("frames without intrinsics", format!("{at} is skipped: {what} for `{}`", header.frame)));
        };
        let placed =
            self.place(&header, items).map_err(|what| ("frames without a pose", format!("{at} is skipped: {what}")))?;
        let color = self.color_for(&header, depth.width, depth.height, items);
        let frame = RgbdFrame {
            width: depth.width,
            height: depth.height,
            color,
            depth: depth.pixels,
            depth_unit_m: DEPTH_UNIT_M,
            intrinsics,
            world_from_camera: rows(&placed.root_from_frame),
        };
        Ok(TimedFrame {
            stamp_ns: header.stamp_ns,
            log_ns,
            robot: self.robot_at(header.stamp_ns),
            frame,
            pose_from: crate::record::PoseSource::Transforms,
        })
    }

    fn place(&mut self, header: &Header, items: &mut Items) -> Result<Placed, String> {
        let found = self.tree.place(&header.frame, header.stamp_ns);
        match self.mount.complete(&self.tree, &header.frame, header.stamp_ns, found) {
            Ok((placed, None)) => Ok(placed),
            Ok((placed, Some(assumed))) => {
                items.extend(self.losses.note("frames with an assumed camera mount", assumed).map(Err));
                Ok(placed)
            }
            Err(Unplaced::Unknown(frame)) => Err(format!(
                "nothing says where `{frame}` is (tf or tf_static up to map, odom or base_link, or odometry)"
            )),
            Err(Unplaced::OtherTime { frame, off_ns }) => Err(format!(
                "the nearest pose of `{frame}` is {:.1} s off; the clocks of the pictures and the poses differ",
                off_ns as f64 / 1e9
            )),
        }
    }

    /// The colour picture nearest in time; none when it is too far off or does not fit.
    fn color_for(&mut self, header: &Header, width: usize, height: usize, items: &mut Items) -> Vec<[u8; 3]> {
        let before = self.colors.range(..=header.stamp_ns).next_back();
        let after = self.colors.range(header.stamp_ns..).next();
        let nearest = [before, after].into_iter().flatten().min_by_key(|(stamp, _)| stamp.abs_diff(header.stamp_ns));
        let Some((stamp, image)) = nearest else {
            if self.roles.has_color() {
                let what = "a depth picture without a colour picture near its time";
                items.extend(self.losses.note("frames without colour", what.to_string()).map(Err));
            }
            return Vec::new();
        };
        let off_ns = stamp.abs_diff(header.stamp_ns);
        let problem = if off_ns > APART_NS {
            format!(
                "colour and depth are not synchronised: the nearest colour picture is {:.3} s off",
                off_ns as f64 / 1e9
            )
        } else {
            match pictures::color(image) {
                Ok(color) if (color.width, color.height) == (width, height) => return color.pixels,
                Ok(color) => format!(
                    "the colour picture has {} × {} pixels, depth {width} × {height}: colour must be registered to depth",
                    color.width, color.height
                ),
                Err(what) => what,
            }
        };
        items.extend(self.losses.note("frames without colour", problem).map(Err));
        Vec::new()
    }

    fn robot_at(&self, stamp_ns: u64) -> Option<Pose> {
        let base = ["base_link", "base_footprint"].into_iter().find(|frame| self.tree.knows(frame));
        let placed = base.and_then(|frame| self.tree.place(frame, stamp_ns).ok()).map(|p| p.root_from_frame);
        let pose = placed.or_else(|| self.mount.robot_at(stamp_ns))?;
        Some(Pose::new(pose.translation.x, pose.translation.y, pose.rotation.euler_angles().2))
    }
}

fn rows(isometry: &Isometry3<f64>) -> [[f64; 4]; 4] {
    let matrix: Matrix4<f64> = isometry.to_homogeneous();
    steady(std::array::from_fn(|row| std::array::from_fn(|column| matrix[(row, column)])))
}

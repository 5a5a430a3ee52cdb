//! Pictures, cameras and poses brought together by their stamps.

use std::collections::BTreeMap;

use super::lens::intrinsics_for;
use super::losses::Losses;
use super::mount::{Mount, Taken};
use super::pictures::{self, DEPTH_UNIT_M};
use super::place::{NoPlace, Place, place};
use super::roles::{Role, Roles};
use super::sensed::{Header, Image, Info, Sensed};
use super::spaces::{Spaces, folder, kinship};
use super::{Loss, TimedFrame};
use crate::frame::{Intrinsics, Picture, RgbdFrame};
use crate::geometry::Pose;
use crate::limits::MCAP_WAITING;
use crate::perception::{Depths, Told};

/// Colour and depth further apart than this are not one frame, nanoseconds.
const APART_NS: u64 = 50_000_000;
/// What has not come this long after a depth picture, by the log's clock, will not come, nanoseconds.
const PATIENCE_NS: u64 = 1_000_000_000;
/// A stamp that goes back by more than this is a clock that was moved, nanoseconds.
const CLOCK_MOVED_NS: u64 = 1_000_000_000;
/// What is kept of the past, nanoseconds.
const MEMORY_NS: u64 = 5_000_000_000;

/// Everything that has come and may still become part of a frame.
pub(super) struct Assembly {
    roles: Roles,
    depths: Vec<Waiting>,
    colors: BTreeMap<u64, Image>,
    /// By topic.
    infos: BTreeMap<String, Info>,
    spaces: Spaces,
    mount: Mount,
    told: Told,
    newest_stamp_ns: u64,
    /// Why pictures that might have been depth were passed over.
    pub(super) doubtful: BTreeMap<String, String>,
    pub(super) losses: Losses,
}

struct Waiting {
    image: Image,
    topic: String,
    log_ns: u64,
}

impl Waiting {
    fn taken(&self) -> Taken<'_> {
        let Header { stamp_ns, frame } = self.image.header();
        Taken { camera: frame, topic: &self.topic, stamp_ns: *stamp_ns }
    }
}

type Items = Vec<Result<TimedFrame, Loss>>;

impl Assembly {
    pub(super) fn new(topics: Vec<String>, told: Told) -> Self {
        Self {
            mount: Mount::new(topics.clone()),
            roles: Roles::new(topics),
            depths: Vec::new(),
            colors: BTreeMap::new(),
            infos: BTreeMap::new(),
            spaces: Spaces::default(),
            told,
            newest_stamp_ns: 0,
            doubtful: BTreeMap::new(),
            losses: Losses::default(),
        }
    }

    /// Takes a message in; gives out the frames it completes.
    pub(super) fn take(&mut self, topic: &str, log_ns: u64, sensed: Sensed) -> Items {
        let mut items = Items::new();
        match sensed {
            Sensed::Image(image) => self.take_image(topic, log_ns, image, &mut items),
            Sensed::Info(info) => {
                self.infos.insert(topic.to_string(), info);
            }
            Sensed::Transforms(all) => self.spaces.insert(topic, &all),
            Sensed::Odometry(pose) => self.mount.odometry(topic, &pose),
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
        let is_depth = match self.roles.of(topic, &image) {
            Role::Depth => true,
            Role::Color => false,
            Role::Double => return,
            Role::Passed(what) => return items.extend(self.losses.note("pictures on other topics", what).map(Err)),
            Role::Doubtful(what) => {
                self.doubtful.insert(topic.to_string(), what);
                return;
            }
        };
        if image.header().stamp_ns == 0 {
            image.restamp(log_ns);
        }
        let stamp_ns = image.header().stamp_ns;
        if stamp_ns + CLOCK_MOVED_NS < self.newest_stamp_ns {
            self.clock_moved(stamp_ns, items);
        }
        self.newest_stamp_ns = self.newest_stamp_ns.max(stamp_ns);
        if is_depth {
            self.depths.push(Waiting { image, topic: topic.to_string(), log_ns });
        } else {
            self.colors.insert(stamp_ns, image);
        }
        let oldest = self.newest_stamp_ns.saturating_sub(MEMORY_NS);
        self.spaces.forget_before(oldest);
        self.mount.forget_before(oldest);
        while self.colors.len() > MCAP_WAITING.count() {
            self.colors.pop_first();
        }
    }

    /// What was sensed by the old clock no longer fits what comes.
    fn clock_moved(&mut self, stamp_ns: u64, items: &mut Items) {
        let back_s = (self.newest_stamp_ns - stamp_ns) as f64 / 1e9;
        self.give_out(u64::MAX, items);
        self.colors.clear();
        self.spaces.forget_moving();
        self.mount.forget_moving();
        self.newest_stamp_ns = 0;
        let what = format!("the clock moved back by {back_s:.1} s; poses from before that are not used after it");
        items.extend(self.losses.note("moves of the clock", what).map(Err));
    }

    /// Gives out the frames that are complete, or have waited long enough at `now_ns` of the log's clock.
    fn give_out(&mut self, now_ns: u64, items: &mut Items) {
        while let Some(first) = self.depths.first() {
            let waited = now_ns.saturating_sub(first.log_ns) > PATIENCE_NS || self.depths.len() > MCAP_WAITING.count();
            if !waited && !self.is_complete(first) {
                return;
            }
            let first = self.depths.remove(0);
            match self.assemble(&first, items) {
                Ok(frame) => items.push(Ok(frame)),
                Err((kind, what)) => items.extend(self.losses.note(kind, what).map(Err)),
            }
        }
    }

    /// Whether nothing that may still come would make the frame better.
    fn is_complete(&self, waiting: &Waiting) -> bool {
        let (taken, header) = (waiting.taken(), waiting.image.header());
        let colored = self.colors.range(header.stamp_ns..).next().is_some();
        let settled = || {
            let trees = self.spaces.of(taken.topic).ok();
            trees.is_some_and(|trees| {
                trees.is_settled(taken.camera, taken.stamp_ns) || self.mount.is_settled(&trees, taken)
            })
        };
        colored && self.camera_of(taken).is_some() && settled()
    }

    /// The description of the camera that took a picture: of its frame, on the topic that has most in common with its
    /// own; or the only one there is.
    fn camera_of(&self, taken: Taken) -> Option<&Info> {
        let only = || self.infos.values().next().filter(|_| self.infos.len() == 1);
        let own = self.infos.iter().filter(|(_, info)| info.header.frame == taken.camera);
        own.max_by_key(|(topic, _)| kinship(folder(topic), taken.topic)).map(|(_, info)| info).or_else(only)
    }

    fn assemble(&mut self, waiting: &Waiting, items: &mut Items) -> Result<TimedFrame, (&'static str, String)> {
        let (taken, header) = (waiting.taken(), waiting.image.header());
        let at = format!("the depth picture of {:.3} s", header.stamp_ns as f64 / 1e9);
        let skipped = |kind, what: String| (kind, format!("{at} is skipped: {what}"));
        let depth = pictures::depth(&waiting.image).map_err(|what| skipped("undecodable pictures", what))?;
        let intrinsics = self.intrinsics(taken, &depth).map_err(|what| skipped("frames without intrinsics", what))?;
        let Picture { width, height, pixels } = depth;
        let depths = Depths { pixels: &pixels, width, intrinsics, unit_m: DEPTH_UNIT_M };
        let trees = self.spaces.of(taken.topic);
        let found =
            trees.map_err(NoPlace::from).and_then(|trees| place(&trees, &self.mount, taken, &depths, self.told));
        let Place { world_from_camera, robot, from, assumed } =
            found.map_err(|why| skipped("frames without a pose", why.to_string()))?;
        items.extend(assumed.and_then(|said| self.losses.note("frames with an assumed camera mount", said)).map(Err));
        let color = self.color_for(header, width, height, items);
        let frame = RgbdFrame {
            width,
            height,
            color,
            depth: pixels,
            depth_unit_m: DEPTH_UNIT_M,
            intrinsics,
            world_from_camera,
        };
        let robot = robot.map(|at| Pose::new(at.translation.x, at.translation.y, at.rotation.euler_angles().2));
        Ok(TimedFrame { stamp_ns: header.stamp_ns, log_ns: waiting.log_ns, robot, frame, pose_from: from })
    }

    fn intrinsics(&self, taken: Taken, depth: &Picture<u16>) -> Result<Intrinsics, String> {
        let info = self.camera_of(taken);
        let known = info.map_or(Ok(None), |info| intrinsics_for(info, depth.width, depth.height))?;
        let none = "no camera info with its focal lengths (sensor_msgs/CameraInfo, foxglove.CameraCalibration)";
        known.ok_or_else(|| format!("{none} for `{}`", taken.camera))
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
}

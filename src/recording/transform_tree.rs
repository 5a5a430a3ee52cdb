//! Frames within frames over time, as tf keeps them.

use std::collections::BTreeMap;

use nalgebra::Isometry3;

use super::sensed::Transform;
use crate::limits::TRANSFORM_CHAIN;

/// Beyond the first and last sample a transform is believed for this long, nanoseconds.
const TOLERANCE_NS: u64 = 200_000_000;
/// A frame leaps when it goes farther than this, metres, and than the fastest robot gets, metres a second: a localisation
/// that finds itself leaps once, two robots under one name forth and back again and again.
const LEAP_M: f64 = 0.5;
const FASTEST_M_S: f64 = 5.0;
/// Leaps within this of each other follow at once, nanoseconds, and so many of them are no localisation's.
const AT_ONCE_NS: u64 = 1_000_000_000;
const MOST_LEAPS: u32 = 4;
/// A camera that is fixed to a robot is not fixed to it elsewhere as well, metres.
const SAME_MOUNT_M: f64 = 0.05;
/// Frames that stand for the world: a chain ends there.
pub(super) const WORLDS: [&str; 2] = ["map", "world"];

/// Where each frame is within its parent, over time.
#[derive(Clone, Debug, Default)]
pub(super) struct TransformTree {
    tracks: BTreeMap<String, Track>,
}

#[derive(Clone, Debug)]
struct Track {
    parent: String,
    fixed: bool,
    samples: BTreeMap<u64, Isometry3<f64>>,
    /// Leaps that followed each other at once, and when the last one was.
    leaps: u32,
    leapt_ns: u64,
}

/// Trees that hold together; where two know a frame, the first counts.
#[derive(Clone, Debug)]
pub(super) struct Trees<'a>(pub(super) Vec<&'a TransformTree>);

/// A frame's place in the outermost frame known.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Placed {
    /// The frames from the one that is placed to the outermost, both among them.
    pub(super) chain: Vec<String>,
    pub(super) root_from_frame: Isometry3<f64>,
}

/// Why a place cannot be told.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Unplaced {
    /// Nothing says where this frame is.
    Unknown(String),
    /// What is known of this frame is another time's; by how much, nanoseconds.
    OtherTime { frame: String, off_ns: u64 },
    /// The transforms end at `root`, and odometry moves another frame.
    OtherBase { root: String, base: String },
    /// This frame is said to be at several places at once.
    Torn(String),
    /// Several robots' transforms, and nothing says whose camera this is.
    OtherRobots(Vec<String>),
}

impl Placed {
    /// The outermost frame.
    pub(super) fn root(&self) -> &str {
        self.chain.last().map_or("", String::as_str)
    }
}

impl TransformTree {
    /// Takes in a transform; `fixed` ones hold for all time.
    pub(super) fn insert(&mut self, transform: &Transform, fixed: bool) {
        let fresh =
            || Track { parent: transform.parent.clone(), fixed, samples: BTreeMap::new(), leaps: 0, leapt_ns: 0 };
        let track = self.tracks.entry(transform.child.clone()).or_insert_with(fresh);
        if track.parent != transform.parent {
            let (leaps, leapt_ns) = (track.leaps, track.leapt_ns);
            *track = Track { leaps, leapt_ns, ..fresh() };
            track.leap(transform.stamp_ns);
        }
        if track.leaps_to(transform) {
            track.leap(transform.stamp_ns);
        }
        track.samples.insert(transform.stamp_ns, transform.parent_from_child);
    }

    /// Forgets what is older than this and no longer needed, so that a long stream stays small.
    pub(super) fn forget_before(&mut self, stamp_ns: u64) {
        for track in self.tracks.values_mut() {
            if let Some((&keep, _)) = track.samples.range(..stamp_ns).next_back()
                && track.samples.len() > 1
            {
                track.samples = track.samples.split_off(&keep);
            }
        }
    }

    /// Forgets all that moves.
    pub(super) fn forget_moving(&mut self) {
        self.tracks.retain(|_, track| track.fixed);
    }

    /// The only frame whose place it tells, and the frame within which it tells it: odometry's.
    pub(super) fn only(&self) -> Option<(&str, &str)> {
        self.tracks.iter().next().map(|(child, track)| (child.as_str(), track.parent.as_str()))
    }

    /// Whether a sample of that time or later has come for a frame.
    pub(super) fn has_since(&self, frame: &str, stamp_ns: u64) -> bool {
        let newest = self.tracks.get(frame).and_then(|track| track.samples.last_key_value());
        newest.is_some_and(|(&stamp, _)| stamp >= stamp_ns)
    }

    /// Where `frame` was at that time, in the outermost frame of this tree.
    pub(super) fn place(&self, frame: &str, stamp_ns: u64) -> Result<Placed, Unplaced> {
        Trees(vec![self]).place(frame, stamp_ns)
    }
}

impl Trees<'_> {
    fn track(&self, frame: &str) -> Option<&Track> {
        self.0.iter().find_map(|tree| tree.tracks.get(frame))
    }

    /// Whether anything is known of a frame.
    pub(super) fn knows(&self, frame: &str) -> bool {
        self.track(frame).is_some()
    }

    /// Whether a frame is said to move within its parent.
    pub(super) fn moves(&self, frame: &str) -> bool {
        self.track(frame).is_some_and(|track| !track.fixed)
    }

    /// Whether nothing can still come that bears on where a frame was at that time.
    pub(super) fn is_settled(&self, frame: &str, stamp_ns: u64) -> bool {
        let mut frame = frame;
        for _ in 0..TRANSFORM_CHAIN.count() {
            let Some(track) = self.track(frame) else { return WORLDS.contains(&frame) };
            let newest = track.samples.last_key_value().map_or(0, |(&stamp, _)| stamp);
            if !track.fixed && newest < stamp_ns {
                return false;
            }
            frame = &track.parent;
        }
        true
    }

    /// Where `frame` was at that time, in the outermost frame known.
    pub(super) fn place(&self, frame: &str, stamp_ns: u64) -> Result<Placed, Unplaced> {
        let (mut at, mut placed) = (frame.to_string(), Isometry3::identity());
        let mut chain = vec![at.clone()];
        while chain.len() <= TRANSFORM_CHAIN.count() && !WORLDS.contains(&at.as_str()) {
            let Some(track) = self.track(&at) else { break };
            if track.is_torn() {
                return Err(Unplaced::Torn(at));
            }
            let parent_from_child =
                track.at(stamp_ns).map_err(|off_ns| Unplaced::OtherTime { frame: at.clone(), off_ns })?;
            placed = parent_from_child * placed;
            at.clone_from(&track.parent);
            chain.push(at.clone());
        }
        if at == frame { Err(Unplaced::Unknown(at)) } else { Ok(Placed { chain, root_from_frame: placed }) }
    }
}

impl Track {
    /// Whether it leaps back to where it leapt from; what is fixed moves not at all.
    fn leaps_to(&self, transform: &Transform) -> bool {
        let mut before = self.samples.range(..=transform.stamp_ns).rev();
        let to = transform.parent_from_child.translation.vector;
        let beyond = |(then, from): (&u64, &Isometry3<f64>)| {
            let passed_s = (transform.stamp_ns - then) as f64 / 1e9;
            let reach_m = if self.fixed { SAME_MOUNT_M } else { LEAP_M + FASTEST_M_S * passed_s };
            (from.translation.vector - to).norm() > reach_m
        };
        let leapt = before.next().is_some_and(beyond);
        leapt && (self.fixed || before.next().is_some_and(|earlier| !beyond(earlier)))
    }

    fn leap(&mut self, stamp_ns: u64) {
        let goes_on = stamp_ns.abs_diff(self.leapt_ns) < AT_ONCE_NS;
        self.leaps = if goes_on || self.fixed { self.leaps + 1 } else { 1 };
        self.leapt_ns = stamp_ns;
    }

    /// Whether several robots say where this frame is.
    fn is_torn(&self) -> bool {
        self.leaps >= if self.fixed { 1 } else { MOST_LEAPS }
    }

    /// Interpolated between the samples about a time; the error is how far the nearest one is off.
    fn at(&self, stamp_ns: u64) -> Result<Isometry3<f64>, u64> {
        let before = self.samples.range(..=stamp_ns).next_back();
        let after = self.samples.range(stamp_ns..).next();
        let alone = self.fixed || self.samples.len() == 1;
        match (before, after) {
            (Some((t, pose)), _) | (None, Some((t, pose))) if *t == stamp_ns || alone => Ok(*pose),
            (Some((t0, a)), Some((t1, b))) => {
                let share = (stamp_ns - t0) as f64 / (t1 - t0) as f64;
                Ok(a.try_lerp_slerp(b, share, 1e-9).unwrap_or(if share < 0.5 { *a } else { *b }))
            }
            (Some((t, pose)), None) | (None, Some((t, pose))) => {
                let off = t.abs_diff(stamp_ns);
                if off <= TOLERANCE_NS { Ok(*pose) } else { Err(off) }
            }
            (None, None) => Err(u64::MAX),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moved(stamp_ns: u64, parent: &str, child: &str, x: f64) -> Transform {
        let parent_from_child = Isometry3::translation(x, 0.0, 0.0);
        Transform { stamp_ns, parent: parent.to_string(), child: child.to_string(), parent_from_child }
    }

    #[test]
    fn a_place_between_two_times_is_interpolated_along_the_chain() {
        let mut tree = TransformTree::default();
        tree.insert(&moved(0, "base_link", "camera", 0.5), true);
        tree.insert(&moved(1_000, "odom", "base_link", 1.0), false);
        tree.insert(&moved(3_000, "odom", "base_link", 2.0), false);
        let placed = tree.place("camera", 2_000).expect("placed");
        assert_eq!((placed.root(), placed.root_from_frame.translation.x), ("odom", 2.0));
    }

    #[test]
    fn a_transform_of_another_time_is_not_believed() {
        let mut tree = TransformTree::default();
        tree.insert(&moved(0, "map", "base_link", 0.0), false);
        tree.insert(&moved(1, "map", "base_link", 0.0), false);
        let error = tree.place("base_link", 9_000_000_000).expect_err("too old");
        assert!(matches!(error, Unplaced::OtherTime { off_ns: 8_999_999_999, .. }), "{error:?}");
    }

    #[test]
    fn a_frame_that_two_robots_move_is_placed_by_neither() {
        let at = |i: u64, x: f64| moved(i * 50_000_000, "odom", "base_link", x);
        let mut tree = TransformTree::default();
        (0..6).for_each(|i| tree.insert(&at(i, if i % 2 == 0 { 0.0 } else { 7.0 }), false));
        assert_eq!(tree.place("base_link", 200_000_000), Err(Unplaced::Torn("base_link".to_string())));
        let mut found_itself = TransformTree::default();
        (0..6).for_each(|i| found_itself.insert(&at(i, if i < 3 { 0.0 } else { 7.0 }), false));
        assert!(found_itself.place("base_link", 250_000_000).is_ok(), "one leap is a localisation's");
        let mut mounts = TransformTree::default();
        [0.1, 0.4].iter().enumerate().for_each(|(i, x)| mounts.insert(&moved(i as u64, "base", "camera", *x), true));
        assert!(matches!(mounts.place("camera", 0), Err(Unplaced::Torn(_))));
    }

    #[test]
    fn a_loop_of_frames_ends() {
        let mut tree = TransformTree::default();
        tree.insert(&moved(0, "a", "b", 1.0), true);
        tree.insert(&moved(0, "b", "a", 1.0), true);
        assert!(tree.place("a", 0).is_err() || tree.place("b", 0).is_ok());
    }
}

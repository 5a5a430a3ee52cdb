//! What a frame truly shows of each item.

use std::f64::consts::PI;

use serde::Serialize;

use super::room::{FurnishedRoom, Placed};
use crate::catalogue::Orientation;
use crate::frame::RgbdFrame;
use crate::geometry::{Pose, wrap_angle};
use crate::simulation::camera::{Faces, Kinect};

/// An item of a training frame; lengths in metres, angles in radians.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TrueItem {
    /// The mask holds this + 1.
    pub id: usize,
    /// Its category.
    pub category: String,
    /// Middle of its bounding box.
    pub x: f64,
    /// Middle of its bounding box.
    pub y: f64,
    /// Bottom of its bounding box.
    pub z: f64,
    /// Heading of its front.
    pub yaw: f64,
    /// Along the front's heading.
    pub length: f64,
    /// Across it.
    pub width: f64,
    /// From bottom to top.
    pub height: f64,
    /// Corners of the bounding rectangle.
    pub footprint: [[f64; 2]; 4],
    /// What of its orientation can be told.
    pub orientation_kind: Orientation,
    /// Direction of the short edge of what has no front, modulo π.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub short_edge_yaw_mod_pi: Option<f64>,
    /// The item it stands on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on_item: Option<usize>,
    /// Whether it is a small thing a person might ask for.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub target: bool,
    /// Pixels it shows.
    pub visible_px: usize,
    /// Pixels it would show if nothing stood before it.
    pub unoccluded_px: usize,
    /// Of the visible, those with depth.
    pub depth_px: usize,
    /// Leftmost column, topmost row, rightmost column, lowest row of its pixels.
    pub bbox: [usize; 4],
    /// Whether it runs out of the picture.
    pub truncated: bool,
    /// From the robot to its middle.
    pub range: f64,
}

/// Pixels of one item in a frame.
#[derive(Clone, Copy)]
struct Seen {
    visible: usize,
    depth: usize,
    bbox: [usize; 4],
}

/// The items of which a pixel shows.
pub(super) fn items(
    room: &FurnishedRoom,
    kinect: &Kinect,
    faces: &Faces,
    pose: Pose,
    (rgbd, ids): (&RgbdFrame, &[u16]),
) -> Vec<TrueItem> {
    let seen = count(room.placed.len(), rgbd, ids);
    let shown = room.placed.iter().zip(&seen).enumerate().filter(|(_, (_, seen))| seen.visible > 0);
    shown
        .map(|(id, (placed, seen))| {
            let alone = kinect.pixels_alone(faces, id as u16 + 1, pose);
            describe(id, placed, *seen, alone, pose, rgbd)
        })
        .collect()
}

fn count(items: usize, rgbd: &RgbdFrame, ids: &[u16]) -> Vec<Seen> {
    let mut seen = vec![Seen { visible: 0, depth: 0, bbox: [usize::MAX, usize::MAX, 0, 0] }; items];
    for (pixel, (&id, &depth)) in ids.iter().zip(&rgbd.depth).enumerate() {
        let Some(item) = usize::from(id).checked_sub(1).and_then(|i| seen.get_mut(i)) else { continue };
        let (column, row) = (pixel % rgbd.width, pixel / rgbd.width);
        item.visible += 1;
        item.depth += usize::from(depth > 0);
        let [left, top, right, low] = item.bbox;
        item.bbox = [left.min(column), top.min(row), right.max(column), low.max(row)];
    }
    seen
}

fn describe(id: usize, placed: &Placed, seen: Seen, alone: usize, from: Pose, rgbd: &RgbdFrame) -> TrueItem {
    let size = placed.piece.size;
    let yaw = wrap_angle(placed.pose.heading);
    let short = if size.length <= size.width { yaw } else { yaw + PI / 2.0 };
    let [left, top, right, low] = seen.bbox;
    let outline = placed.footprint();
    let corner = |i: usize| outline.corners().get(i).map_or([0.0; 2], |c| [c.x, c.y]);
    TrueItem {
        id,
        category: placed.piece.category.to_string(),
        x: placed.pose.x,
        y: placed.pose.y,
        z: placed.lift,
        yaw,
        length: size.length,
        width: size.width,
        height: size.height,
        footprint: [corner(0), corner(1), corner(2), corner(3)],
        orientation_kind: placed.piece.orientation,
        short_edge_yaw_mod_pi: (placed.piece.orientation == Orientation::ShortEdge).then(|| short.rem_euclid(PI)),
        on_item: placed.on,
        target: placed.target,
        visible_px: seen.visible,
        unoccluded_px: alone,
        depth_px: seen.depth,
        bbox: seen.bbox,
        truncated: left == 0 || top == 0 || right + 1 == rgbd.width || low + 1 == rgbd.height,
        range: from.distance_to(placed.pose.position()),
    }
}

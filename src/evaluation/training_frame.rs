//! Training frames as files, in the format `perceive` reads.

use std::path::Path;

use serde::Serialize;

use crate::files::{FileError, write_file};
use crate::frame::grey_png;
use crate::geometry::Pose;
use crate::world::training::{TrueItem, frame};

/// One line of `index.jsonl`.
#[derive(Serialize)]
struct Line {
    frame: String,
    rgb: String,
    depth: String,
    mask: String,
    width: usize,
    height: usize,
    fx: f64,
    fy: f64,
    cx: f64,
    cy: f64,
    depth_unit_m: f64,
    #[serde(rename = "T_world_cam")]
    world_from_camera: [[f64; 4]; 4],
    robot_pose: Pose,
    items: Vec<TrueItem>,
}

/// Writes colour, depth and mask of frame `number` under `seed` into `folder`; answers its line of `index.jsonl`.
pub fn write_training_frame(folder: &Path, seed: u64, number: u64, force: bool) -> Result<String, FileError> {
    let made = frame(seed, number);
    let rgbd = &made.rgbd;
    let name = format!("{seed}-{number:05}");
    let file = |what: &str| format!("{name}_{what}.png");
    let line = Line {
        rgb: file("rgb"),
        depth: file("depth"),
        mask: file("mask"),
        frame: name,
        width: rgbd.width,
        height: rgbd.height,
        fx: rgbd.intrinsics.fx,
        fy: rgbd.intrinsics.fy,
        cx: rgbd.intrinsics.cx,
        cy: rgbd.intrinsics.cy,
        depth_unit_m: rgbd.depth_unit_m,
        world_from_camera: rgbd.world_from_camera,
        robot_pose: made.pose,
        items: made.items,
    };
    write_file(&folder.join(&line.rgb), &rgbd.color_png(), force)?;
    write_file(&folder.join(&line.depth), &rgbd.depth_png(), force)?;
    write_file(&folder.join(&line.mask), &grey_png(rgbd.width, rgbd.height, &made.ids), force)?;
    // Numbers and names: it cannot fail.
    Ok(serde_json::to_string(&line).unwrap_or_default())
}

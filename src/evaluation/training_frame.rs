//! Training frames as files, in the format `perceive` reads.

use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::files::{FileError, write_file};
use crate::frame::grey_png;
use crate::geometry::Pose;
use crate::perception::FrameFiles;
use crate::simulation::training::{TrueItem, frame};

/// One line of `index.jsonl`.
#[derive(Serialize)]
struct Line {
    #[serde(flatten)]
    files: FrameFiles,
    robot_pose: Pose,
    items: Vec<TrueItem>,
}

/// Writes colour, depth and mask of frame `number` under `seed` into `folder`; answers its line of `index.jsonl`.
///
/// # Errors
/// When a file cannot be written.
pub fn write_training_frame(folder: &Path, seed: u64, number: u64, force: bool) -> Result<String, FileError> {
    let made = frame(seed, number);
    let rgbd = &made.rgbd;
    let name = format!("{seed}-{number:05}");
    let [rgb, depth, mask] = ["rgb", "depth", "mask"].map(|what| PathBuf::from(format!("{name}_{what}.png")));
    write_file(&folder.join(&rgb), &rgbd.color_png(), force)?;
    write_file(&folder.join(&depth), &rgbd.depth_png(), force)?;
    write_file(&folder.join(&mask), &grey_png(rgbd.width, rgbd.height, &made.ids), force)?;
    let files = FrameFiles { frame: Some(name), mask: Some(mask), ..FrameFiles::of(rgbd, rgb, depth) };
    let line = Line { files, robot_pose: made.pose, items: made.items };
    // Numbers and names: it cannot fail.
    Ok(serde_json::to_string(&line).unwrap_or_default())
}

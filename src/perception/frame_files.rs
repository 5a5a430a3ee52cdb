//! A frame as a record names it: picture files, intrinsics, and where the camera stood.

use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::frame_error::FrameError;
use super::picture_files::PictureFile;
use super::upright::{CAMERA_HEIGHTS_M, CAMERA_TILTS_DEG, Depths, NoPose, Told, camera_over_floor};
use crate::frame::{Intrinsics, RgbdFrame, steady};
use crate::record::PoseSource;

/// A frame whose pictures lie in files: the line that `perceive` reads, that it hands to a detector of one's own, and
/// that training frames are written as.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct FrameFiles {
    /// What it is called.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame: Option<String>,
    /// Colour picture, PNG or JPEG, registered to the depth; without it colour tells nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rgb: Option<PathBuf>,
    /// Depth picture, 16-bit grey PNG.
    pub depth: PathBuf,
    /// Whose pixels they truly are, where that is known: item id + 1, grey PNG.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mask: Option<PathBuf>,
    /// Pixels across, checked against the pictures.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width: Option<usize>,
    /// Pixels down, checked against the pictures.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height: Option<usize>,
    /// Focal length across, pixels.
    pub fx: f64,
    /// Focal length down, pixels.
    pub fy: f64,
    /// Principal point, column.
    pub cx: f64,
    /// Principal point, row.
    pub cy: f64,
    /// Metres per unit of depth.
    pub depth_unit_m: f64,
    /// Camera optical frame (x right, y down, z ahead) to world (z up), 4 × 4 by rows; without it the floor in the
    /// picture tells height and tilt, and the camera stands at the origin.
    #[serde(rename = "T_world_cam", default, skip_serializing_if = "Option::is_none")]
    pub world_from_camera: Option<[[f64; 4]; 4]>,
    /// How high above the floor the camera was, where that is known and `T_world_cam` is not, metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera_height: Option<f64>,
    /// How far down it looked, where that is known and `T_world_cam` is not, degrees.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera_tilt: Option<f64>,
}

impl FrameFiles {
    /// The line for a frame whose pictures are to lie in these files.
    pub fn of(frame: &RgbdFrame, rgb: PathBuf, depth: PathBuf) -> Self {
        let Intrinsics { fx, fy, cx, cy } = frame.intrinsics;
        Self {
            frame: None,
            rgb: Some(rgb),
            depth,
            mask: None,
            width: Some(frame.width),
            height: Some(frame.height),
            fx,
            fy,
            cx,
            cy,
            depth_unit_m: frame.depth_unit_m,
            world_from_camera: Some(frame.world_from_camera),
            camera_height: None,
            camera_tilt: None,
        }
    }

    /// Reads the pictures and checks that they fit each other; relative paths are taken from `folder`. What the line does
    /// not tell of the camera, `told` may.
    ///
    /// # Errors
    /// When a picture cannot be read or does not fit, or nothing tells where the camera was.
    pub fn load(&self, folder: &Path, told: Told) -> Result<(RgbdFrame, PoseSource), FrameError> {
        let depth = PictureFile::open(folder.join(&self.depth))?;
        let (width, height) = depth.size;
        depth.require_size("the record says", (self.width.unwrap_or(width), self.height.unwrap_or(height)))?;
        let mut color = Vec::new();
        if let Some(rgb) = &self.rgb {
            let file = PictureFile::open(folder.join(rgb))?;
            file.require_size("the depth", (width, height))?;
            color = file.color()?;
        }
        let depth = depth.depth()?;
        let (depth_unit_m, intrinsics) =
            (self.depth_unit_m, Intrinsics { fx: self.fx, fy: self.fy, cx: self.cx, cy: self.cy });
        let told = self.told(told)?;
        let depths = Depths { pixels: &depth, width, intrinsics, unit_m: depth_unit_m };
        let over_floor = || camera_over_floor(&depths, told).map_err(no_pose);
        let given = self.world_from_camera.map(|pose| (pose, PoseSource::Record));
        let (pose, source) = given.map_or_else(over_floor, Ok)?;
        let frame =
            RgbdFrame { width, height, color, depth, depth_unit_m, intrinsics, world_from_camera: steady(pose) };
        Ok((frame, source))
    }

    fn told(&self, otherwise: Told) -> Result<Told, FrameError> {
        let within = |name: &str, value: Option<f64>, range: RangeInclusive<f64>, unit: &str| match value {
            Some(value) if !range.contains(&value) => {
                let (low, high) = range.into_inner();
                Err(FrameError::Wrong(format!("`{name}` {value} must be from {low} to {high} {unit}")))
            }
            value => Ok(value),
        };
        let height_m = within("camera_height", self.camera_height, CAMERA_HEIGHTS_M, "metres")?;
        let tilt_deg = within("camera_tilt", self.camera_tilt, CAMERA_TILTS_DEG, "degrees down")?;
        Ok(Told { height_m: height_m.or(otherwise.height_m), tilt_deg: tilt_deg.or(otherwise.tilt_deg) })
    }
}

fn no_pose(why: NoPose) -> FrameError {
    let need = if why == NoPose::Nothing { "height and tilt" } else { "height" };
    FrameError::Wrong(format!(
        "no `T_world_cam`, and {why}; give the camera's {need} (--camera-height METRES, --camera-tilt DEGREES, or \
         `camera_height` and `camera_tilt` in the line)"
    ))
}

/// Checks the numbers of a frame from any source.
///
/// A wrong scale would make everything one plane, and a pose that is none
/// would put furniture into the walls.
///
/// # Errors
/// Which number is wrong, and what it should be.
pub fn check(frame: &RgbdFrame) -> Result<(), FrameError> {
    let wrong = |what: String| Err(FrameError::Wrong(what));
    if !(1e-5..=1.0).contains(&frame.depth_unit_m) {
        return wrong("`depth_unit_m` must be metres per unit, 0.001 for millimetres".to_string());
    }
    let Intrinsics { fx, fy, cx, cy } = frame.intrinsics;
    let focal = |f: f64, pixels: usize| (0.2 * pixels as f64..20.0 * pixels as f64).contains(&f);
    if !(focal(fx, frame.width) && focal(fy, frame.height)) {
        return wrong(format!("`fx` {fx} and `fy` {fy} must be focal lengths in pixels; a Kinect's are about 525"));
    }
    if !((0.0..frame.width as f64).contains(&cx) && (0.0..frame.height as f64).contains(&cy)) {
        return wrong(format!("`cx` {cx} and `cy` {cy} must be the principal point in pixels, near the middle"));
    }
    if frame.depth.len() != frame.width * frame.height
        || !(frame.color.is_empty() || frame.color.len() == frame.depth.len())
    {
        return wrong(format!("the pictures do not hold {} × {} pixels", frame.width, frame.height));
    }
    check_pose(&frame.world_from_camera)?;
    check_scale(frame)
}

fn check_pose(m: &[[f64; 4]; 4]) -> Result<(), FrameError> {
    let wrong = |what: &str| Err(FrameError::Wrong(format!("`T_world_cam` {what}")));
    if !m.iter().flatten().all(|v| v.is_finite()) {
        return wrong("holds something that is not a number");
    }
    let dot = |i: usize, j: usize| (0..3).map(|k| m[i][k] * m[j][k]).sum::<f64>();
    let rotation = (0..3).all(|i| (0..3).all(|j| (dot(i, j) - f64::from(u8::from(i == j))).abs() < 0.02));
    if !rotation || m[3] != [0.0, 0.0, 0.0, 1.0] {
        return wrong("is no rotation and translation, 4 × 4 by rows");
    }
    if !(0.05..5.0).contains(&m[2][3]) {
        return wrong("puts the camera below the floor or far above it; the world's floor is z = 0, in metres");
    }
    Ok(())
}

/// Half of what a room camera sees lies between 0.2 and 15 metres; a depth in wrong units does not.
fn check_scale(frame: &RgbdFrame) -> Result<(), FrameError> {
    let mut seen: Vec<u16> = frame.depth.iter().copied().step_by(97).filter(|depth| *depth > 0).collect();
    if seen.len() < 16 {
        return Ok(());
    }
    let middle = seen.len() / 2;
    let median = f64::from(*seen.select_nth_unstable(middle).1) * frame.depth_unit_m;
    if (0.2..15.0).contains(&median) {
        return Ok(());
    }
    let unit = [0.001, 0.0002, 0.0001, 0.01].into_iter().find(|unit| {
        let m = median / frame.depth_unit_m * unit;
        (0.5..6.0).contains(&m)
    });
    let guess = unit.map_or(String::new(), |unit| format!("; perhaps `depth_unit_m` is {unit}"));
    Err(FrameError::Wrong(format!("half of the depths are below {median:.4} m, which no room is{guess}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(depth: u16, depth_unit_m: f64) -> RgbdFrame {
        RgbdFrame {
            width: 64,
            height: 48,
            color: Vec::new(),
            depth: vec![depth; 64 * 48],
            depth_unit_m,
            intrinsics: Intrinsics { fx: 52.5, fy: 52.5, cx: 31.5, cy: 23.5 },
            world_from_camera: [
                [0.0, 0.0, 1.0, 0.0],
                [-1.0, 0.0, 0.0, 0.0],
                [0.0, -1.0, 0.0, 1.2],
                [0.0, 0.0, 0.0, 1.0],
            ],
        }
    }

    #[test]
    fn a_wrong_unit_of_depth_is_refused_with_the_likely_one() {
        assert!(check(&frame(2500, 0.001)).is_ok());
        let error = check(&frame(2500, 1.0)).expect_err("2500 m");
        assert!(error.to_string().contains("perhaps `depth_unit_m` is 0.001"), "{error}");
    }

    #[test]
    fn focal_lengths_in_metres_and_a_turned_matrix_are_refused() {
        let mut focal = frame(2500, 0.001);
        focal.intrinsics.fx = 0.525;
        assert!(check(&focal).expect_err("too short").to_string().contains("focal lengths in pixels"));
        let mut pose = frame(2500, 0.001);
        pose.world_from_camera[3] = [1.0, 2.0, 3.0, 1.0];
        assert!(check(&pose).expect_err("by columns").to_string().contains("4 × 4 by rows"));
    }
}

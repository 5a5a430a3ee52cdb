//! One RGB-D frame: what a Kinect gives, real, recorded or simulated.
//!
//! The type that cameras, recordings and perception share; nothing here knows
//! where a frame comes from or what is in it.

mod camera;
mod decode;
mod mount;
mod placing;
mod png;
mod projection;

pub use camera::Camera;
pub use decode::{Picture, decode_color, decode_depth, picture_size};
pub use mount::CameraMount;
pub use placing::{inverse, placed};
pub use png::{grey_png, rgb_png};

/// Focal lengths and principal point of a pinhole camera, pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intrinsics {
    /// Focal length across.
    pub fx: f64,
    /// Focal length down.
    pub fy: f64,
    /// Principal point, column.
    pub cx: f64,
    /// Principal point, row.
    pub cy: f64,
}

/// Colour and depth, registered pixel by pixel, row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct RgbdFrame {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Red, green, blue; empty when there is no colour picture.
    pub color: Vec<[u8; 3]>,
    /// Depth along the optical axis in units of [`RgbdFrame::depth_unit_m`]; 0 where nothing came back.
    pub depth: Vec<u16>,
    /// Metres per unit of depth: 0.001 for millimetres.
    pub depth_unit_m: f64,
    /// The camera.
    pub intrinsics: Intrinsics,
    /// Camera optical frame (x right, y down, z ahead) to world (z up, floor at 0), 4 × 4 by rows, metres.
    pub world_from_camera: [[f64; 4]; 4],
}

/// A camera's pose rounded to a nanometre and a billionth of a turn.
///
/// Far below anything a sensor tells; a pose that came as a matrix and one
/// that came as a quaternion are then the same, and so is what is seen from them.
pub fn steady(pose: [[f64; 4]; 4]) -> [[f64; 4]; 4] {
    // Adding zero makes −0 into 0.
    pose.map(|row| row.map(|value| (value * 1e9).round() / 1e9 + 0.0))
}

//! One RGB-D frame: files, intrinsics, and where the camera stood.

use std::path::{Path, PathBuf};

use serde::Deserialize;

/// A frame as a record names it.
#[derive(Clone, Debug, Deserialize)]
pub struct FrameFiles {
    /// Depth picture, 16-bit grey PNG.
    pub depth: PathBuf,
    /// Focal lengths and principal point, pixels.
    pub fx: f64,
    /// Focal length down, pixels.
    pub fy: f64,
    /// Principal point, pixels.
    pub cx: f64,
    /// Principal point, pixels.
    pub cy: f64,
    /// Metres per unit of depth.
    pub depth_unit_m: f64,
    /// Camera optical frame (x right, y down, z ahead) to world (z up), 4 × 4 by rows.
    #[serde(rename = "T_world_cam")]
    pub world_from_camera: [[f64; 4]; 4],
}

/// Depth in units of the file, row by row; zero where nothing came back.
#[derive(Clone, Debug)]
pub struct DepthPicture {
    /// Pixels.
    pub width: usize,
    /// Pixels.
    pub height: usize,
    /// Depth along the optical axis.
    pub values: Vec<u16>,
}

/// Why a frame cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum FrameError {
    /// The file cannot be read.
    #[error("{0}: {1}")]
    Unreadable(String, String),
    /// The file is no depth picture.
    #[error("{0}: not a 16-bit grey PNG; depth must keep its millimetres")]
    NotDepth(String),
    /// The numbers cannot be.
    #[error("{0}")]
    Wrong(&'static str),
}

impl FrameFiles {
    /// Checks the numbers: a wrong scale would make everything one plane.
    pub fn check(&self) -> Result<(), FrameError> {
        if !(1e-5..=1.0).contains(&self.depth_unit_m) {
            return Err(FrameError::Wrong("`depth_unit_m` must be metres per unit, 0.001 for millimetres"));
        }
        if !(self.fx > 1.0 && self.fy > 1.0) {
            return Err(FrameError::Wrong("`fx` and `fy` must be focal lengths in pixels"));
        }
        let numbers = self.world_from_camera.iter().flatten().all(|v| v.is_finite());
        if numbers { Ok(()) } else { Err(FrameError::Wrong("`T_world_cam` holds something that is not a number")) }
    }

    /// Loads the depth picture; relative paths are taken from `folder`.
    pub fn load_depth(&self, folder: &Path) -> Result<DepthPicture, FrameError> {
        let path = folder.join(&self.depth);
        let name = path.display().to_string();
        let bytes = std::fs::read(&path).map_err(|e| FrameError::Unreadable(name.clone(), e.to_string()))?;
        let unreadable = |e: png::DecodingError| FrameError::Unreadable(name.clone(), e.to_string());
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().map_err(unreadable)?;
        let size = reader.output_buffer_size().ok_or(FrameError::NotDepth(name.clone()))?;
        let mut buffer = vec![0; size];
        let info = reader.next_frame(&mut buffer).map_err(unreadable)?;
        if info.color_type != png::ColorType::Grayscale || info.bit_depth != png::BitDepth::Sixteen {
            return Err(FrameError::NotDepth(name));
        }
        let values = buffer.chunks_exact(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect();
        Ok(DepthPicture { width: info.width as usize, height: info.height as usize, values })
    }
}

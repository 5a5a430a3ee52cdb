//! Pictures from files: depth as 16-bit PNG, colour as PNG or JPEG.

use std::path::Path;

use super::frame_error::FrameError;
use crate::frame::{Picture, decode_color, decode_depth};

/// Pixels across and down, and the pixels row by row.
type Sized<T> = (usize, usize, Vec<T>);

/// Reads a depth picture, in units of the file.
pub fn load_depth(path: &Path) -> Result<Sized<u16>, FrameError> {
    load(path, decode_depth)
}

/// Reads a colour picture.
pub fn load_color(path: &Path) -> Result<Sized<[u8; 3]>, FrameError> {
    load(path, decode_color)
}

fn load<T>(path: &Path, decode: fn(&[u8]) -> Result<Picture<T>, String>) -> Result<Sized<T>, FrameError> {
    let unreadable = |what: String| FrameError::Unreadable(path.display().to_string(), what);
    let bytes = std::fs::read(path).map_err(|error| unreadable(error.to_string()))?;
    let picture = decode(&bytes).map_err(unreadable)?;
    Ok((picture.width, picture.height, picture.pixels))
}

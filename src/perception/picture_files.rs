//! Pictures from files: depth as 16-bit PNG, colour as PNG or JPEG.

use std::path::PathBuf;

use super::frame_error::FrameError;
use crate::frame::{Picture, decode_color, decode_depth, picture_size};
use crate::limits::PICTURE_FILE_BYTES;

/// A picture's file, whose head tells its size before memory is taken for its pixels.
pub(super) struct PictureFile {
    path: PathBuf,
    bytes: Vec<u8>,
    /// Pixels across and down.
    pub size: (usize, usize),
}

impl PictureFile {
    /// Reads the file and the picture's head.
    ///
    /// # Errors
    /// When the file cannot be read or is no picture of a known kind.
    pub fn open(path: PathBuf) -> Result<Self, FrameError> {
        let unreadable = |what: String| FrameError::Unreadable(path.display().to_string(), what);
        let bytes = PICTURE_FILE_BYTES.read(&path).map_err(|error| unreadable(error.to_string()))?;
        let size = picture_size(&bytes).map_err(unreadable)?;
        Ok(Self { path, bytes, size })
    }

    /// Requires the size that something `other` has.
    ///
    /// # Errors
    /// When the sizes differ.
    pub fn require_size(&self, other: &'static str, size: (usize, usize)) -> Result<(), FrameError> {
        if self.size == size {
            return Ok(());
        }
        let (width, height) = self.size;
        Err(FrameError::Sizes(self.path.display().to_string(), width, height, other, size.0, size.1))
    }

    /// The depth, in units of the file, row by row.
    ///
    /// # Errors
    /// When the picture is damaged, or holds no depth.
    pub fn depth(&self) -> Result<Vec<u16>, FrameError> {
        self.pixels(decode_depth)
    }

    /// The colours, row by row.
    ///
    /// # Errors
    /// When the picture is damaged, or holds no colours.
    pub fn color(&self) -> Result<Vec<[u8; 3]>, FrameError> {
        self.pixels(decode_color)
    }

    fn pixels<T>(&self, decode: fn(&[u8]) -> Result<Picture<T>, String>) -> Result<Vec<T>, FrameError> {
        let unreadable = |what: String| FrameError::Unreadable(self.path.display().to_string(), what);
        Ok(decode(&self.bytes).map_err(unreadable)?.pixels)
    }
}

//! Why a frame cannot be used.

/// Why a frame cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum FrameError {
    /// The file cannot be read.
    #[error("{0}: {1}")]
    Unreadable(String, String),
    /// The pictures and the record do not belong together.
    #[error("{0} is {1} × {2} pixels, {3} {4} × {5}; depth must be registered to the colour picture")]
    Sizes(String, usize, usize, &'static str, usize, usize),
    /// The numbers cannot be.
    #[error("{0}")]
    Wrong(String),
}

//! What can go wrong with a log: what ends the reading, and what is only lost.

use std::fmt;

/// Why a log cannot be read or written at all.
#[derive(Debug, thiserror::Error)]
pub enum LogError {
    /// The system says no.
    #[error("{0}: {1}")]
    System(String, std::io::Error),
    /// Something else than an MCAP log.
    #[error("{0}: not an MCAP log: it does not begin with the MCAP magic bytes; convert a bag with `mcap convert`")]
    NotMcap(String),
    /// A file that is there already.
    #[error("{0} exists; name another file or give --force")]
    Exists(String),
    /// What should be written cannot be.
    #[error("the log cannot be written: {0}")]
    Unwritable(String),
}

impl From<mcap::McapError> for LogError {
    fn from(error: mcap::McapError) -> Self {
        match error {
            mcap::McapError::Io(error) => Self::System("the log".to_string(), error),
            error => Self::Unwritable(error.to_string()),
        }
    }
}

impl LogError {
    /// The same error of the file with this name.
    pub(super) fn named(self, name: &str) -> Self {
        match self {
            Self::System(_, error) if error.kind() == std::io::ErrorKind::StorageFull => {
                let what = "the disk is full; free space and run again";
                Self::System(name.to_string(), std::io::Error::new(error.kind(), what))
            }
            Self::System(_, error) => Self::System(name.to_string(), error),
            other => other,
        }
    }
}

/// Something of a log that was lost or skipped while the rest was read; says what and what mends it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Loss(pub String);

impl Loss {
    pub(super) fn at(byte: u64, what: impl fmt::Display) -> Self {
        Self(format!("byte {byte}: {what}"))
    }
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.0)
    }
}

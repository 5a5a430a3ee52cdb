//! Exit codes, in one place.

use std::io;
use std::process::ExitCode;

use crate::files::FileError;

/// How a run ended that was not cut short.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// Everything asked for was done.
    Done,
    /// Finished, but something was lost or skipped on the way.
    Lost,
}

/// Why a run was cut short.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// The work failed.
    #[error("{0}")]
    Failed(String),
    /// The call was wrong.
    #[error("{0}")]
    Usage(String),
    /// Whoever read the output has gone: no reason to complain.
    #[error("the reader of the output has gone")]
    BrokenPipe,
}

impl Failure {
    /// The failure behind a write to `target` that went wrong.
    pub fn writing(target: &str, error: &io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Self::BrokenPipe,
            io::ErrorKind::StorageFull => Self::Failed(format!("{target}: the disk is full; free space and run again")),
            _ => Self::Failed(format!("{target}: {error}")),
        }
    }
}

impl From<FileError> for Failure {
    fn from(error: FileError) -> Self {
        match error {
            FileError::Exists(_) | FileError::Twice(..) => Self::Usage(error.to_string()),
            FileError::System(name, error) => Self::writing(&name, &error),
        }
    }
}

/// The exit code of an interrupted run.
pub const INTERRUPTED: u8 = 130;

/// 0 done, 1 failed, 2 usage, 3 finished but something was lost.
pub fn code(result: &Result<Exit, Failure>) -> ExitCode {
    ExitCode::from(match result {
        Ok(Exit::Done) | Err(Failure::BrokenPipe) => 0,
        Err(Failure::Failed(_)) => 1,
        Err(Failure::Usage(_)) => 2,
        Ok(Exit::Lost) => 3,
    })
}

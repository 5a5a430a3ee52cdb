//! Files that appear whole or not at all, with errors that name them.

use std::io::{self, Write};
use std::path::Path;
use std::sync::{PoisonError, RwLock};

use tempfile::NamedTempFile;

/// Why a file was not written.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// It is there already.
    #[error("{0} exists; name another file or give --force")]
    Exists(String),
    /// The system says no.
    #[error("{0}: {1}")]
    System(String, io::Error),
}

impl FileError {
    fn of(path: &Path, error: io::Error) -> Self {
        let name = path.display().to_string();
        if error.kind() == io::ErrorKind::AlreadyExists { Self::Exists(name) } else { Self::System(name, error) }
    }
}

/// Says before work that takes long what [`write_file`] would say after it.
///
/// # Errors
/// When the file exists and `force` is not set.
pub fn refuse_existing(path: &Path, force: bool) -> Result<(), FileError> {
    if path.is_file() && !force { Err(FileError::Exists(path.display().to_string())) } else { Ok(()) }
}

/// Held by every file being written, so that a process that is told to end leaves no temporary ones.
static WRITING: RwLock<()> = RwLock::new(());

/// Waits for the files being written and lets no other begin: for a process about to exit.
pub fn end_writing() {
    std::mem::forget(WRITING.write().unwrap_or_else(PoisonError::into_inner));
}

/// Writes a file by a temporary one and a rename; refuses to overwrite without `force`.
///
/// # Errors
/// When the file exists and `force` is not set, or it cannot be written.
pub fn write_file(path: &Path, bytes: &[u8], force: bool) -> Result<(), FileError> {
    let _writing = WRITING.read().unwrap_or_else(PoisonError::into_inner);
    let mut temporary = temporary_beside(path)?;
    temporary.write_all(bytes).map_err(|error| FileError::of(path, error))?;
    persist(temporary, path, force)
}

/// A temporary file in the folder of `path`, where it can be renamed from.
///
/// # Errors
/// When the folder cannot be written to.
pub fn temporary_beside(path: &Path) -> Result<NamedTempFile, FileError> {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    NamedTempFile::new_in(folder).map_err(|error| FileError::of(path, error))
}

/// Renames a temporary file onto `path`, with the permissions a new file would have.
///
/// # Errors
/// When the file cannot be put there.
pub fn persist(temporary: NamedTempFile, path: &Path, force: bool) -> Result<(), FileError> {
    widen_permissions(&temporary).map_err(|error| FileError::of(path, error))?;
    let renamed = if force { temporary.persist(path) } else { temporary.persist_noclobber(path) };
    renamed.map(|_| ()).map_err(|error| FileError::of(path, error.error))
}

/// Temporary files are private; an output file should be readable as any other.
#[cfg(unix)]
fn widen_permissions(file: &NamedTempFile) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.as_file().set_permissions(std::fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn widen_permissions(_file: &NamedTempFile) -> io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_exists_is_overwritten_only_by_force() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("out");
        write_file(&path, b"one", false).expect("written");
        assert!(matches!(write_file(&path, b"two", false), Err(FileError::Exists(_))));
        assert_eq!(std::fs::read(&path).expect("readable"), b"one");
        write_file(&path, b"two", true).expect("written");
        assert_eq!(std::fs::read(&path).expect("readable"), b"two");
    }
}

//! Files that appear whole or not at all, with errors that name them.

use std::collections::BTreeMap;
use std::fs::Permissions;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError, RwLock};

use tempfile::NamedTempFile;

/// Why a file was not written.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// It is there already.
    #[error("{0} exists; name another file or give --force")]
    Exists(String),
    /// Another record of the same run has it.
    #[error(
        "{0} holds what belongs to record {1:?} of this run; give records ids that differ, and put {{id}} into the name"
    )]
    Twice(String, String),
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

/// Says before anything moves whether [`write_file`] could write there: nothing is in the way, and the folder takes files.
///
/// # Errors
/// When the file exists and `force` is not set, or its folder cannot be written to.
pub fn refuse_unwritable(path: &Path, force: bool) -> Result<(), FileError> {
    refuse_existing(path, force)?;
    if path.is_dir() {
        return Err(FileError::System(path.display().to_string(), io::ErrorKind::IsADirectory.into()));
    }
    if is_special(path) { Ok(()) } else { temporary_beside(path).map(drop) }
}

/// A pipe or a device, which is written to as it is.
pub fn is_special(path: &Path) -> bool {
    path.metadata().is_ok_and(|found| !found.is_file() && !found.is_dir())
}

/// Which files of this run are whose. `--force` is for files from before, not for the run's own.
#[derive(Clone, Debug, Default)]
pub struct Claims(Arc<Mutex<BTreeMap<PathBuf, String>>>);

impl Claims {
    /// Takes a file for the record `owner`.
    ///
    /// # Errors
    /// When another record has it.
    pub fn claim(&self, path: &Path, owner: &str) -> Result<(), FileError> {
        if is_special(path) {
            return Ok(());
        }
        let whole = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
        let mut claimed = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        match claimed.get(&whole) {
            Some(first) => Err(FileError::Twice(path.display().to_string(), first.clone())),
            None => {
                claimed.insert(whole, owner.to_string());
                Ok(())
            }
        }
    }
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

/// A temporary file in the folder of `path`, where it can be renamed from; as open to others as a new file would be, or
/// as the file is that it replaces.
///
/// # Errors
/// When the folder cannot be written to.
pub fn temporary_beside(path: &Path) -> Result<NamedTempFile, FileError> {
    let path = &target_of(path);
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let mode = path.metadata().map_or(0o666, |found| found.permissions().mode() & 0o666);
        // The system takes the umask off.
        builder.permissions(Permissions::from_mode(mode));
    }
    builder.tempfile_in(folder).map_err(|error| FileError::of(path, error))
}

/// Renames a temporary file onto `path`; what a symbolic link names is replaced, not the link.
///
/// # Errors
/// When the file cannot be put there.
pub fn persist(temporary: NamedTempFile, path: &Path, force: bool) -> Result<(), FileError> {
    let target = target_of(path);
    if let Ok(found) = target.metadata().as_ref().map(std::fs::Metadata::permissions) {
        keep_permissions(&temporary, found).map_err(|error| FileError::of(path, error))?;
    }
    let renamed = if force { temporary.persist(&target) } else { temporary.persist_noclobber(&target) };
    renamed.map(|_| ()).map_err(|error| FileError::of(path, error.error))
}

/// A file that is replaced stays as private or open as it was.
fn keep_permissions(temporary: &NamedTempFile, found: Permissions) -> io::Result<()> {
    temporary.as_file().set_permissions(found)
}

/// What a path leads to: the file a symbolic link names, even one that is not there yet.
fn target_of(path: &Path) -> PathBuf {
    // As many links as Linux follows.
    const LINKS: usize = 40;
    let mut path = path.to_path_buf();
    for _ in 0..LINKS {
        let Ok(next) = std::fs::read_link(&path) else { return path };
        path = path.parent().unwrap_or(Path::new("")).join(next);
    }
    path
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

    #[cfg(unix)]
    #[test]
    fn a_private_file_that_is_replaced_stays_private() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("out");
        write_file(&path, b"one", false).expect("written");
        std::fs::set_permissions(&path, Permissions::from_mode(0o600)).expect("set");
        write_file(&path, b"two", true).expect("written");
        assert_eq!(path.metadata().expect("there").permissions().mode() & 0o777, 0o600);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_a_link_and_what_it_names_is_replaced() {
        let folder = tempfile::tempdir().expect("a folder");
        let [link, file] = ["link", "file"].map(|name| folder.path().join(name));
        std::os::unix::fs::symlink("file", &link).expect("a link");
        write_file(&link, b"one", false).expect("a link to nothing yet");
        write_file(&link, b"two", true).expect("written");
        assert!(link.is_symlink());
        assert_eq!(std::fs::read(&file).expect("readable"), b"two");
    }

    #[test]
    fn two_records_of_a_run_never_have_one_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let claims = Claims::default();
        claims.claim(&folder.path().join("a"), "1").expect("free");
        claims.claim(&folder.path().join("b"), "2").expect("free");
        let error = claims.clone().claim(&folder.path().join("./a"), "3").expect_err("taken").to_string();
        assert!(error.contains("record \"1\" of this run"), "{error}");
    }
}

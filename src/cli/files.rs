//! Whole files in and out, with errors that name them.

use std::io::Write;
use std::path::Path;

use tempfile::NamedTempFile;

use super::{Failure, output};

/// The text of a file.
pub fn read_file(path: &Path) -> Result<String, Failure> {
    std::fs::read_to_string(path).map_err(|e| Failure::Failed(format!("{}: {e}", path.display())))
}

/// Writes a file by a temporary one and a rename; refuses to overwrite without `force`.
pub fn write_file(path: &Path, bytes: &[u8], force: bool) -> Result<(), Failure> {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let named = |e: &std::io::Error| Failure::writing(&path.display().to_string(), e);
    let mut temporary = NamedTempFile::new_in(folder).map_err(|e| named(&e))?;
    temporary.write_all(bytes).map_err(|e| named(&e))?;
    output::persist(temporary, path, force)
}

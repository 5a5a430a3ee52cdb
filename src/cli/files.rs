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

/// Writes a record's picture to `FOLDER/ID.svg`; letters of the id that may not stand in a file name become `_`.
pub fn save_picture(folder: &Path, id: &str, svg: &str, force: bool) -> Result<(), String> {
    let plain = |c: char| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' };
    let name: String = id.chars().map(plain).collect();
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    write_file(&folder.join(format!("{name}.svg")), svg.as_bytes(), force).map_err(|error| error.to_string())
}

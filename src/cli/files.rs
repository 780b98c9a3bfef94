//! Files that the program writes by itself.

use std::path::Path;

use super::failure::Failure;
use crate::export::file;

/// Writes a file that is whole or not there.
pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    folder_of(path)?;
    file::write(path, [bytes]).map_err(|error| Failure::file("write", path, &error))
}

/// The folder that a file is to be written to; it must be there.
pub(super) fn folder_of(path: &Path) -> Result<&Path, Failure> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let problem = if folder.is_dir() {
        return Ok(folder);
    } else if folder.exists() {
        "is not a folder; name another place"
    } else {
        "does not exist; make that folder, or name another place"
    };
    Err(Failure::Surroundings(format!(
        "cannot write {}: {} {problem}",
        path.display(),
        folder.display()
    )))
}

/// Moves files from one folder to another one, each at once.
pub(super) fn publish(from: &Path, to: &Path, names: &[String]) -> Result<(), Failure> {
    for name in names {
        let (from, to) = (from.join(name), to.join(name));
        let parent = to.parent().map_or(Ok(()), std::fs::create_dir_all);
        parent
            .and_then(|()| file::readable(&from))
            .and_then(|()| std::fs::rename(from, &to))
            .map_err(|error| Failure::file("write", &to, &error))?;
    }
    Ok(())
}

//! Files that are whole or not there: written beside their place, then renamed.

use std::io::Write;
use std::path::Path;

use super::failure::Failure;

/// Writes a file under a temporary name in the same folder and renames it.
pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let failed = |error: &std::io::Error| Failure::file("write", path, error);
    let folder = folder_of(path)?;
    let mut file = tempfile::Builder::new()
        .prefix(".clinothem-")
        .tempfile_in(folder)
        .map_err(|error| failed(&error))?;
    file.write_all(bytes).map_err(|error| failed(&error))?;
    readable(file.path()).map_err(|error| failed(&error))?;
    file.persist(path).map_err(|error| failed(&error.error))?;
    Ok(())
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

/// Temporary files are private; results have the usual permissions.
pub(super) fn readable(path: &Path) -> std::io::Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        std::fs::set_permissions(path, std::fs::Permissions::from_mode(0o644))?;
    }
    #[cfg(not(unix))]
    let _ = path;
    Ok(())
}

//! Files that are whole or not there: written beside their place, then renamed.

use std::io::{self, Write};
use std::path::Path;

/// Writes pieces of a file under a temporary name in the same folder and renames it.
///
/// # Errors
/// If it cannot be written; then nothing is left, and an earlier file of that name is as it was.
pub fn write<'a>(path: &Path, pieces: impl IntoIterator<Item = &'a [u8]>) -> io::Result<()> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut file = tempfile::Builder::new()
        .prefix(".clinothem-")
        .tempfile_in(folder)?;
    for piece in pieces {
        file.write_all(piece)?;
    }
    readable(file.path())?;
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
}

/// Temporary files are private; results have the usual permissions.
pub fn readable(path: &Path) -> io::Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        std::fs::set_permissions(path, std::fs::Permissions::from_mode(0o644))?;
    }
    #[cfg(not(unix))]
    let _ = path;
    Ok(())
}

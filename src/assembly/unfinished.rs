//! Folders of files that are not finished, and what a process that was killed has left of them.
//!
//! A folder holds a file that its process has locked for as long as it lives. The system lets go of the lock when the
//! process ends, however it ends; so a folder whose lock is free has been left, and one that is held has not, whatever
//! became of process numbers since. Without such a file a folder is not ours and is left alone.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::Path;

use tempfile::TempDir;

/// The file that is locked.
const LOCK: &str = "clinothem.lock";

/// How often a folder is made again that another process has taken for one left behind, before its lock was held.
const MOST_ATTEMPTS: usize = 8;

/// A folder for files that are not finished; it goes when this is dropped.
#[derive(Debug)]
pub struct Unfinished {
    // Dropped before the folder: some systems keep files that are open.
    _lock: File,
    folder: TempDir,
}

impl Unfinished {
    /// Makes a folder with a name of its own that begins with `prefix`.
    pub fn new(place: &Path, prefix: &str) -> io::Result<Self> {
        for _ in 0..MOST_ATTEMPTS {
            let folder = tempfile::Builder::new().prefix(prefix).tempdir_in(place)?;
            let path = folder.path().join(LOCK);
            let lock = match File::create_new(&path) {
                Ok(lock) => lock,
                Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
                Err(error) => return Err(error),
            };
            // Where files cannot be locked nobody can take it for one left behind.
            let taken = matches!(lock.try_lock(), Err(TryLockError::WouldBlock));
            if !taken && path.is_file() {
                return Ok(Self {
                    _lock: lock,
                    folder,
                });
            }
        }
        Err(io::Error::other(
            "another process removes folders of unfinished files; try again",
        ))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }
}

/// What there is of folders of unfinished files in a place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Found {
    /// Of processes that have ended; they are removed.
    pub abandoned: usize,
    /// Of processes that are at work.
    pub in_use: usize,
}

/// Removes what processes that were killed have left in a place under names that begin with `prefix`.
///
/// What cannot be removed stays: it is in nobody's way.
pub fn clear(place: &Path, prefix: &str) -> io::Result<Found> {
    let mut found = Found::default();
    for entry in fs::read_dir(place)? {
        let Ok(entry) = entry else { continue };
        let ours = entry.file_name().to_string_lossy().starts_with(prefix);
        // Not through links: they are nothing that this program makes.
        if !ours || !entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            continue;
        }
        match state(&entry.path()) {
            State::InUse => found.in_use += 1,
            State::Abandoned(lock) => {
                found.abandoned += usize::from(remove(&entry.path()).is_ok());
                drop(lock);
            }
            // Killed before it held a lock; if it is not empty this does nothing.
            State::Unlocked => {
                found.abandoned += usize::from(fs::remove_dir(entry.path()).is_ok());
            }
        }
    }
    Ok(found)
}

/// Removes a folder, its lock last: without it, what is left by one who is killed here would be nobody's.
fn remove(folder: &Path) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if entry.file_type()?.is_dir() {
            fs::remove_dir_all(entry.path())?;
        } else if entry.file_name() != LOCK {
            fs::remove_file(entry.path())?;
        }
    }
    fs::remove_dir_all(folder)
}

enum State {
    InUse,
    /// With its lock, now ours.
    Abandoned(File),
    Unlocked,
}

fn state(folder: &Path) -> State {
    let path = folder.join(LOCK);
    // A plain file alone is opened: a pipe of that name would keep us waiting.
    if !fs::symlink_metadata(&path).is_ok_and(|data| data.is_file()) {
        return State::Unlocked;
    }
    match File::open(&path).map(|lock| lock.try_lock().map(|()| lock)) {
        Ok(Ok(lock)) => State::Abandoned(lock),
        // Held, or of another user, or where files cannot be locked: not ours to remove.
        _ => State::InUse,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;

    fn place() -> TempDir {
        tempfile::tempdir().unwrap()
    }

    #[test]
    fn a_folder_in_use_is_left_alone_and_one_whose_lock_is_free_is_removed() {
        let place = place();
        let at_work = Unfinished::new(place.path(), ".ours-").unwrap();
        fs::write(at_work.path().join("half"), "a").unwrap();
        let killed = place.path().join(".ours-killed");
        fs::create_dir_all(killed.join("deeper")).unwrap();
        fs::write(killed.join(LOCK), "").unwrap();
        fs::write(killed.join("deeper/half"), "b").unwrap();
        let found = clear(place.path(), ".ours-").unwrap();
        assert_eq!((found.abandoned, found.in_use), (1, 1));
        assert!(!killed.exists());
        assert!(at_work.path().join("half").is_file());
        let path = at_work.path().to_path_buf();
        drop(at_work);
        assert!(!path.exists());
        assert_eq!(clear(place.path(), ".ours-").unwrap(), Found::default());
    }

    #[test]
    fn what_this_program_has_not_made_stays_even_under_such_a_name() {
        let place = place();
        let keep = [".ours-without-lock/a", "other/clinothem.lock", ".ours-file"];
        for name in keep {
            let path = place.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, "ten years of work").unwrap();
        }
        assert_eq!(clear(place.path(), ".ours-").unwrap(), Found::default());
        assert!(keep.iter().all(|name| place.path().join(name).is_file()));
    }

    #[cfg(unix)]
    #[test]
    fn a_link_to_a_folder_of_ours_is_not_followed() {
        let (place, elsewhere) = (place(), self::place());
        fs::write(elsewhere.path().join(LOCK), "").unwrap();
        fs::write(elsewhere.path().join("a"), "kept").unwrap();
        let link = place.path().join(".ours-link");
        std::os::unix::fs::symlink(elsewhere.path(), &link).unwrap();
        assert_eq!(clear(place.path(), ".ours-").unwrap(), Found::default());
        assert!(elsewhere.path().join("a").is_file());
    }

    #[test]
    fn an_empty_folder_without_a_lock_is_in_nobodys_use() {
        let place = place();
        fs::create_dir(place.path().join(".ours-empty")).unwrap();
        let found = clear(place.path(), ".ours-").unwrap();
        assert_eq!((found.abandoned, found.in_use), (1, 0));
        let made = Unfinished::new(place.path(), ".ours-").unwrap();
        assert!(made.path().join(LOCK).is_file());
    }
}

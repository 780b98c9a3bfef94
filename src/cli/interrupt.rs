//! Ctrl-C: stops within a second and leaves nothing half-written.
//!
//! Whatever looks at the [`Cancel`] stops by itself. What cannot be interrupted (writing STEP) is given
//! a moment; then the folder of unfinished files is removed and the process ends with 130.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use super::failure::Failure;
use super::print;
use crate::assembly::Cancel;

/// The folder of files that are not finished yet.
static UNFINISHED: Mutex<Option<PathBuf>> = Mutex::new(None);

/// How long the program may take to stop by itself.
const GRACE: Duration = Duration::from_millis(600);

/// A cancel that Ctrl-C and a termination request set.
pub(super) fn cancel() -> Result<Cancel, Failure> {
    cancel_saying(Failure::INTERRUPTED)
}

/// The same of a command that has other last words.
pub(super) fn cancel_saying(words: &'static str) -> Result<Cancel, Failure> {
    let cancel = Cancel::new();
    let handled = cancel.clone();
    ctrlc::set_handler(move || {
        handled.cancel();
        // Signals have a thread of their own here, so it may sleep.
        std::thread::sleep(GRACE);
        if let Some(folder) = unfinished().take() {
            drop(std::fs::remove_dir_all(folder));
        }
        print::err(words);
        std::process::exit(130);
    })
    .map_err(|error| Failure::Surroundings(format!("Ctrl-C cannot be caught: {error}")))?;
    Ok(cancel)
}

/// Remembers the folder of unfinished files; `None` when they are finished.
pub(super) fn unfinished_in(folder: Option<&Path>) {
    *unfinished() = folder.map(Path::to_path_buf);
}

fn unfinished() -> std::sync::MutexGuard<'static, Option<PathBuf>> {
    // Only a path: a panic elsewhere leaves nothing half-done in it.
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

//! Stopping an operation from another thread, and hearing how far it is.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A request to stop. Clones share it.
#[derive(Clone, Debug, Default)]
pub struct Cancel {
    flag: Arc<AtomicBool>,
}

impl Cancel {
    /// Nothing is asked yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Asks every operation that was given this, or a clone, to stop.
    pub fn cancel(&self) {
        self.flag.store(true, Ordering::Release);
    }

    /// Whether stopping was asked.
    pub fn is_cancelled(&self) -> bool {
        self.flag.load(Ordering::Acquire)
    }
}

/// What the kernel's worker threads see of the caller.
pub(crate) struct Monitor<'a> {
    cancel: &'a Cancel,
    progress: &'a (dyn Fn(f64) + Sync),
}

impl<'a> Monitor<'a> {
    pub(crate) fn new(cancel: &'a Cancel, progress: &'a (dyn Fn(f64) + Sync)) -> Self {
        Self { cancel, progress }
    }

    pub(crate) fn is_cancelled(&self) -> bool {
        self.cancel.is_cancelled()
    }

    pub(crate) fn report(&self, fraction: f64) {
        (self.progress)(fraction);
    }
}

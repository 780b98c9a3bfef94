//! The kernel's worker threads.

use crate::error::{BridgeError, from_kernel};
use crate::ffi::bridge;

/// Whether an operation may use the kernel's worker threads.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Threads {
    /// On the calling thread.
    One,
    /// On all of the kernel's threads, see [`set_threads`]. The results are the same.
    #[default]
    All,
}

impl Threads {
    pub(crate) fn parallel(self) -> bool {
        self == Self::All
    }
}

/// How many threads the kernel uses where an operation may run on several. Call it before the first operation: until then the kernel
/// takes as many as the machine has.
pub fn set_threads(count: usize) -> Result<(), BridgeError> {
    bridge::use_threads(count).map_err(|e| from_kernel("setting the number of threads", &e))
}

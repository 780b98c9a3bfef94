//! Attempts that were not proven, and why there is no assembly.

use std::fmt::Write;

use super::contacts::{self, Contact};
use super::options::Engine;
use super::worker::WorkerError;

/// An attempt that was not proven, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct Failed {
    /// What had made it.
    pub engine: Engine,
    /// The remedy that was tried.
    pub remedy: &'static str,
    /// Why its result was not accepted.
    pub why: String,
    /// Where it could not tell how things lie.
    pub contacts: Vec<Contact>,
    /// The volumes that were in doubt, as far as it is known.
    pub doubtful: Vec<usize>,
    /// Whether things touch or run along each other, so that no tighter curve would help.
    pub coincides: bool,
}

impl Failed {
    /// An attempt of which no more is known than why it failed.
    pub(super) fn new(engine: Engine, remedy: &'static str, why: String) -> Self {
        Self {
            engine,
            remedy,
            why,
            contacts: Vec::new(),
            doubtful: Vec::new(),
            coincides: false,
        }
    }
}

impl std::fmt::Display for Failed {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "{}, remedy “{}”: {}",
            self.engine.name(),
            self.remedy,
            self.why
        )
    }
}

/// Why there is no assembly.
#[derive(Debug, thiserror::Error)]
pub enum AssemblyError {
    /// Stopped on request.
    #[error("stopped on request")]
    Cancelled,
    /// No remedy gave a result that could be proven.
    #[error(
        "the assembly could not be proven, so nothing is written\n{}",
        refusal(contacts, names)
    )]
    NotProven {
        /// What was tried.
        failed: Vec<Failed>,
        /// Where things lie too near each other.
        contacts: Vec<Contact>,
        /// What is in doubt, if no such place is known; all bodies if that is not known either.
        names: String,
    },
    /// The system starts no threads.
    #[error(
        "the system starts no threads ({0}); end other programs, or allow more processes (`ulimit -u`)"
    )]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// The child process took too long or could not be used.
    #[error("{source}; the model has {bodies} bodies: {names}")]
    Worker {
        /// What happened.
        source: WorkerError,
        /// How many bodies take part.
        bodies: usize,
        /// Their names.
        names: String,
    },
    /// The kernel failed while the result was measured.
    #[error("the kernel could not measure its result: {0}")]
    Measure(String),
}

/// What is wrong with a model that cannot be proven, and what to change.
fn refusal(contacts: &[Contact], names: &str) -> String {
    let mut out = String::new();
    for contact in contacts.iter().take(contacts::MOST_SAID) {
        let _ = writeln!(out, "  {contact}");
    }
    if let Some(more @ 1..) = contacts.len().checked_sub(contacts::MOST_SAID) {
        let _ = writeln!(out, "  … and {more} more such places");
    }
    if contacts.is_empty() {
        let _ = writeln!(
            out,
            "  in doubt: {names}; where they are too near each other is not known: leave out one after the other (`--without`) to \
             find which it is, and change its course, size or elevation a little"
        );
    }
    out.trim_end().to_owned()
}

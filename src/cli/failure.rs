//! Why commands fail.

/// Why a command failed.
#[derive(Debug)]
pub(super) enum Failure {
    /// The model or the arguments are wrong.
    Wrong(String),
    /// The same, with the defects as JSON for standard output.
    WrongModel { text: String, json: Option<String> },
    /// The assembly could not be proven.
    #[cfg_attr(
        not(feature = "occt"),
        expect(dead_code, reason = "nothing is assembled without the kernel")
    )]
    Unproven(String),
    /// Disk, permissions, processes.
    Surroundings(String),
    /// Stopped on request, with what became of the work.
    #[cfg_attr(
        not(feature = "occt"),
        expect(dead_code, reason = "nothing takes long without the kernel")
    )]
    Interrupted(&'static str),
}

impl Failure {
    /// What is said of a command that was interrupted before it wrote anything.
    #[cfg_attr(
        not(feature = "occt"),
        expect(dead_code, reason = "nothing takes long without the kernel")
    )]
    pub(super) const INTERRUPTED: &str = "interrupted; nothing was written";

    /// A file operation that failed.
    pub(super) fn file(what: &str, path: &std::path::Path, error: &std::io::Error) -> Self {
        Self::Surroundings(format!("cannot {what} {}: {error}", path.display()))
    }
}

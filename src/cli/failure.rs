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
    /// Stopped on request.
    #[cfg_attr(
        not(feature = "occt"),
        expect(dead_code, reason = "nothing takes long without the kernel")
    )]
    Interrupted,
}

impl Failure {
    /// A file operation that failed.
    pub(super) fn file(what: &str, path: &std::path::Path, error: &std::io::Error) -> Self {
        Self::Surroundings(format!("cannot {what} {}: {error}", path.display()))
    }
}

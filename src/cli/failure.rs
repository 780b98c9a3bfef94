//! Failures and their exit codes.

use std::process::ExitCode;

use super::print;

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
    /// Tells the user and gives the exit code.
    pub(super) fn report(self) -> ExitCode {
        let (code, text) = match self {
            Self::Wrong(text) => (1, format!("error: {text}")),
            Self::WrongModel { text, json } => {
                let unprinted = json.and_then(|json| print::out(&json).err());
                print::err(text.trim_end());
                return unprinted.map_or(ExitCode::from(1), Self::report);
            }
            Self::Unproven(text) => (2, format!("error: {text}")),
            Self::Surroundings(text) => (3, format!("error: {text}")),
            Self::Interrupted => (130, "interrupted; nothing was written".to_owned()),
        };
        print::err(text.trim_end());
        ExitCode::from(code)
    }

    /// A file operation that failed.
    pub(super) fn file(what: &str, path: &std::path::Path, error: &std::io::Error) -> Self {
        Self::Surroundings(format!("cannot {what} {}: {error}", path.display()))
    }
}

//! Printing that survives a closed pipe, and tells of a full disk; failures in words, with their exit codes.

use std::io::{Error, ErrorKind, Write};
use std::process::ExitCode;

use super::failure::Failure;

/// A line to standard output. `clinothem … | head` closes it early; that is no error, but a disk that is full is.
pub(super) fn out(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    told(writeln!(out, "{text}").and_then(|()| out.flush()))
}

/// What became of writing to standard output.
pub(super) fn told(written: Result<(), Error>) -> Result<(), Failure> {
    match written {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::Surroundings(format!(
            "cannot write to standard output: {error}"
        ))),
        _ => Ok(()),
    }
}

/// A line to standard error.
pub(super) fn err(text: &str) {
    drop(writeln!(std::io::stderr().lock(), "{text}"));
}

/// Tells the user of a failure and gives the exit code.
pub(super) fn failure(failure: Failure) -> ExitCode {
    let (code, text) = match failure {
        Failure::Wrong(text) => (1, format!("error: {text}")),
        Failure::WrongModel { text, json } => {
            let unprinted = json.and_then(|json| out(&json).err());
            err(text.trim_end());
            return unprinted.map_or(ExitCode::from(1), self::failure);
        }
        Failure::Unproven(text) => (2, format!("error: {text}")),
        Failure::Surroundings(text) => (3, format!("error: {text}")),
        Failure::Interrupted(words) => (130, words.to_owned()),
    };
    err(text.trim_end());
    ExitCode::from(code)
}

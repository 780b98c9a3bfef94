//! Printing that survives a closed pipe, and tells of a full disk.

use std::io::{Error, ErrorKind, Write};

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

//! Printing that survives a closed pipe.

use std::io::Write;

/// A line to standard output. `clinothem … | head` closes it early; that is no error.
pub(super) fn out(text: &str) {
    drop(writeln!(std::io::stdout().lock(), "{text}"));
}

/// A line to standard error.
pub(super) fn err(text: &str) {
    drop(writeln!(std::io::stderr().lock(), "{text}"));
}

//! Files that the program writes by itself.

use std::path::Path;

use super::failure::Failure;
use crate::export::file;

/// Writes a file that is whole or not there.
pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    file::write(path, [bytes]).map_err(|error| Failure::file("write", path, &error))
}

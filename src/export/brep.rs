//! BREP: OpenCASCADE's own text format. It keeps shared faces shared, and every program built on
//! OpenCASCADE reads it.

use std::path::Path;

use super::ExportError;
use crate::assembly::{Assembly, kernel};

/// Writes all solids as one shape with common faces, background first, then by volume.
pub fn write(path: &Path, assembly: &Assembly) -> Result<(), ExportError> {
    assembly
        .ordered_solids()
        .and_then(|solids| kernel::compound(&solids))
        .and_then(|shape| kernel::write_brep(path, &shape))
        .map_err(|error| ExportError::Kernel {
            what: "BREP",
            message: error.to_string(),
        })
}

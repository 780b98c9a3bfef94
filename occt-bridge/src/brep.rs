//! OpenCASCADE's own text format: exact, and shared faces stay shared.

use std::path::Path;

use crate::error::{BridgeError, from_file};
use crate::ffi::bridge;
use crate::shape::Shape;
use crate::step::path_text;

/// Writes a shape. An existing file is replaced.
pub fn write_brep(path: &Path, shape: &Shape) -> Result<(), BridgeError> {
    bridge::write_brep_file(shape.handle(), path_text(path)?)
        .map_err(|e| from_file("writing BREP", path, &e))
}

/// Reads a shape.
pub fn read_brep(path: &Path) -> Result<Shape, BridgeError> {
    bridge::read_brep_file(path_text(path)?)
        .map(Shape::new)
        .map_err(|e| from_file("reading BREP", path, &e))
}

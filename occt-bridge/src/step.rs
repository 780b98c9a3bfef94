//! Reading STEP files, whoever wrote them: how a file looks to programs that are built on the kernel.
//!
//! The kernel keeps STEP settings per process, so one file is read at a time.

use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::error::{BridgeError, from_file, from_kernel};
use crate::ffi::bridge;
use crate::shape::Shape;

/// Held while STEP settings or documents are in use.
static STEP: Mutex<()> = Mutex::new(());

pub(crate) fn lock() -> MutexGuard<'static, ()> {
    // It guards no data of ours, so a panic of another holder leaves nothing half-done.
    STEP.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A part that was read.
#[derive(Debug, Clone)]
pub struct ReadPart {
    /// PRODUCT name.
    pub name: String,
    /// Names from the root to the part, joined by `/`.
    pub path: String,
    /// Red, green, blue (sRGB).
    pub color: Option<[u8; 3]>,
    /// Layer.
    pub layer: Option<String>,
    /// The part, where it is in the assembly.
    pub shape: Shape,
}

/// What a reader counts in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LengthUnit {
    /// Metres.
    Metre,
    /// Millimetres, as most programs do.
    Millimetre,
}

/// Reads the parts of a STEP file, in metres whatever unit the file has. Faces that several shells of one shape share are there
/// once, and closed shells without solids become solids.
pub fn read_step(path: &Path) -> Result<Vec<ReadPart>, BridgeError> {
    read_step_in(path, LengthUnit::Metre)
}

/// The same in another unit.
pub fn read_step_in(path: &Path, unit: LengthUnit) -> Result<Vec<ReadPart>, BridgeError> {
    let operation = "reading STEP";
    let unit = match unit {
        LengthUnit::Metre => "M",
        LengthUnit::Millimetre => "MM",
    };
    let mut tables = Vec::new();
    let _guard = lock();
    let parts = bridge::read_parts(path_text(path)?, unit, &mut tables)
        .map_err(|e| from_file(operation, path, &e))?;
    tables
        .into_iter()
        .enumerate()
        .map(|(i, part)| {
            Ok(ReadPart {
                name: part.name,
                path: part.path,
                color: part.has_color.then_some(part.color),
                layer: (!part.layer.is_empty()).then_some(part.layer),
                shape: parts
                    .shape(i)
                    .map(Shape::new)
                    .map_err(|e| from_kernel(operation, &e))?,
            })
        })
        .collect()
}

pub(crate) fn path_text(path: &Path) -> Result<&str, BridgeError> {
    path.to_str().ok_or_else(|| BridgeError::Io {
        path: path.to_path_buf(),
        message: "the path is not UTF-8, which the kernel needs".to_owned(),
    })
}

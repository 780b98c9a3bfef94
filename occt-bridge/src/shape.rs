//! A handle to a shape that the kernel holds.

use std::fmt;
use std::sync::Arc;

use cxx::UniquePtr;

use crate::bytes::{Reader, Writer};
use crate::error::{BridgeError, from_kernel, input};
use crate::ffi::bridge;

const MAGIC: [u8; 8] = *b"CLNSHP01";

/// A shape. Clones share it; nothing in this crate changes a shape after it was made.
#[derive(Clone)]
pub struct Shape {
    handle: Arc<UniquePtr<bridge::ShapeHandle>>,
}

/// What a [`Shape`] is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShapeKind {
    /// Several shapes.
    Compound,
    /// Solids that share faces.
    CompSolid,
    /// A region of space.
    Solid,
    /// Connected faces.
    Shell,
    /// A bounded piece of a surface.
    Face,
    /// Connected edges.
    Wire,
    /// A bounded piece of a curve.
    Edge,
    /// A point.
    Vertex,
}

impl Shape {
    pub(crate) fn new(handle: UniquePtr<bridge::ShapeHandle>) -> Self {
        Self {
            handle: Arc::new(handle),
        }
    }

    pub(crate) fn handle(&self) -> &bridge::ShapeHandle {
        &self.handle
    }

    /// What it is.
    pub fn kind(&self) -> Result<ShapeKind, BridgeError> {
        let name = bridge::kind_of(&self.handle).map_err(|e| from_kernel("reading a shape", &e))?;
        Ok(match name.as_str() {
            "compsolid" => ShapeKind::CompSolid,
            "solid" => ShapeKind::Solid,
            "shell" => ShapeKind::Shell,
            "face" => ShapeKind::Face,
            "wire" => ShapeKind::Wire,
            "edge" => ShapeKind::Edge,
            "vertex" => ShapeKind::Vertex,
            _ => ShapeKind::Compound,
        })
    }

    /// The shape as bytes, exactly, for another process of the same build.
    pub fn to_bytes(&self) -> Result<Vec<u8>, BridgeError> {
        let block = bridge::shape_to_bytes(&self.handle)
            .map_err(|e| from_kernel("writing a shape to bytes", &e))?;
        let mut out = Writer::new(MAGIC);
        out.block(&block);
        Ok(out.finish())
    }

    /// Reads what [`Self::to_bytes`] wrote.
    ///
    /// # Errors
    /// [`BridgeError::Input`] if the bytes are something else.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, BridgeError> {
        let operation = "reading a shape from bytes";
        let block = Reader::new(bytes, MAGIC)
            .and_then(|mut from| from.block())
            .map_err(|message| input(operation, message))?;
        bridge::shape_from_bytes(block)
            .map(Self::new)
            .map_err(|e| from_kernel(operation, &e))
    }

    /// The number of different sub-shapes of a kind: a face that two solids share counts once.
    pub fn count(&self, kind: ShapeKind) -> Result<usize, BridgeError> {
        let code = match kind {
            ShapeKind::Solid => 0,
            ShapeKind::Shell => 1,
            ShapeKind::Face => 2,
            ShapeKind::Edge => 3,
            ShapeKind::Vertex => 4,
            other => {
                return Err(input(
                    "counting sub-shapes",
                    format!("{other:?} cannot be counted"),
                ));
            }
        };
        bridge::count_of(&self.handle, code).map_err(|e| from_kernel("counting sub-shapes", &e))
    }
}

impl fmt::Debug for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.kind() {
            Ok(kind) => write!(f, "Shape({kind:?})"),
            Err(error) => write!(f, "Shape({error})"),
        }
    }
}

pub(crate) fn list<'a>(
    shapes: impl IntoIterator<Item = &'a Shape>,
) -> Result<UniquePtr<bridge::ShapeList>, BridgeError> {
    let operation = "collecting shapes";
    let mut list = bridge::new_list().map_err(|e| from_kernel(operation, &e))?;
    for shape in shapes {
        list.pin_mut()
            .push(&shape.handle)
            .map_err(|e| from_kernel(operation, &e))?;
    }
    Ok(list)
}

/// Several shapes as one.
pub fn compound(shapes: &[Shape]) -> Result<Shape, BridgeError> {
    let operation = "making a compound";
    if shapes.is_empty() {
        return Err(input(operation, "no shape was given"));
    }
    bridge::compound_of(&*list(shapes)?)
        .map(Shape::new)
        .map_err(|e| from_kernel(operation, &e))
}

/// OpenCASCADE's version, such as `7.6.3`.
pub fn version() -> String {
    bridge::kernel_version().unwrap_or_else(|error| error.what().to_owned())
}

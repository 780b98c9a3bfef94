//! STEP files in metres: the file declares METRE, and its numbers are the model's.
//!
//! Two flavours. The *assembly* has one PRODUCT per volume, with its name, colour, layer and description, in a tree; every product has
//! its own copy of each face, bit for bit the same. The *shared* flavour is one shape in which common faces are there once.
//!
//! The same document gives the same bytes: no clock, no user, and no counter that lives longer than the call. The kernel keeps STEP
//! settings per process, so one file is read or written at a time.

use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::error::{BridgeError, from_file, from_kernel, input};
use crate::ffi::bridge;
use crate::shape::{Shape, list};

/// Held while STEP settings or documents are in use.
static STEP: Mutex<()> = Mutex::new(());

fn lock() -> MutexGuard<'static, ()> {
    // It guards no data of ours, so a panic of another holder leaves nothing half-done.
    STEP.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The application protocol that a file declares.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum StepSchema {
    /// AP214, automotive design: read by everything.
    #[default]
    Ap214,
    /// AP242, managed model based engineering.
    Ap242,
}

/// A tree of named parts.
#[derive(Debug, Clone)]
pub struct StepDocument {
    /// Name in the header. ASCII.
    pub name: String,
    /// The program and version that made the model, for the header. ASCII.
    pub system: String,
    /// What the file holds, for the header. ASCII, may be empty.
    pub description: String,
    /// Application protocol.
    pub schema: StepSchema,
    /// The root of the tree.
    pub root: StepNode,
}

/// A part (`shapes`) or an assembly (`children`); never both.
#[derive(Debug, Clone, Default)]
pub struct StepNode {
    /// PRODUCT name; give every node its own. ASCII.
    pub name: String,
    /// Red, green, blue (sRGB).
    pub color: Option<[u8; 3]>,
    /// Layer. ASCII.
    pub layer: Option<String>,
    /// PRODUCT description, where rock properties travel. ASCII.
    pub description: Option<String>,
    /// The pieces of the part: solids of one PRODUCT. A shape may be there only once in a document.
    pub shapes: Vec<Shape>,
    /// Nodes below.
    pub children: Vec<StepNode>,
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
    /// The part, in metres, where it is in the assembly.
    pub shape: Shape,
}

/// Writes the assembly flavour. An existing file is replaced.
///
/// # Errors
/// [`BridgeError::Input`] names the node whose name is empty or not ASCII, that has both shapes and children or neither, or a shape that
/// is there twice; [`BridgeError::Io`] if the file cannot be written.
pub fn write_step_assembly(path: &Path, document: &StepDocument) -> Result<(), BridgeError> {
    let operation = "writing a STEP assembly";
    let header = header(operation, document)?;
    let mut nodes = Vec::new();
    let mut shapes = Vec::new();
    flatten(operation, &document.root, -1, &mut nodes, &mut shapes)?;
    let shapes = list(shapes)?;
    let _guard = lock();
    bridge::write_assembly(path_text(path)?, &header, &nodes, &shapes)
        .map_err(|e| from_file(operation, path, &e))
}

/// Writes the shared flavour: one shape whose common faces are there once. `names` are those of its solids, in order.
///
/// The tree of `document` is not used. An existing file is replaced. The file holds one named closed shell per solid, which readers turn
/// into solids again.
///
/// # Errors
/// As [`write_step_assembly`]; also [`BridgeError::Input`] if a solid has a void, which this flavour cannot tell, or the number of names is
/// neither that of the solids nor zero.
pub fn write_step_shared(
    path: &Path,
    shape: &Shape,
    names: &[String],
    document: &StepDocument,
) -> Result<(), BridgeError> {
    let operation = "writing shared STEP";
    let header = header(operation, document)?;
    for name in names {
        check_text(operation, "a solid's name", name)?;
    }
    let _guard = lock();
    bridge::write_shared(path_text(path)?, &header, shape.handle(), &names.to_vec())
        .map_err(|e| from_file(operation, path, &e))
}

/// Reads the parts of a STEP file, in metres whatever unit the file has.
pub fn read_step(path: &Path) -> Result<Vec<ReadPart>, BridgeError> {
    let operation = "reading STEP";
    let mut tables = Vec::new();
    let _guard = lock();
    let parts = bridge::read_parts(path_text(path)?, &mut tables)
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

fn header(
    operation: &'static str,
    document: &StepDocument,
) -> Result<bridge::StepHeader, BridgeError> {
    check_text(operation, "the document's name", &document.name)?;
    check_text(operation, "the originating system", &document.system)?;
    check_ascii(operation, "the description", &document.description)?;
    Ok(bridge::StepHeader {
        name: document.name.clone(),
        system: document.system.clone(),
        description: document.description.clone(),
        ap242: document.schema == StepSchema::Ap242,
    })
}

fn check_text(operation: &'static str, what: &str, text: &str) -> Result<(), BridgeError> {
    if text.is_empty() {
        return Err(input(operation, format!("{what} is empty")));
    }
    check_ascii(operation, what, text)
}

/// The kernel writes other characters as raw bytes, which the format does not allow.
fn check_ascii(operation: &'static str, what: &str, text: &str) -> Result<(), BridgeError> {
    match text.chars().find(|c| !matches!(c, ' '..='~')) {
        Some(c) => Err(input(
            operation,
            format!("{what} {text:?} holds {c:?}; only printable ASCII can be written"),
        )),
        None => Ok(()),
    }
}

fn flatten<'a>(
    operation: &'static str,
    node: &'a StepNode,
    parent: i64,
    nodes: &mut Vec<bridge::StepNodeData>,
    shapes: &mut Vec<&'a Shape>,
) -> Result<(), BridgeError> {
    check_text(operation, "a node's name", &node.name)?;
    let text = |what: &str, value: Option<&String>| -> Result<String, BridgeError> {
        let value = value.cloned().unwrap_or_default();
        check_ascii(operation, &format!("the {what} of {:?}", node.name), &value)?;
        Ok(value)
    };
    if node.shapes.is_empty() == node.children.is_empty() {
        return Err(input(
            operation,
            format!(
                "{:?} has {} shapes and {} children; a node has one or the other",
                node.name,
                node.shapes.len(),
                node.children.len()
            ),
        ));
    }
    let index = i64::try_from(nodes.len())
        .map_err(|_| input(operation, "the document has too many nodes"))?;
    nodes.push(bridge::StepNodeData {
        name: node.name.clone(),
        parent,
        has_color: node.color.is_some(),
        color: node.color.unwrap_or_default(),
        layer: text("layer", node.layer.as_ref())?,
        description: text("description", node.description.as_ref())?,
        first_shape: shapes.len(),
        shapes: node.shapes.len(),
    });
    shapes.extend(&node.shapes);
    for child in &node.children {
        flatten(operation, child, index, nodes, shapes)?;
    }
    Ok(())
}

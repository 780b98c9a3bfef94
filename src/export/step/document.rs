//! What a STEP file says besides geometry: a tree of products with names, colours, layers and descriptions.

use crate::assembly::kernel::Boundary;
use crate::export::ExportError;

/// The application protocol that a file declares.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Protocol {
    /// AP214: read by everything.
    #[default]
    Ap214,
    /// AP242.
    Ap242,
}

/// A file: its header and its tree.
#[derive(Clone, Debug)]
pub struct Document {
    /// Name in the header.
    pub name: String,
    /// The program and version that made the model, for the header.
    pub system: String,
    /// What the file holds, for the header.
    pub description: String,
    /// Application protocol.
    pub protocol: Protocol,
    /// How far apart points may be that are one (m).
    pub accuracy: f64,
    /// The root of the tree.
    pub root: Node,
}

/// A product.
#[derive(Clone, Debug)]
pub struct Node {
    /// Its name; give every node its own.
    pub name: String,
    /// What it is called where people read, in any alphabet; its name if absent.
    pub label: Option<String>,
    /// Red, green, blue (sRGB).
    pub color: Option<[u8; 3]>,
    /// Layer.
    pub layer: Option<String>,
    /// Description, where rock properties travel.
    pub description: Option<String>,
    /// What it consists of.
    pub content: Content,
}

impl Node {
    /// What programs show.
    pub(super) fn shown(&self) -> &str {
        self.label.as_deref().unwrap_or(&self.name)
    }
}

/// What a product consists of.
#[derive(Clone, Debug)]
pub enum Content {
    /// Other products.
    Nodes(Vec<Node>),
    /// Shapes, by their index in [`Boundary::shapes`].
    Shapes(Vec<usize>),
    /// Whole curves, by their index in [`Boundary::curves`], that bound nothing.
    Curves(Vec<usize>),
}

/// Whether the tree names what there is.
pub(super) fn check(node: &Node, boundary: &Boundary) -> Result<(), ExportError> {
    let wrong = |what: String| Err(ExportError::Step(format!("{:?} {what}", node.name)));
    if node.name.is_empty() {
        return wrong("is no name of a part".to_owned());
    }
    match &node.content {
        Content::Nodes(nodes) if nodes.is_empty() => wrong("has no parts".to_owned()),
        Content::Nodes(nodes) => nodes.iter().try_for_each(|node| check(node, boundary)),
        Content::Shapes(shapes) if shapes.is_empty() => wrong("has no shapes".to_owned()),
        Content::Shapes(shapes) => {
            let count = boundary.shapes.len();
            match shapes.iter().find(|shape| **shape >= count) {
                Some(shape) => wrong(format!("names shape {shape}, but there are {count}")),
                None => Ok(()),
            }
        }
        Content::Curves(curves) if curves.is_empty() => wrong("has no curves".to_owned()),
        Content::Curves(curves) => {
            let count = boundary.curves.len();
            match curves.iter().find(|curve| **curve >= count) {
                Some(curve) => wrong(format!("names curve {curve}, but there are {count}")),
                None => Ok(()),
            }
        }
    }
}

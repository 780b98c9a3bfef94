//! The two flavours of a file: each product with faces of its own, or common faces there once.

use super::document::{Document, Protocol, check};
use super::draft::{Draft, Exchange};
use super::geometry::Geometry;
use super::part21::Quoted;
use super::products::Products;
use super::topology::Topology;
use crate::assembly::kernel::{Boundary, BoundaryShape};
use crate::export::ExportError;

/// The assembly flavour: each product has its own copy of every face.
///
/// # Errors
/// [`ExportError::Step`] names a node without a name, without content, or with a shape that is not there.
pub fn assembly(document: &Document, boundary: &Boundary) -> Result<Exchange, ExportError> {
    check(&document.root, boundary)?;
    let mut file = begin(document);
    let mut products = Products::new(&mut file, document);
    products.tree(&document.root, &mut Geometry::new(boundary));
    products.finish();
    Ok(file.finish())
}

/// The shared flavour: one product in which common faces are there once, and a closed shell by name for each solid.
///
/// Only the root is used of the tree.
///
/// # Errors
/// [`ExportError::Step`] if the number of names is not that of the shapes, or one of them is no solid of one shell: a closed
/// shell cannot tell a void from a body.
pub fn shared(
    document: &Document,
    names: &[String],
    boundary: &Boundary,
) -> Result<Exchange, ExportError> {
    if names.len() != boundary.shapes.len() {
        return Err(ExportError::Step(format!(
            "there are {} names for {} solids",
            names.len(),
            boundary.shapes.len()
        )));
    }
    let mut shells = Vec::with_capacity(names.len());
    for (name, shape) in names.iter().zip(&boundary.shapes) {
        match shape {
            BoundaryShape::Solid(of) if of.len() == 1 => shells.push(&of[0]),
            BoundaryShape::Solid(of) => {
                return Err(ExportError::Step(format!(
                    "{name} has {} shells: the shared flavour cannot tell a void from a body; BREP can",
                    of.len()
                )));
            }
            BoundaryShape::Faces(_) => {
                return Err(ExportError::Step(format!("{name} is not a solid")));
            }
        }
    }
    let mut file = begin(document);
    let mut geometry = Geometry::new(boundary);
    let faces = shells.iter().flat_map(|shell| shell.iter());
    let mut body = Topology::new(&mut geometry, faces.map(|(face, _)| *face));
    let mut models = Vec::with_capacity(names.len());
    for (name, shell) in names.iter().zip(shells) {
        let shell = body.closed_shell(&mut file, shell);
        models.push(file.add(format_args!(
            "SHELL_BASED_SURFACE_MODEL({},({shell}))",
            Quoted(name)
        )));
    }
    let mut products = Products::new(&mut file, document);
    products.single(
        &document.root,
        "NON_MANIFOLD_SURFACE_SHAPE_REPRESENTATION",
        models,
    );
    products.finish();
    Ok(file.finish())
}

/// No clock and no user: the same model gives the same bytes.
fn begin<'a>(document: &Document) -> Draft<'a> {
    let schema = match document.protocol {
        Protocol::Ap214 => "AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }",
        Protocol::Ap242 => {
            "AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 1 1 4 }"
        }
    };
    let system = Quoted(&document.system);
    Draft::new(format_args!(
        "FILE_DESCRIPTION(({}),'2;1');\n\
         FILE_NAME({},'1970-01-01T00:00:00',(''),(''),{system},{system},'');\n\
         FILE_SCHEMA(('{schema}'));\n",
        Quoted(&document.description),
        Quoted(&document.name)
    ))
}

//! STEP, in metres, in two flavours.
//!
//! *Assembly*: one PRODUCT per volume with its name, colour and layer (the facies), its connected pieces
//! as solids, in a tree of features. Each product has its own copy of every face, because STEP products
//! share nothing but geometry. *Shared*: one non-manifold shape in which the common faces are there once.
//!
//! Rock properties travel in the PRODUCT's description, `facies=…; porosity=…`, because few programs read
//! general attributes; `report.json` and `volumes.csv` hold them too.
//!
//! The writer is our own. `OpenCASCADE`'s takes the product of entities and kinds of entities several times over, one
//! hash look-up and one small allocation after the other: nine tenths of the time of a large model, for text that is known once
//! the solids are. This one takes the solids apart once ([`kernel::boundary`]) and formats in parallel. Of the
//! crates that write STEP, `truck-stepio` knows the topology of truck alone, and neither assemblies, colours and
//! layers nor curves on surfaces, without which FreeCAD mangles spline solids; `ruststep` gives types to read
//! into.

mod document;
mod draft;
mod far;
mod flavours;
mod geometry;
mod part21;
mod presentation;
mod products;
mod shapes;
mod topology;
mod tree;
mod wires;

use std::path::Path;

use self::tree::{Tree, color, facies_of, group, labelled};
use super::ExportError;
use super::report::solid_names;
use super::text::{ascii, one_line};
use super::wells::entries::WellEntry;
use crate::assembly::kernel::{self, BridgeError};
use crate::assembly::splines::EXACT;
use crate::assembly::{self, Assembly};
use crate::features::body::{Body, Role};
use crate::model::realisation::Realisation;
use crate::model::wells::spec::WellSpec;
use crate::model::{Model, labels};

pub use self::document::{Content, Document, Node, Protocol};
pub use self::draft::Exchange;
pub use self::flavours::{assembly, shared};

fn kernel_error(error: &BridgeError) -> ExportError {
    ExportError::Kernel {
        what: "STEP",
        message: error.to_string(),
    }
}

fn save(file: &Exchange, path: &Path) -> Result<(), ExportError> {
    file.save(path).map_err(|source| ExportError::File {
        path: path.to_path_buf(),
        source,
    })
}

/// Writes the assembly flavour.
pub fn write_assembly(
    path: &Path,
    model: &Model,
    realisation: &Realisation,
    assembly: &Assembly,
    protocol: Protocol,
) -> Result<(), ExportError> {
    let tree = Tree {
        model,
        realisation,
        labels: labels::labels(model, &realisation.volumes),
        pieces: &|volume| {
            let pieces = assembly.measured.pieces_of(volume).iter();
            pieces.map(|piece| piece.solid).collect()
        },
    };
    let solids = (0..assembly.solids.solids().len()).map(|solid| assembly.solids.shape_of(solid));
    let mut document = document(model, protocol, tree.root());
    let mut boundary = solids
        .collect::<Result<Vec<_>, _>>()
        .and_then(|solids| kernel::boundary(&solids))
        .map_err(|error| kernel_error(&error))?;
    document.accuracy = far::settle(&mut boundary, assembly.measured.tolerance);
    save(&self::assembly(&document, &boundary)?, path)
}

/// Writes the shared flavour.
pub fn write_shared(
    path: &Path,
    model: &Model,
    realisation: &Realisation,
    assembly: &Assembly,
    protocol: Protocol,
) -> Result<(), ExportError> {
    let names: Vec<String> = (0..realisation.volumes.len())
        .flat_map(|volume| {
            let pieces = assembly.measured.pieces_of(volume).len();
            solid_names(&realisation.volumes[volume].name, pieces)
        })
        .collect();
    let mut boundary = assembly
        .ordered_solids()
        .and_then(|solids| kernel::boundary(&solids))
        .map_err(|error| kernel_error(&error))?;
    let root = labelled(group(ascii(&model.name), Vec::new()), Some(&model.name));
    let mut document = document(model, protocol, root);
    document.accuracy = far::settle(&mut boundary, assembly.measured.tolerance);
    save(&shared(&document, &names, &boundary)?, path)
}

/// Writes the NURBS surfaces of all bodies, untrimmed, one part a sheet.
pub fn write_surfaces(
    path: &Path,
    model: &Model,
    realisation: &Realisation,
    protocol: Protocol,
) -> Result<(), ExportError> {
    let (mut nodes, mut faces) = (Vec::new(), Vec::new());
    let labels = labels::labels(model, &realisation.volumes);
    for instance in &realisation.instances {
        let rules = &realisation.volumes[instance.volume];
        let label = labels[instance.volume].as_deref();
        let facies = facies_of(model, &rules.facies);
        let sheets = instance
            .body
            .sheets()
            .map_err(|source| ExportError::Surface {
                volume: rules.name.clone(),
                source,
            })?;
        let part = |role: Role, at: usize| Node {
            name: format!("{}/{}", rules.name, role.name()),
            label: label.map(|label| format!("{label}/{}", role.name())),
            color: facies.map(color),
            layer: Some(ascii(role.name())),
            description: None,
            content: Content::Shapes(vec![at]),
        };
        let mut children = Vec::new();
        if let Body::Imported(imported) = &instance.body {
            // Its faces end where they should.
            children.push(part(Role::Skin, faces.len()));
            faces.push(assembly::solid_of(imported).map_err(|error| kernel_error(&error))?);
            nodes.push(labelled(group(rules.name.clone(), children), label));
            continue;
        }
        // The two ends only close the shell: they are no geological surfaces.
        for (role, surface) in sheets.iter().filter(|(role, _)| role.is_geological()) {
            children.push(part(*role, faces.len()));
            let topology = assembly::shapes::sheet(*role, surface);
            faces.push(kernel::faces(&topology).map_err(|error| kernel_error(&error))?);
        }
        // What lies everywhere in its unit has no surface of its own.
        if !children.is_empty() {
            nodes.push(labelled(group(rules.name.clone(), children), label));
        }
    }
    if faces.is_empty() {
        return Err(ExportError::Step(
            "no body of the model has a surface of its own".to_owned(),
        ));
    }
    let root = labelled(group(ascii(&model.name), nodes), Some(&model.name));
    let mut document = document(model, protocol, root);
    let mut boundary = kernel::boundary(&faces).map_err(|error| kernel_error(&error))?;
    document.accuracy = far::settle(&mut boundary, EXACT);
    save(&self::assembly(&document, &boundary)?, path)
}

/// Writes wells as curves that are split where they pass from one volume to another, by what a report says of them.
pub fn write_wells(
    path: &Path,
    model: &Model,
    realisation: &Realisation,
    wells: &[(&WellSpec, &WellEntry)],
    protocol: Protocol,
) -> Result<(), ExportError> {
    if wells.is_empty() {
        return Err(ExportError::Step("the model has no wells".to_owned()));
    }
    let (nodes, mut boundary) = wires::wires(model, realisation, wells);
    let name = group(ascii(&format!("wells of {}", model.name)), nodes);
    let root = labelled(name, Some(&format!("wells of {}", model.name)));
    let mut document = document(model, protocol, root);
    document.accuracy = far::settle(&mut boundary, EXACT);
    save(&self::assembly(&document, &boundary)?, path)
}

fn document(model: &Model, protocol: Protocol, root: Node) -> Document {
    let [x, y, z] = model.origin;
    Document {
        name: one_line(&model.name),
        system: concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION")).to_owned(),
        description: format!("seed {}; local origin {x} {y} {z} m", model.seed),
        protocol,
        accuracy: EXACT,
        root,
    }
}

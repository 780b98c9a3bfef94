//! STEP, in metres, in two flavours.
//!
//! *Assembly*: one PRODUCT per volume with its name, colour and layer (the facies), its connected pieces
//! as solids, in a tree of features. Each product has its own copy of every face, because STEP products
//! share nothing. *Shared*: one non-manifold shape in which the common faces are there once.
//!
//! Rock properties travel in the PRODUCT's description, `facies=…; porosity=…`, because
//! `OpenCASCADE` 7.6 writes no general attributes; `report.json` and `volumes.csv` hold them too.

use std::path::Path;

use super::ExportError;
use super::report::solid_names;
use super::text::ascii;
use crate::assembly::kernel::{self, BridgeError, StepDocument, StepNode, StepSchema};
use crate::assembly::{Assembly, shapes};
use crate::model::realisation::Realisation;
use crate::model::{Facies, Model, Property};

/// The application protocol that a file declares.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Protocol {
    /// AP214: read by everything.
    #[default]
    Ap214,
    /// AP242.
    Ap242,
}

impl From<Protocol> for StepSchema {
    fn from(protocol: Protocol) -> Self {
        match protocol {
            Protocol::Ap214 => Self::Ap214,
            Protocol::Ap242 => Self::Ap242,
        }
    }
}

fn kernel_error(error: &BridgeError) -> ExportError {
    ExportError::Kernel {
        what: "STEP",
        message: error.to_string(),
    }
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
        part: &|volume| {
            assembly
                .measured
                .pieces_of(volume)
                .iter()
                .map(|piece| assembly.solids.shape_of(piece.solid))
                .collect::<Result<_, _>>()
                .map_err(|error| kernel_error(&error))
        },
    };
    let document = document(model, protocol, tree.root()?);
    kernel::write_step_assembly(path, &document).map_err(|error| kernel_error(&error))
}

/// Writes the shared flavour.
pub fn write_shared(
    path: &Path,
    model: &Model,
    realisation: &Realisation,
    assembly: &Assembly,
    protocol: Protocol,
) -> Result<(), ExportError> {
    let shape = assembly
        .ordered_compound()
        .map_err(|error| kernel_error(&error))?;
    let names: Vec<String> = (0..realisation.volumes.len())
        .flat_map(|volume| {
            let pieces = assembly.measured.pieces_of(volume).len();
            solid_names(&realisation.volumes[volume].name, pieces)
        })
        .collect();
    let root = StepNode {
        name: ascii(&model.name),
        ..StepNode::default()
    };
    let document = document(model, protocol, root);
    kernel::write_step_shared(path, &shape, &names, &document).map_err(|error| kernel_error(&error))
}

/// Writes the NURBS surfaces of all bodies, untrimmed, one part a sheet.
pub fn write_surfaces(
    path: &Path,
    model: &Model,
    realisation: &Realisation,
    protocol: Protocol,
) -> Result<(), ExportError> {
    let mut root = StepNode {
        name: ascii(&model.name),
        ..StepNode::default()
    };
    for instance in &realisation.instances {
        let rules = &realisation.volumes[instance.volume];
        let facies = facies_of(model, &rules.facies);
        let sheets = instance
            .body
            .sheets()
            .map_err(|source| ExportError::Surface {
                volume: rules.name.clone(),
                source,
            })?;
        let mut children = Vec::new();
        // The two ends only close the shell: they are no geological surfaces.
        for (role, surface) in sheets.iter().filter(|(role, _)| role.is_geological()) {
            let topology = shapes::sheet(*role, surface);
            let shape = kernel::faces(&topology).map_err(|error| kernel_error(&error))?;
            children.push(StepNode {
                name: format!("{}/{}", rules.name, role.name()),
                color: facies.map(color),
                layer: Some(ascii(role.name())),
                shapes: vec![shape],
                ..StepNode::default()
            });
        }
        // What lies everywhere in its unit has no surface of its own.
        if children.is_empty() {
            continue;
        }
        root.children.push(StepNode {
            name: rules.name.clone(),
            children,
            ..StepNode::default()
        });
    }
    let document = document(model, protocol, root);
    kernel::write_step_assembly(path, &document).map_err(|error| kernel_error(&error))
}

fn document(model: &Model, protocol: Protocol, root: StepNode) -> StepDocument {
    let [x, y, z] = model.origin;
    StepDocument {
        name: ascii(&model.name),
        system: concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION")).to_owned(),
        description: format!("seed {}; local origin {x} {y} {z} m", model.seed),
        schema: protocol.into(),
        root,
    }
}

fn facies_of<'a>(model: &'a Model, name: &str) -> Option<&'a Facies> {
    model.facies.iter().find(|facies| facies.name == name)
}

fn color(facies: &Facies) -> [u8; 3] {
    [facies.color.r, facies.color.g, facies.color.b]
}

/// `facies=sand; porosity=0.24; permeability_mD=600,600,120`.
fn description(facies: &Facies) -> String {
    let mut words = vec![format!("facies={}", ascii(&facies.name))];
    for (name, property) in &facies.properties {
        let unit = if name == "permeability" { "_mD" } else { "" };
        let value = match property {
            Property::Scalar(value) => value.to_string(),
            Property::Vector(values) => values.map(|value| value.to_string()).join(","),
        };
        words.push(format!("{}{unit}={value}", ascii(name)));
    }
    words.join("; ")
}

/// Builds the tree of parts: the background, then a node for each feature with several instances, and
/// for each volume that has children.
struct Tree<'a> {
    model: &'a Model,
    realisation: &'a Realisation,
    part: &'a dyn Fn(usize) -> Result<Vec<kernel::Shape>, ExportError>,
}

impl Tree<'_> {
    fn root(&self) -> Result<StepNode, ExportError> {
        let volumes = &self.realisation.volumes;
        let mut name = ascii(&self.model.name);
        // Names are unique in the file, the root's included.
        while volumes
            .iter()
            .any(|volume| volume.name == name || volume.feature == name)
        {
            name.push_str(" model");
        }
        let mut children: Vec<StepNode> = self.leaf(0)?.into_iter().collect();
        children.extend(self.features(None)?);
        Ok(StepNode {
            name,
            children,
            ..StepNode::default()
        })
    }

    /// Nodes of all features whose parent volume is this.
    fn features(&self, parent: Option<usize>) -> Result<Vec<StepNode>, ExportError> {
        let volumes = &self.realisation.volumes;
        let mut nodes: Vec<StepNode> = Vec::new();
        let mut features: Vec<&str> = Vec::new();
        for volume in volumes[1..].iter().filter(|volume| volume.parent == parent) {
            if !features.contains(&volume.feature.as_str()) {
                features.push(&volume.feature);
            }
        }
        let prefix = parent.map_or(String::new(), |parent| format!("{}/", volumes[parent].name));
        for feature in features {
            let mut instances = Vec::new();
            for (volume, rules) in volumes.iter().enumerate().skip(1) {
                if rules.parent == parent && rules.feature == *feature {
                    instances.extend(self.volume(volume)?);
                }
            }
            if instances.len() > 1 {
                let name = format!("{prefix}{feature}");
                nodes.push(StepNode {
                    name,
                    children: instances,
                    ..StepNode::default()
                });
            } else {
                nodes.extend(instances);
            }
        }
        Ok(nodes)
    }

    /// A volume with its children, or nothing if none of them has a solid.
    fn volume(&self, volume: usize) -> Result<Option<StepNode>, ExportError> {
        let leaf = self.leaf(volume)?;
        let children = self.features(Some(volume))?;
        if children.is_empty() {
            return Ok(leaf);
        }
        let name = format!("{} with children", self.realisation.volumes[volume].name);
        let children = leaf.into_iter().chain(children).collect();
        Ok(Some(StepNode {
            name,
            children,
            ..StepNode::default()
        }))
    }

    /// The volume's own part, or nothing if it has no solid.
    fn leaf(&self, volume: usize) -> Result<Option<StepNode>, ExportError> {
        let shapes = (self.part)(volume)?;
        if shapes.is_empty() {
            return Ok(None);
        }
        let rules = &self.realisation.volumes[volume];
        let facies = facies_of(self.model, &rules.facies);
        let part = |name: String, shapes| StepNode {
            name,
            color: facies.map(color),
            layer: Some(ascii(&rules.facies)),
            description: facies.map(description),
            shapes,
            children: Vec::new(),
        };
        if shapes.len() == 1 {
            return Ok(Some(part(rules.name.clone(), shapes)));
        }
        // Each piece is a part: FreeCAD, build123d and cadquery lose the colour of a part of several solids.
        let names = solid_names(&rules.name, shapes.len());
        let pieces = names.into_iter().zip(shapes);
        Ok(Some(StepNode {
            name: rules.name.clone(),
            description: facies.map(description),
            children: pieces
                .map(|(name, shape)| part(name, vec![shape]))
                .collect(),
            ..StepNode::default()
        }))
    }
}

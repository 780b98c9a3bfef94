//! The tree of parts that a model becomes, with the colours and rock properties of their facies.

use super::document::{Content, Node};
use crate::export::report::solid_names;
use crate::export::text::ascii;
use crate::model::realisation::Realisation;
use crate::model::rules::VolumeRules;
use crate::model::{Facies, Model, Property};

/// Builds the tree of parts: the background, then a node for each feature with several instances, and
/// for each volume that has children.
pub(super) struct Tree<'a> {
    pub(super) model: &'a Model,
    pub(super) realisation: &'a Realisation,
    /// The shapes of a volume's pieces.
    pub(super) pieces: &'a dyn Fn(usize) -> Vec<usize>,
}

/// A product of products.
pub(super) fn group(name: String, nodes: Vec<Node>) -> Node {
    Node {
        name,
        color: None,
        layer: None,
        description: None,
        content: Content::Nodes(nodes),
    }
}

impl Tree<'_> {
    pub(super) fn root(&self) -> Node {
        let volumes = &self.realisation.volumes;
        let mut name = ascii(&self.model.name);
        // Names are unique in the file, the root's included.
        while volumes
            .iter()
            .any(|volume| volume.name == name || volume.feature == name)
        {
            name.push_str(" model");
        }
        let mut children: Vec<Node> = self.leaf(0).into_iter().collect();
        children.extend(self.features(None));
        group(name, children)
    }

    /// Nodes of all features whose volumes lie in this one, or go along it.
    fn features(&self, parent: Option<usize>) -> Vec<Node> {
        let volumes = &self.realisation.volumes;
        let mut nodes: Vec<Node> = Vec::new();
        let mut features: Vec<&str> = Vec::new();
        let is_with = |volume: &VolumeRules| volume.along.or(volume.parent) == parent;
        for volume in volumes[1..].iter().filter(|volume| is_with(volume)) {
            if !features.contains(&volume.feature.as_str()) {
                features.push(&volume.feature);
            }
        }
        let prefix = parent.map_or(String::new(), |parent| format!("{}/", volumes[parent].name));
        for feature in features {
            let mut instances = Vec::new();
            for (volume, rules) in volumes.iter().enumerate().skip(1) {
                if is_with(rules) && rules.feature == *feature {
                    instances.extend(self.volume(volume));
                }
            }
            if instances.len() > 1 {
                nodes.push(group(format!("{prefix}{feature}"), instances));
            } else {
                nodes.extend(instances);
            }
        }
        nodes
    }

    /// A volume with its companions and children, or nothing if none of them has a solid.
    fn volume(&self, volume: usize) -> Option<Node> {
        let leaf = self.leaf(volume);
        let children = self.features(Some(volume));
        if children.is_empty() {
            return leaf;
        }
        let name = format!("{} with children", self.realisation.volumes[volume].name);
        Some(group(name, leaf.into_iter().chain(children).collect()))
    }

    /// The volume's own part, or nothing if it has no solid.
    fn leaf(&self, volume: usize) -> Option<Node> {
        let shapes = (self.pieces)(volume);
        if shapes.is_empty() {
            return None;
        }
        let rules = &self.realisation.volumes[volume];
        let facies = facies_of(self.model, &rules.facies);
        let part = |name: String, shape: usize| Node {
            name,
            color: facies.map(color),
            layer: Some(ascii(&rules.facies)),
            description: facies.map(description),
            content: Content::Shapes(vec![shape]),
        };
        if let [shape] = shapes[..] {
            return Some(part(rules.name.clone(), shape));
        }
        // Each piece is a part: FreeCAD, build123d and cadquery lose the colour of a part of several solids.
        let names = solid_names(&rules.name, shapes.len());
        let pieces = names.into_iter().zip(shapes);
        Some(Node {
            description: facies.map(description),
            ..group(
                rules.name.clone(),
                pieces.map(|(name, shape)| part(name, shape)).collect(),
            )
        })
    }
}

pub(super) fn facies_of<'a>(model: &'a Model, name: &str) -> Option<&'a Facies> {
    model.facies.iter().find(|facies| facies.name == name)
}

pub(super) fn color(facies: &Facies) -> [u8; 3] {
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

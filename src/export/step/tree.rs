//! The tree of parts that a model becomes, with the colours and rock properties of their facies.

use super::document::{Content, Node};
use crate::export::report::solid_names;
use crate::export::text::{ascii, one_line};
use crate::model::labels::feature_label;
use crate::model::properties::VolumeProperties;
use crate::model::realisation::Realisation;
use crate::model::rules::VolumeRules;
use crate::model::{Facies, Model};

/// Builds the tree of parts: the background, then a node for each feature with several instances, and
/// for each volume that has children.
pub(super) struct Tree<'a> {
    pub(super) model: &'a Model,
    pub(super) realisation: &'a Realisation,
    /// What volumes are called where people read, if that is not their name.
    pub(super) labels: Vec<Option<String>>,
    /// The shapes of a volume's pieces.
    pub(super) pieces: &'a dyn Fn(usize) -> Vec<usize>,
}

/// A product of products.
pub(super) fn group(name: String, nodes: Vec<Node>) -> Node {
    Node {
        name,
        label: None,
        color: None,
        layer: None,
        description: None,
        content: Content::Nodes(nodes),
    }
}

/// The same with what it is called where people read.
pub(super) fn labelled(node: Node, label: Option<&str>) -> Node {
    let label = label.map(one_line).filter(|label| *label != node.name);
    Node { label, ..node }
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
        let shown = one_line(&self.model.name);
        let label = (shown != ascii(&shown)).then_some(shown);
        labelled(group(name, children), label.as_deref())
    }

    /// What a volume is called where people read.
    fn label(&self, volume: usize) -> &str {
        let name = &self.realisation.volumes[volume].name;
        self.labels[volume].as_ref().unwrap_or(name)
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
                let above = parent.map_or("", |parent| self.label(parent));
                let label = feature_label(self.model, above, feature);
                let node = group(format!("{prefix}{feature}"), instances);
                nodes.push(labelled(node, Some(&label)));
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
        let with_children = |name: &str| format!("{name} with children");
        let name = with_children(&self.realisation.volumes[volume].name);
        let node = group(name, leaf.into_iter().chain(children).collect());
        Some(labelled(node, Some(&with_children(self.label(volume)))))
    }

    /// The volume's own part, or nothing if it has no solid.
    fn leaf(&self, volume: usize) -> Option<Node> {
        let shapes = (self.pieces)(volume);
        if shapes.is_empty() {
            return None;
        }
        let rules = &self.realisation.volumes[volume];
        let facies = facies_of(self.model, &rules.facies);
        let rock = &self.realisation.properties[volume];
        let description = |facies: &Facies| description(facies, rock);
        let label = self.labels[volume].as_deref();
        let part = |name: String, label: Option<String>, shape: usize| Node {
            name,
            label,
            color: facies.map(color),
            layer: Some(ascii(&rules.facies)),
            description: facies.map(&description),
            content: Content::Shapes(vec![shape]),
        };
        if let [shape] = shapes[..] {
            return Some(part(rules.name.clone(), label.map(one_line), shape));
        }
        // Each piece is a part: FreeCAD, build123d and cadquery lose the colour of a part of several solids.
        let count = shapes.len();
        let names = solid_names(&rules.name, count);
        let labels = label.map_or(vec![None; count], |label| {
            let labels = solid_names(label, count).into_iter();
            labels.map(Some).collect()
        });
        let pieces = names.into_iter().zip(labels).zip(shapes);
        let pieces = pieces.map(|((name, label), shape)| part(name, label, shape));
        let node = group(rules.name.clone(), pieces.collect());
        Some(Node {
            description: facies.map(&description),
            ..labelled(node, label)
        })
    }
}

pub(super) fn facies_of<'a>(model: &'a Model, name: &str) -> Option<&'a Facies> {
    model.facies.iter().find(|facies| facies.name == name)
}

pub(super) fn color(facies: &Facies) -> [u8; 3] {
    [facies.color.r, facies.color.g, facies.color.b]
}

/// `facies=sand; net=1; porosity=0.24; permeability_mD=600,600,120`; the six numbers of a tensor are xx, yy, zz, xy, yz, xz.
pub(super) fn description(facies: &Facies, rock: &VolumeProperties) -> String {
    let mut words = vec![format!("facies={}", ascii(&facies.name))];
    for (name, property) in &rock.values {
        let unit = if name == "permeability" { "_mD" } else { "" };
        let numbers: Vec<String> = property.numbers().iter().map(f64::to_string).collect();
        words.push(format!("{}{unit}={}", ascii(name), numbers.join(",")));
    }
    words.join("; ")
}

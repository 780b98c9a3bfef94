//! The checked model: what the program works with once a model file has been read.
//!
//! Lengths are metres, z points up, x east, y north. References between facies and features are indices into the model's
//! own lists, so they cannot dangle.

use super::domain::Domain;
use super::facies::Facies;
use super::kinds::FeatureKind;
use super::kinds::solid::SolidSpec;
use super::place::{Note, Place};
use super::references::{Host, Reference};
use super::stratum::Stratum;
use super::values::conform::ConformSpec;
use super::values::property::PropertySpec;
use super::values::selector::Selector;
use super::values::surface::FileSurface;
use super::wells::spec::{TopSpec, WellSpec};

/// A checked model.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// What the model is called.
    pub name: String,
    /// A sentence or two about it.
    pub description: Option<String>,
    /// The seed of all draws.
    pub seed: u64,
    /// Its place in a Latin hypercube of realisations, if its draws are stratified.
    pub stratum: Option<Stratum>,
    /// Where the local origin lies in the world: recorded, and subtracted from files of heights; never added to the model's coordinates.
    pub origin: [f64; 3],
    /// The block that is modelled.
    pub domain: Domain,
    /// The facies, in file order.
    pub facies: Vec<Facies>,
    /// The features from oldest to youngest, in file order.
    pub features: Vec<Feature>,
    /// The wells, each followed by its laterals.
    pub wells: Vec<WellSpec>,
    /// Horizons picked in them.
    pub tops: Vec<TopSpec>,
    /// What is worth saying about the file although it is right.
    pub notes: Vec<Note>,
}

/// One entry of the feature list: one geological thing, or `count` alike.
#[derive(Clone, Debug, PartialEq)]
pub struct Feature {
    /// Its id, unique in the model.
    pub id: String,
    /// What it is called where people read; its id if absent.
    pub title: Option<String>,
    /// What it is.
    pub kind: FeatureKind,
    /// Whether it takes part.
    pub enabled: bool,
    /// How many instances are made (per instance of the parent).
    pub count: usize,
    /// Hierarchical level, 1 = largest.
    pub level: u32,
    /// Index of the parent; of a companion, that of what it goes along.
    pub parent: Option<usize>,
    /// Of a companion: index of the feature that it goes along.
    pub along: Option<usize>,
    /// Index of the facies of what it bounds.
    pub facies: usize,
    /// Rock properties of its own volumes, in the place of those of its facies.
    pub properties: Vec<(String, PropertySpec)>,
    /// What it may remove.
    pub removes: Selector,
    /// What may remove it.
    pub removed_by: Selector,
    /// Whether it removes nothing but its parent and the background.
    pub preserve: bool,
    /// What it conforms to by itself, not with what it lies in.
    pub conform: Option<ConformSpec>,
    /// Where the file defines it.
    pub place: Place,
}

impl Model {
    /// The surfaces and thicknesses that come from files, with whose they are: the domain's base and top, then those of features in their order.
    pub fn files(&self) -> impl Iterator<Item = (&str, &FileSurface)> {
        let bounds = [
            ("domain.base", &self.domain.base),
            ("domain.top", &self.domain.top),
        ];
        let bounds = bounds
            .into_iter()
            .filter_map(|(name, surface)| Some((name, surface.as_ref()?)));
        let bases = self.features.iter().filter_map(|feature| {
            let base = feature.kind.base()?;
            Some((feature.id.as_str(), base.surface))
        });
        bounds
            .chain(bases)
            .filter_map(|(name, surface)| Some((name, surface.file()?)))
    }
}

impl Model {
    /// The solids that come from files, with the features that they are.
    pub fn solids(&self) -> impl Iterator<Item = (&str, &SolidSpec)> {
        self.features
            .iter()
            .filter_map(|feature| match &feature.kind {
                FeatureKind::Solid(solid) => Some((feature.id.as_str(), solid)),
                _ => None,
            })
    }
}

impl Feature {
    /// What it is made by, besides its host.
    pub(crate) fn refers(&self) -> Vec<&Reference> {
        let conform = self.conform.iter().map(|conform| &conform.to);
        self.kind.refers().into_iter().chain(conform).collect()
    }

    /// What it goes with, of which each instance has its own; nothing of what goes with the model as a whole.
    pub fn host(&self) -> Option<Host> {
        match (self.along, self.parent) {
            (Some(along), _) => Some(Host::Along(along)),
            (None, parent) => parent.map(Host::In),
        }
    }
}

//! What checks have at hand: the tree with its defects, notes, and where the model lies in the world.

pub(crate) mod files;
pub(crate) mod world;

use std::cell::RefCell;
use std::path::PathBuf;

use super::defects::Text;
use super::domain::Domain;
use super::place::{Note, Place};
use super::read::Reader;
use super::references::Reference;
use super::solids::SolidReader;
use super::tree::NodeId;

/// A value is wrong, and the defect is reported: what [`Option`] cannot say of a key that may be left out.
pub(crate) struct Reported;

/// Reads a model and gathers what is wrong with it, or worth saying.
pub(crate) struct Checker<'t> {
    pub(crate) reader: Reader<'t>,
    pub(crate) texts: &'t [Text],
    pub(crate) notes: Vec<Note>,
    /// What features refer to, as far as it is read.
    pub(crate) referring: RefCell<Vec<Referring>>,
    /// Where the local origin lies in the world, as far as it is known.
    pub(crate) origin: [f64; 3],
    /// Where the paths of files begin.
    pub(crate) folder: PathBuf,
    /// Reads solids of CAD programs.
    pub(crate) solids: Option<SolidReader>,
}

/// A reference with its place.
pub(crate) struct Referring {
    /// The feature that refers to another one.
    pub(crate) own: usize,
    pub(crate) node: NodeId,
    /// What refers to it, in words.
    pub(crate) what: String,
    pub(crate) reference: Reference,
}

/// The domain's limits, as far as they are known.
#[derive(Clone, Copy, Default)]
pub(crate) struct Extent {
    pub(crate) x: Option<[f64; 2]>,
    pub(crate) y: Option<[f64; 2]>,
    pub(crate) z: Option<[f64; 2]>,
}

impl From<Option<&Domain>> for Extent {
    fn from(domain: Option<&Domain>) -> Self {
        domain.map_or(Self::default(), |domain| Self {
            x: Some(domain.x),
            y: Some(domain.y),
            z: Some(domain.z),
        })
    }
}

impl Checker<'_> {
    /// A range that has nothing between its ends is a defect.
    pub(crate) fn no_range(
        &self,
        node: NodeId,
        what: &str,
        [low, high]: [f64; 2],
        remedy: &'static str,
    ) {
        let problem = if high < low {
            "the wrong way round"
        } else {
            "empty"
        };
        self.reader.wrong(
            node,
            format!("{what} from {low} to {high} is {problem}"),
            remedy,
        );
    }

    pub(crate) fn place(&self, node: NodeId) -> Place {
        let span = self.reader.tree.span(node);
        self.texts
            .get(span.text)
            .map(|text| text.place(span.start))
            .unwrap_or_default()
    }

    pub(crate) fn note(&mut self, node: NodeId, message: impl Into<String>) {
        let place = self.place(node);
        self.notes.push(Note {
            message: message.into(),
            place,
        });
    }
}

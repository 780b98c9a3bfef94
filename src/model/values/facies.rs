//! References to facies by name, and what may stand in names.

use std::collections::BTreeMap;

use crate::model::checker::Checker;
use crate::model::facies::Facies;
use crate::model::suggest;
use crate::model::tree::{NodeId, quoted};

/// The facies of the file: their names are known even where they are broken, so references can be judged.
pub(crate) struct FaciesList {
    pub(crate) names: Vec<String>,
    pub(crate) index: BTreeMap<String, usize>,
    pub(crate) nodes: Vec<NodeId>,
    pub(crate) read: Vec<Option<Facies>>,
    pub(crate) whole: bool,
}

impl FaciesList {
    pub(crate) fn finished(self) -> Option<Vec<Facies>> {
        self.whole
            .then(|| self.read.into_iter().collect::<Option<Vec<_>>>())
            .flatten()
    }

    pub(crate) fn find(&self, name: &str) -> Option<usize> {
        self.index.get(name).copied()
    }

    pub(crate) fn names(&self) -> Vec<&str> {
        self.names.iter().map(String::as_str).collect()
    }
}

impl Checker<'_> {
    /// The facies of that name; where there is none, a defect.
    pub(crate) fn known_facies(
        &self,
        node: NodeId,
        name: &str,
        facies: &FaciesList,
    ) -> Option<usize> {
        let found = facies.find(name);
        if found.is_none() {
            self.reader.wrong(
                node,
                format!("there is no facies {}", quoted(name)),
                self.reader
                    .hint(|| suggest::name(name, &facies.names(), "facies")),
            );
        }
        found
    }
}

/// Whether a name may stand in the names of volumes.
pub(crate) fn is_id(name: &str) -> bool {
    !name.is_empty()
        && name
            .chars()
            .all(|c| c.is_ascii_alphanumeric() || c == '-' || c == '_')
}

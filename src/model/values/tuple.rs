//! Lists of a fixed number of quantities: semi-axes, points.

use super::limits::Limits;
use super::quantity::{Quantity, quantity};
use crate::model::read::Reader;
use crate::model::tree::NodeId;

/// What a list of quantities holds.
pub(crate) struct Tuple<'a, const N: usize> {
    /// What it is of, as `the semi_axes of feature "nodule"`.
    pub(crate) what: String,
    /// What its entries are called.
    pub(crate) names: [&'a str; N],
    pub(crate) limits: Limits,
    pub(crate) remedy: &'a str,
}

impl<const N: usize> Tuple<'_, N> {
    pub(crate) fn read(&self, reader: &Reader<'_>, node: NodeId) -> Option<[Quantity; N]> {
        let elements: Result<[NodeId; N], _> = reader.tree.elements(node).try_into();
        let Ok(elements) = elements else {
            let number = if N == 2 { "two" } else { "three" };
            reader.wrong(
                node,
                format!(
                    "expected a list of {number} for {}, found {}",
                    self.what,
                    reader.tree.describe(node)
                ),
                self.remedy,
            );
            return None;
        };
        // All are looked at before the first wrong one ends it.
        let found: Vec<Option<Quantity>> = elements
            .iter()
            .zip(self.names)
            .map(|(&element, name)| {
                let what = format!("the {name} of {}", self.what);
                quantity(reader, element, &what, self.limits)
            })
            .collect();
        let found: Vec<Quantity> = found.into_iter().collect::<Option<_>>()?;
        found.try_into().ok()
    }
}

//! Validity, in words.

use crate::error::{BridgeError, from_kernel};
use crate::ffi::bridge;
use crate::solids::Solids;
use crate::threads::Threads;

/// Something wrong with a solid.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Defect {
    /// Index into [`Solids::solids`]; `None` if no single solid is to blame.
    pub solid: Option<usize>,
    /// What the kernel's checker says of its sub-shapes.
    pub what: String,
}

/// Everything that the kernel's checker finds wrong, solid by solid; what two solids share is checked once. An empty list is necessary,
/// not sufficient: a partition that lost volume passes.
pub fn defects(solids: &Solids, threads: Threads) -> Result<Vec<Defect>, BridgeError> {
    let found = bridge::find_defects(&solids.handle, threads.parallel())
        .map_err(|e| from_kernel("checking solids", &e))?;
    Ok(found
        .into_iter()
        .map(|d| Defect {
            solid: (d.solid < solids.solids().len()).then_some(d.solid),
            what: d.what,
        })
        .collect())
}

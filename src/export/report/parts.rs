//! What a report is made of, and what it calls a volume's solids.

use crate::assembly::Assembly;
use crate::assembly::proof::Level;
use crate::export::wells::entries::WellEntry;
use crate::model::Model;
use crate::model::plan::AssemblyPlan;
use crate::model::realisation::Realisation;

/// What a report is made of.
#[derive(Clone, Copy)]
pub struct Parts<'a> {
    /// The model.
    pub model: &'a Model,
    /// Its realisation.
    pub realisation: &'a Realisation,
    /// The plan.
    pub plan: &'a AssemblyPlan,
    /// The assembly.
    pub assembly: &'a Assembly,
    /// What its wells pass through.
    pub wells: &'a [WellEntry],
    /// How thorough its proof was.
    pub level: Level,
    /// Whether to tell between what the permeability of many volumes as a whole lies.
    pub with_bounds: bool,
}

/// The names of a volume's solids: its own, numbered if there are several.
pub fn solid_names(name: &str, count: usize) -> Vec<String> {
    if count == 1 {
        return vec![name.to_owned()];
    }
    (1..=count)
        .map(|number| format!("{name}#{number}"))
        .collect()
}

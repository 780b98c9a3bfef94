//! Models that are assembled and proven in full, for tests that measure their volumes.
#![allow(
    dead_code,
    unreachable_pub,
    clippy::unwrap_used,
    clippy::panic,
    reason = "shared by several test programs, none of which needs all of it; a test fails by panicking"
)]

mod checked;
#[macro_use]
mod straight;

use clinothem::assembly::{self, Assembly, AssemblyError, Cancel, Engine, Options, Subject, proof};
use clinothem::model::Model;
use clinothem::model::owner::Owners;
use clinothem::model::plan::AssemblyPlan;
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;

#[allow(unused_imports, reason = "not every test program needs all of it")]
pub use checked::*;
#[allow(unused_imports, reason = "not every test program needs all of it")]
pub use straight::{MEANDER, WIDER};

/// The whole of a model, as this engine makes it.
pub fn built(text: &str, overrides: &[&str], engine: Engine) -> Built {
    Built::new(from_text(text, overrides), &Selection::default(), engine).unwrap()
}

/// A model with its solids.
pub struct Built {
    pub model: Model,
    pub realisation: Realisation,
    pub owners: Owners,
    pub plan: AssemblyPlan,
    pub assembly: Assembly,
}

impl Built {
    pub fn new(model: Model, selection: &Selection, engine: Engine) -> Result<Self, AssemblyError> {
        let options = Options {
            engine,
            child: None,
            threads: 0,
            proof: proof::Level::Full,
            seed: model.seed,
        };
        Self::with(model, selection, &options)
    }

    pub fn with(
        model: Model,
        selection: &Selection,
        options: &Options,
    ) -> Result<Self, AssemblyError> {
        let realisation = Realisation::new(&model, selection).unwrap();
        let subject = Subject::new(realisation).unwrap();
        let again = |step: f64| Realisation::by_age(&model, selection, step);
        let (subject, assembly) =
            assembly::assemble(subject, &again, options, &Cancel::new(), &|_, _| ())?;
        let Subject {
            realisation,
            plan,
            owners,
        } = subject;
        Ok(Self {
            model,
            realisation,
            owners,
            plan,
            assembly,
        })
    }

    pub fn volume(&self, name: &str) -> usize {
        let volume = self.realisation.volume(name);
        volume.unwrap_or_else(|| panic!("no volume {name}"))
    }

    pub fn size(&self, name: &str) -> f64 {
        self.assembly.measured.size_of(self.volume(name))
    }

    pub fn pieces(&self, name: &str) -> usize {
        self.assembly.measured.pieces_of(self.volume(name)).len()
    }

    /// Area shared by two volumes (m²).
    pub fn contact(&self, a: &str, b: &str) -> f64 {
        let (a, b) = (self.volume(a), self.volume(b));
        let contact = self.assembly.measured.contacts.get(&(a.min(b), a.max(b)));
        contact.copied().unwrap_or(0.0)
    }

    pub fn solids(&self) -> usize {
        self.assembly.measured.pieces.len()
    }
}

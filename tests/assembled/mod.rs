//! Models that are assembled and proven in full, for tests that measure their volumes.
#![allow(
    dead_code,
    unreachable_pub,
    clippy::unwrap_used,
    clippy::panic,
    reason = "shared by several test programs, none of which needs all of it; a test fails by panicking"
)]

use std::path::Path;

use clinothem::assembly::{self, Assembly, AssemblyError, Cancel, Engine, Options, proof};
use clinothem::model::owner::Owners;
use clinothem::model::plan::AssemblyPlan;
use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use clinothem::model::{Model, Source};

/// A model with its solids.
pub struct Built {
    pub model: Model,
    pub realisation: Realisation,
    pub owners: Owners,
    pub assembly: Assembly,
}

/// A committed model's text; `name` is its path within `models`, without its ending.
pub fn source(name: &str) -> Source {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("models")
        .join(name)
        .with_extension("toml");
    Source::read(path).unwrap()
}

pub fn checked(source: &Source) -> Model {
    Model::check(source).unwrap_or_else(|defects| panic!("{defects}"))
}

pub fn without(ids: &[&str]) -> Selection {
    Selection {
        without: ids.iter().map(ToString::to_string).collect(),
        max_level: None,
    }
}

impl Built {
    pub fn new(model: Model, selection: &Selection, engine: Engine) -> Result<Self, AssemblyError> {
        let realisation = Realisation::new(&model, selection).unwrap();
        let owners = Owners::new(&realisation).unwrap();
        let plan = AssemblyPlan::new(&realisation).unwrap();
        let options = Options {
            engine,
            child: None,
            threads: 0,
            proof: proof::Level::Full,
            seed: model.seed,
        };
        let assembly = assembly::assemble(&plan, &owners, &options, &Cancel::new(), &|_, _| ())?;
        Ok(Self {
            model,
            realisation,
            owners,
            assembly,
        })
    }

    pub fn volume(&self, name: &str) -> usize {
        self.realisation.volume(name).unwrap()
    }

    pub fn size(&self, name: &str) -> f64 {
        self.assembly.measured.size_of(self.volume(name))
    }

    pub fn pieces(&self, name: &str) -> usize {
        self.assembly.measured.pieces_of(self.volume(name)).len()
    }

    pub fn solids(&self) -> usize {
        self.assembly.measured.pieces.len()
    }
}

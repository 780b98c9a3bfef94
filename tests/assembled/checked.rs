//! Models from files and texts, checked; no kernel is needed.
#![allow(
    dead_code,
    unreachable_pub,
    clippy::unwrap_used,
    clippy::panic,
    reason = "shared by several test programs, none of which needs all of it; a test fails by panicking"
)]

use std::path::Path;

use clinothem::model::selection::Selection;
use clinothem::model::{Format, Model, Source};

/// A committed model's text; `name` is its path within `models`, without its ending.
pub fn source(name: &str) -> Source {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("models")
        .join(name)
        .with_extension("toml");
    Source::read(path).unwrap()
}

pub fn checked(source: &Source) -> Model {
    let source = source.clone();
    #[cfg(feature = "occt")]
    let source = source.with_solids(clinothem::assembly::read_solid);
    Model::check(&source).unwrap_or_else(|defects| panic!("{defects}"))
}

/// A model with overrides.
pub fn from_text(text: &str, overrides: &[&str]) -> Model {
    let mut source = Source::from_text("test.toml", text, Format::Toml);
    for one in overrides {
        source.set(*one);
    }
    checked(&source)
}

pub fn without(ids: &[&str]) -> Selection {
    Selection {
        without: ids.iter().map(ToString::to_string).collect(),
        max_level: None,
    }
}

//! The committed models are right, and mean what their text says.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod bodies;
mod committed;
mod notes;
mod reference;
mod strata;

use clinothem::model::{Defects, Format, Model, Source};

const GOOD: &str = include_str!("../bad_models/good.toml");
const FULL: &str = include_str!("../bad_models/full.toml");
const SHOREFACE: &str = include_str!("../bad_models/shoreface.toml");

fn check(text: &str, overrides: &[&str]) -> Result<Model, Defects> {
    let mut source = Source::from_text("model.toml", text, Format::Toml);
    for assignment in overrides {
        source.set(*assignment);
    }
    Model::check(&source)
}

//! A channel belt with as many channels as asked for; what the benchmarks have in common.

use std::error::Error;

use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use clinothem::model::{Format, Model, Source};

/// Reads a model file, sets the number of its channels and makes their control nets.
pub(crate) fn realise(path: &str, count: u32) -> Result<(Model, Realisation), Box<dyn Error>> {
    let text = std::fs::read_to_string(path)?;
    let mut source = Source::from_text(path, &text, Format::Toml);
    source.set(format!("feature.channel.count={count}"));
    let model = Model::check(&source).map_err(|defects| defects.to_string())?;
    let realisation = Realisation::new(&model, &Selection::default())?;
    Ok((model, realisation))
}

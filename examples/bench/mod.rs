//! A model with settings, as `--set` makes them; what the benchmarks have in common.

use std::error::Error;

use clinothem::model::realisation::Realisation;
use clinothem::model::selection::Selection;
use clinothem::model::{Format, Model, Source};

/// Reads a model file, sets what the settings say (`feature.channel.count=5`) and makes the control nets.
pub(crate) fn realise(
    path: &str,
    settings: impl Iterator<Item = String>,
) -> Result<(Model, Realisation), Box<dyn Error>> {
    let text = std::fs::read_to_string(path)?;
    let mut source = Source::from_text(path, &text, Format::Toml);
    for setting in settings {
        source.set(setting);
    }
    let model = Model::check(&source).map_err(|defects| defects.to_string())?;
    let realisation = Realisation::new(&model, &Selection::default())?;
    Ok((model, realisation))
}

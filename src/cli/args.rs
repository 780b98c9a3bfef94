//! Arguments that several commands share.

use std::path::PathBuf;

use crate::model::Stratum;
use crate::model::selection::Selection;

/// The model and what is changed in it for this run.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct ModelArgs {
    /// The model file (TOML, or JSON if its name ends in .json); - reads it from standard input.
    #[arg(value_name = "MODEL")]
    pub(super) model: PathBuf,
    /// Draw with this seed instead of the model's.
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(super) seed: Option<u64>,
    /// Draw as one realisation of a Latin hypercube: 3/100 is the third of a hundred, whose first one has the seed two below.
    #[arg(long, value_name = "K/N")]
    pub(super) stratum: Option<Stratum>,
    /// Override a value of the model file: feature.channel.width=30, domain.z=[-80,0]; repeatable.
    #[arg(long, value_name = "KEY=VALUE")]
    pub(super) set: Vec<String>,
    /// Take values from a JSON file of parameters, as ERT writes it: {"feature.channel.width": 30}, {"NAME": {"value": 30}} and groups of
    /// them; names are keys as those of --set, which wins.
    #[arg(long, value_name = "FILE")]
    pub(super) parameters: Option<PathBuf>,
    /// Which keys the parameters are: a TOML file of NAME = "feature.channel.width", or a list of keys; other parameters are left alone.
    #[arg(long, value_name = "FILE", requires = "parameters")]
    pub(super) parameter_names: Option<PathBuf>,
    /// Leave out a feature (channel) or a volume (channel-3; a clinothem, shore/lower-2; a belt of it, shore/lower-2/distal), with its
    /// children; repeatable. What lies in only one place needs no path: lower-2. What it would hold goes to what is older.
    #[arg(long, value_name = "ID", num_args = 1..)]
    pub(super) without: Vec<String>,
    /// Leave out levels deeper than this (1 = largest).
    #[arg(long, value_name = "LEVEL", allow_negative_numbers = true)]
    pub(super) max_level: Option<u32>,
}

impl ModelArgs {
    pub(super) fn selection(&self) -> Selection {
        Selection {
            without: self.without.clone(),
            max_level: self.max_level,
        }
    }

    /// Whether the model comes from standard input.
    pub(super) fn is_standard_input(&self) -> bool {
        self.model.as_os_str() == "-"
    }

    /// The model file's name without folder and ending: the base of output names.
    pub(super) fn stem(&self) -> String {
        if self.is_standard_input() {
            return "model".to_owned();
        }
        self.model.file_stem().map_or_else(
            || "model".to_owned(),
            |stem| stem.to_string_lossy().into_owned(),
        )
    }
}

/// The largest number, as in model files.
const LARGEST: f64 = 1e9;

/// Reads `1,2` or `1,2,3` as numbers.
pub(super) fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    let wrong = || format!("`{text}` is not {N} numbers separated by commas");
    let values: Vec<f64> = parts
        .iter()
        .map(|part| part.parse().map_err(|_| wrong()))
        .collect::<Result<_, _>>()?;
    let values: [f64; N] = values.try_into().map_err(|_| wrong())?;
    if !values.iter().all(|value: &f64| value.is_finite()) {
        return Err(wrong());
    }
    match values.iter().find(|value| value.abs() > LARGEST) {
        Some(value) => Err(format!(
            "the number {value:e} is beyond {LARGEST:e}; lengths are in metres, check the digits"
        )),
        None => Ok(values),
    }
}

/// Reads a finite number.
pub(super) fn finite(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if value.is_finite() => numbers::<1>(text).map(|[value]| value),
        _ => Err(format!("`{text}` is not a finite number")),
    }
}

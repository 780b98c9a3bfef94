//! Random models over the whole model language, as TOML tables.
#![allow(unreachable_pub, reason = "shared with tests/scale.rs")]

mod bodies;
mod coincident;
mod draws;
mod generic;
mod strata;
mod tables;
mod ways;
mod wells;

use std::str::FromStr;

use toml::Table;

use draws::Draws;
pub use tables::number;
pub use ways::{Way, changed};

/// What models are made to be hard for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Everything that the language has, and no two numbers that are equal by design.
    Generic,
    /// What people write first: round numbers, symmetry, things that touch.
    Coincident,
    /// Horizons interpolated from wells: nearly parallel, and crossing.
    WellTops,
}

impl FromStr for Kind {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        match word {
            "generic" => Ok(Self::Generic),
            "coincident" => Ok(Self::Coincident),
            "well-tops" => Ok(Self::WellTops),
            _ => Err(format!(
                "there is no kind `{word}`; there are generic, coincident and well-tops"
            )),
        }
    }
}

/// The model of a kind and a seed; a plain one leaves no draw to the program.
pub fn model(kind: Kind, seed: u64, plain: bool) -> Table {
    let salt = match kind {
        Kind::Generic => 1,
        Kind::Coincident => 2,
        Kind::WellTops => 3,
    };
    let mut draws = Draws::new(seed, salt, plain);
    let mut model = match kind {
        Kind::Generic => generic::model(&mut draws),
        Kind::Coincident => coincident::model(&mut draws),
        Kind::WellTops => wells::model(&mut draws),
    };
    let name = format!("{kind:?} {seed}");
    model.insert("name".to_owned(), name.into());
    model
}

//! Random models over the whole model language, as TOML tables.
#![allow(unreachable_pub, reason = "shared with tests/scale.rs")]

mod bodies;
mod coincident;
mod draws;
mod faulted;
mod generic;
mod referring;
mod sedimentary;
mod strata;
mod tables;
mod ways;
mod wells;

use std::str::FromStr;

use toml::{Table, Value};

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
    /// What lies in channels and along them, scours, lobes, clinoforms and nets of one's own.
    Sedimentary,
    /// The same in round numbers: channels with children that cross, meet and follow each other.
    RoundSedimentary,
    /// Features that refer to others, and horizons from control nets.
    Referring,
    /// A conjugate pair of faults through beds and bodies.
    Faulted,
    /// The same in round numbers: throws as thick as beds are, faults through corners.
    RoundFaulted,
    /// Beds and bodies that a fold bends, overhanging or not.
    Folded,
}

impl FromStr for Kind {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        match word {
            "generic" => Ok(Self::Generic),
            "coincident" => Ok(Self::Coincident),
            "well-tops" => Ok(Self::WellTops),
            "sedimentary" => Ok(Self::Sedimentary),
            "round-sedimentary" => Ok(Self::RoundSedimentary),
            "referring" => Ok(Self::Referring),
            "faulted" => Ok(Self::Faulted),
            "round-faulted" => Ok(Self::RoundFaulted),
            "folded" => Ok(Self::Folded),
            _ => Err(format!(
                "there is no kind `{word}`; there are generic, coincident, well-tops, sedimentary, round-sedimentary, referring, faulted, round-faulted and folded"
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
        Kind::Sedimentary => 4,
        Kind::RoundSedimentary => 5,
        Kind::Referring => 6,
        Kind::Faulted => 7,
        Kind::RoundFaulted => 8,
        Kind::Folded => 9,
    };
    let mut draws = Draws::new(seed, salt, plain);
    let mut model = match kind {
        Kind::Generic => generic::model(&mut draws),
        Kind::Coincident => coincident::model(&mut draws),
        Kind::WellTops => wells::model(&mut draws),
        Kind::Sedimentary => sedimentary::model(&mut draws),
        Kind::RoundSedimentary => sedimentary::round(&mut draws),
        Kind::Referring => referring::model(&mut draws),
        Kind::Faulted => faulted::model(&mut draws),
        Kind::RoundFaulted => faulted::round(&mut draws),
        Kind::Folded => faulted::folded(&mut draws),
    };
    let name = format!("{kind:?} {seed}");
    model.insert("name".to_owned(), name.into());
    model
}

/// The model without features of kinds that a program does not have, and without what names these.
#[allow(dead_code, reason = "a test of units shares these models")]
pub fn limited(mut model: Table, kinds: &[&str]) -> Table {
    let Some(features) = model.get_mut("feature").and_then(Value::as_array_mut) else {
        return model;
    };
    let mut left_out: Vec<Value> = Vec::new();
    features.retain(|feature| {
        let word = |key: &str| feature.get(key).and_then(Value::as_str);
        let is_known = word("kind").is_some_and(|kind| kinds.contains(&kind));
        let hosts = ["parent", "along"].map(|key| feature.get(key));
        let is_left = hosts
            .into_iter()
            .flatten()
            .any(|host| left_out.contains(host));
        if is_known && !is_left {
            return true;
        }
        left_out.extend(feature.get("id").cloned());
        false
    });
    model
}

//! Members: what each realisation of an ensemble is made of.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::model::Stratum;

/// What is changed in a model, as arguments of the program say it.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Changes {
    /// Overrides, as `feature.channel.width=30`.
    pub set: Vec<String>,
    /// What is left out.
    pub without: Vec<String>,
    /// Levels deeper than this are left out.
    pub max_level: Option<u32>,
}

impl Changes {
    /// These, and then others: of overrides of one key the later ones win.
    #[must_use]
    pub fn and(&self, more: &Self) -> Self {
        let mut all = self.clone();
        all.set.extend(more.set.iter().cloned());
        all.without.extend(more.without.iter().cloned());
        // Both leave out what is deeper than theirs.
        all.max_level = match (self.max_level, more.max_level) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
        all
    }

    fn arguments(&self) -> Vec<String> {
        let set = self.set.iter().map(|text| format!("--set={text}"));
        let without = self.without.iter().map(|id| format!("--without={id}"));
        let level = self.max_level.map(|level| format!("--max-level={level}"));
        set.chain(without).chain(level).collect()
    }
}

/// A variant of the model: the realisations of each are drawn with the same seeds.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Scenario {
    /// What it is called: letters, digits, `-` and `_`.
    pub name: String,
    /// What is changed in it.
    pub changes: Changes,
}

/// One realisation of an ensemble.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Member {
    /// Its number in its scenario, from 1.
    pub number: usize,
    /// Its scenario, if there are any.
    pub scenario: Option<String>,
    /// The seed of its draws.
    pub seed: u64,
    /// Its place in a Latin hypercube.
    pub stratum: Option<Stratum>,
    /// What a design table says of it: keys of the model and their values.
    pub design: Vec<(String, String)>,
    /// All that is changed in the model, the design included.
    pub changes: Changes,
}

impl Member {
    /// The name of its folder below that of the realisations: `0012`, or `thin/0012` in a scenario.
    pub fn name(&self) -> String {
        match &self.scenario {
            Some(scenario) => format!("{scenario}/{:04}", self.number),
            None => format!("{:04}", self.number),
        }
    }

    /// The arguments that make it with any command that reads a model.
    pub fn arguments(&self) -> Vec<String> {
        let seed = format!("--seed={}", self.seed);
        let stratum = self.stratum.map(|stratum| format!("--stratum={stratum}"));
        let first = std::iter::once(seed).chain(stratum);
        first.chain(self.changes.arguments()).collect()
    }

    /// What tells its realisation from every other one: the SHA-256 of its arguments and of `common`, which says what all members
    /// share.
    pub fn key(&self, common: &str) -> String {
        let mut hash = Sha256::new();
        for text in std::iter::once(common.to_owned()).chain(self.arguments()) {
            hash.update((text.len() as u64).to_le_bytes());
            hash.update(text.as_bytes());
        }
        hexadecimal(&hash.finalize())
    }
}

/// The SHA-256 of some bytes, in hexadecimal.
pub fn digest(bytes: &[u8]) -> String {
    hexadecimal(&Sha256::digest(bytes))
}

/// Bytes in hexadecimal.
pub(super) fn hexadecimal(bytes: &[u8]) -> String {
    use std::fmt::Write as _;
    bytes.iter().fold(String::new(), |mut text, byte| {
        // Writing to a text cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}

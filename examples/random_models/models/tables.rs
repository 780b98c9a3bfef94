//! TOML tables, and the block that a model fills.

use toml::{Table, Value};

pub(super) fn table<const N: usize>(entries: [(&str, Value); N]) -> Table {
    entries
        .into_iter()
        .map(|(key, value)| (key.to_owned(), value))
        .collect()
}

/// A feature with what every feature has.
pub(super) fn feature(id: &str, kind: &str, facies: &str) -> Table {
    table([
        ("id", id.into()),
        ("kind", kind.into()),
        ("facies", facies.into()),
    ])
}

pub(super) fn set(table: &mut Table, key: &str, value: impl Into<Value>) {
    table.insert(key.to_owned(), value.into());
}

/// The block that is modelled.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    pub(super) x: [f64; 2],
    pub(super) y: [f64; 2],
    pub(super) z: [f64; 2],
}

impl Block {
    pub(super) fn size(&self) -> [f64; 3] {
        [self.x, self.y, self.z].map(|[low, high]| high - low)
    }

    /// The shorter of its sides in plan.
    pub(super) fn narrow(&self) -> f64 {
        let [x, y, _] = self.size();
        x.min(y)
    }

    /// The diagonal of its plan.
    pub(super) fn across(&self) -> f64 {
        let [x, y, _] = self.size();
        x.hypot(y)
    }

    /// The place in plan at fractions of its sides.
    pub(super) fn at(&self, u: f64, v: f64) -> [f64; 2] {
        let [x, y, _] = self.size();
        [self.x[0] + u * x, self.y[0] + v * y]
    }

    pub(super) fn elevation(&self, w: f64) -> f64 {
        self.z[0] + w * self.size()[2]
    }

    pub(super) fn table(&self, facies: &str) -> Table {
        table([
            ("x", self.x.to_vec().into()),
            ("y", self.y.to_vec().into()),
            ("z", self.z.to_vec().into()),
            ("facies", facies.into()),
        ])
    }
}

/// The facies that models choose from.
pub(super) const FACIES: [&str; 4] = ["mud", "sand", "silt", "gravel"];

/// A model of a block and its features.
pub(super) fn model(domain: Table, features: Vec<Table>) -> Table {
    let rock = |net: bool, porosity: f64, permeability: [f64; 3]| {
        Value::from(table([
            ("net", net.into()),
            ("porosity", porosity.into()),
            ("permeability", permeability.to_vec().into()),
        ]))
    };
    let facies = table([
        ("mud", rock(false, 0.06, [0.5, 0.5, 0.01])),
        ("sand", rock(true, 0.26, [850.0, 850.0, 120.0])),
        ("silt", rock(false, 0.12, [12.0, 12.0, 1.0])),
        ("gravel", rock(true, 0.2, [400.0, 300.0, 200.0])),
    ]);
    let features: Vec<Value> = features.into_iter().map(Value::from).collect();
    table([
        ("seed", 1.into()),
        ("domain", domain.into()),
        ("facies", facies.into()),
        ("feature", features.into()),
    ])
}

/// A value that is a number, whole or not.
#[allow(
    clippy::cast_precision_loss,
    reason = "whole numbers of a model are small"
)]
pub fn number(value: &Value) -> Option<f64> {
    value
        .as_float()
        .or_else(|| value.as_integer().map(|whole| whole as f64))
}

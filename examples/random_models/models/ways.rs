//! The same model in other units, turned by a right angle, or mirrored: what is in it must not change.

use std::str::FromStr;

use toml::{Table, Value};

use super::tables::{number, set};

/// How a plain model is changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Every length a thousand times as long.
    Thousandfold,
    /// Every length a thousandth.
    Thousandth,
    /// Turned from east to north.
    Turned,
    /// East and west exchanged.
    Mirrored,
}

impl FromStr for Way {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        match word {
            "thousandfold" => Ok(Self::Thousandfold),
            "thousandth" => Ok(Self::Thousandth),
            "turned" => Ok(Self::Turned),
            "mirrored" => Ok(Self::Mirrored),
            _ => Err(format!(
                "there is no way `{word}`; there are thousandfold, thousandth, turned and mirrored"
            )),
        }
    }
}

impl Way {
    /// By how much lengths grow.
    pub fn scale(self) -> f64 {
        match self {
            Self::Thousandfold => 1e3,
            Self::Thousandth => 1e-3,
            Self::Turned | Self::Mirrored => 1.0,
        }
    }

    fn length(self, value: f64) -> f64 {
        match self {
            // The same decimal with its point elsewhere, as it would be written by hand.
            Self::Thousandth => value / 1e3,
            _ => value * self.scale(),
        }
    }

    fn point(self, x: f64, y: f64) -> [f64; 2] {
        match self {
            Self::Turned => [-y, x],
            Self::Mirrored => [-x, y],
            Self::Thousandfold | Self::Thousandth => [self.length(x), self.length(y)],
        }
    }

    fn azimuth(self, degrees: f64) -> f64 {
        match self {
            Self::Turned if degrees < 90.0 => degrees + 270.0,
            Self::Turned => degrees - 90.0,
            Self::Mirrored if degrees > 0.0 => 360.0 - degrees,
            _ => degrees,
        }
    }
}

/// A plain model, changed; none if the program's own draws would not change with it (how belts interfinger along strike,
/// where a mirror exchanges the ends), or it has kinds that are not known here.
pub fn changed(model: &Table, way: Way) -> Option<Table> {
    if way == Way::Mirrored && interfingers(model) || !is_understood(model) {
        return None;
    }
    let mut model = model.clone();
    if let Some(domain) = model.get_mut("domain").and_then(Value::as_table_mut) {
        plan(domain, way);
        lengths(domain, &["z"], way);
        for key in ["base", "top"] {
            within(domain, key, |table| surface(table, way));
        }
    }
    let features = model.get_mut("feature").and_then(Value::as_array_mut);
    for feature in features.into_iter().flatten() {
        if let Some(table) = feature.as_table_mut() {
            changed_feature(table, way);
        }
    }
    Some(model)
}

/// Whether all features are of kinds that are known here.
fn is_understood(model: &Table) -> bool {
    const KNOWN: [&str; 4] = ["channel", "ellipsoid", "horizon", "clinoforms"];
    let features = model.get("feature").and_then(Value::as_array);
    let mut kinds = features.into_iter().flatten().map(|one| one.get("kind"));
    kinds.all(|kind| {
        kind.and_then(Value::as_str)
            .is_some_and(|kind| KNOWN.contains(&kind))
    })
}

fn interfingers(model: &Table) -> bool {
    let features = model.get("feature").and_then(Value::as_array);
    features
        .into_iter()
        .flatten()
        .filter_map(|feature| feature.get("belts")?.as_array())
        .flatten()
        .any(|belt| belt.get("interfingering").is_some())
}

fn changed_feature(feature: &mut Table, way: Way) {
    match feature.get("kind").and_then(Value::as_str) {
        Some("channel") => channel(feature, way),
        Some("ellipsoid") => {
            lengths(feature, &["semi_axes"], way);
            points(feature, &["center"], way);
            azimuth(feature, way);
        }
        Some("horizon") => within(feature, "surface", |table| surface(table, way)),
        _ => {
            azimuth(feature, way);
            lengths(
                feature,
                &["length", "spacing", "first", "shoreline", "turns"],
                way,
            );
            let belts = feature.get_mut("belts").and_then(Value::as_array_mut);
            for belt in belts.into_iter().flatten().filter_map(Value::as_table_mut) {
                lengths(belt, &["width", "interfingering"], way);
            }
        }
    }
}

fn channel(feature: &mut Table, way: Way) {
    for key in ["width", "depth", "top"] {
        if let Some(value) = feature.get_mut(key) {
            profile(value, way.scale(), |value| way.length(value));
        }
    }
    if way == Way::Mirrored {
        if let Some(value) = feature.get_mut("asymmetry") {
            profile(value, -1.0, |value| -value);
        }
        let banks = ["left_angle_deg", "right_angle_deg"].map(|key| feature.remove(key));
        for (value, key) in banks.into_iter().zip(["right_angle_deg", "left_angle_deg"]) {
            if let Some(value) = value {
                set(feature, key, value);
            }
        }
    }
    within(feature, "trajectory", |course| {
        azimuth(course, way);
        lengths(course, &["length", "amplitude", "wavelength"], way);
        points(course, &["from", "to", "center", "points"], way);
        if way == Way::Mirrored && course.contains_key("wavelength") {
            let phase = course.get("phase").and_then(Value::as_float).unwrap_or(0.0);
            set(course, "phase", (phase + 0.5) % 1.0);
        }
        let formula = |key: &str| course.get(key).and_then(Value::as_str).map(str::to_owned);
        if let (Some(x), Some(y)) = (formula("x"), formula("y")) {
            let [x, y] = match way {
                Way::Turned => [format!("-({y})"), x],
                Way::Mirrored => [format!("-({x})"), y],
                _ => [x, y].map(|old| format!("({old}) * {}", way.scale())),
            };
            set(course, "x", x);
            set(course, "y", y);
        }
    });
}

fn surface(table: &mut Table, way: Way) {
    lengths(table, &["level", "tolerance", "thickness"], way);
    points(table, &["points"], way);
    // That of a bed may vary over the plan as heights do.
    within(table, "thickness", |thickness| surface(thickness, way));
    within(table, "dipping", |plane| {
        points(plane, &["through"], way);
        azimuth(plane, way);
    });
    within(table, "grid", |grid| {
        plan(grid, way);
        lengths(grid, &["heights"], way);
        let rows = grid
            .get("heights")
            .and_then(Value::as_array)
            .cloned()
            .unwrap_or_default();
        let rows: Vec<Vec<Value>> = rows.iter().filter_map(Value::as_array).cloned().collect();
        let turned: Vec<Vec<Value>> = match way {
            Way::Mirrored => rows
                .iter()
                .map(|row| row.iter().rev().cloned().collect())
                .collect(),
            Way::Turned => (0..rows.first().map_or(0, Vec::len))
                .map(|i| rows.iter().rev().map(|row| row[i].clone()).collect())
                .collect(),
            Way::Thousandfold | Way::Thousandth => rows,
        };
        set(grid, "heights", turned);
    });
}

/// Ranges `x` and `y`.
fn plan(table: &mut Table, way: Way) {
    let range = |key: &str| {
        let list = table
            .get(key)
            .and_then(Value::as_array)
            .cloned()
            .unwrap_or_default();
        let ends: Vec<f64> = list.iter().filter_map(number).collect();
        [ends[0], ends[1]]
    };
    let (x, y) = (range("x"), range("y"));
    let (a, b) = (way.point(x[0], y[0]), way.point(x[1], y[1]));
    for (axis, key) in ["x", "y"].into_iter().enumerate() {
        set(table, key, vec![a[axis].min(b[axis]), a[axis].max(b[axis])]);
    }
}

fn azimuth(table: &mut Table, way: Way) {
    if let Some(degrees) = table.get("azimuth_deg").and_then(number) {
        set(table, "azimuth_deg", way.azimuth(degrees));
    }
}

/// All numbers under these keys, as lengths.
fn lengths(table: &mut Table, keys: &[&str], way: Way) {
    for key in keys {
        if let Some(value) = table.get_mut(*key) {
            each(value, &|value| way.length(value));
        }
    }
}

/// Points, or lists of them, under these keys.
fn points(table: &mut Table, keys: &[&str], way: Way) {
    fn walk(value: &mut Value, way: Way) {
        let Some(list) = value.as_array_mut() else {
            return;
        };
        let Some(own) = list.iter().map(number).collect::<Option<Vec<f64>>>() else {
            for value in list {
                walk(value, way);
            }
            return;
        };
        let mut new = way.point(own[0], own[1]).to_vec();
        new.extend(own.get(2).map(|z| way.length(*z)));
        *value = new.into();
    }
    for key in keys {
        if let Some(value) = table.get_mut(*key) {
            walk(value, way);
        }
    }
}

/// A quantity that may vary along the way: a number, rows of a place and a number, or a formula.
fn profile(value: &mut Value, factor: f64, change: impl Fn(f64) -> f64) {
    if let Some(own) = number(value) {
        *value = change(own).into();
    } else if let Some(rows) = value.as_array_mut() {
        for row in rows.iter_mut().filter_map(Value::as_array_mut) {
            if let Some(own) = row.get(1).and_then(number) {
                row[1] = change(own).into();
            }
        }
    } else if let Some(formula) = value.get("expression").and_then(Value::as_str) {
        let text = format!("({formula}) * {factor}");
        if let Some(table) = value.as_table_mut() {
            set(table, "expression", text);
        }
    }
}

fn within(table: &mut Table, key: &str, change: impl FnOnce(&mut Table)) {
    if let Some(inner) = table.get_mut(key).and_then(Value::as_table_mut) {
        change(inner);
    }
}

fn each(value: &mut Value, change: &impl Fn(f64) -> f64) {
    if let Some(own) = number(value) {
        *value = change(own).into();
    } else if let Some(list) = value.as_array_mut() {
        for value in list {
            each(value, change);
        }
    }
}

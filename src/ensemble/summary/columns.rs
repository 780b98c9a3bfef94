//! The table of all realisations: what their reports say in numbers, by name.
//!
//! Whatever number a report has over the domain, a facies or a feature becomes a column, without a list of which there are; so a
//! report that says more makes a table that says more. A realisation that lacks a number (the fourth clinoform where there are three) has
//! an empty cell.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::ensemble::member::Member;

/// What of a report is no measure of the whole: what names and describes, what is told volume by volume, how the solids were made.
const LEFT_OUT: [&str; 14] = [
    "schema",
    "program",
    "model",
    "domain",
    "volumes",
    "facies",
    "totals",
    "data",
    "rejected_draws",
    "decisions",
    "notes",
    "empty",
    "assembly",
    "proof",
];

/// Deeper than this nothing is looked for.
const DEEPEST: usize = 6;

/// What a column is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// A key of a design table.
    Design,
    /// What was drawn.
    Drawn,
    /// What came of it.
    Measure,
}

/// A column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Its name: that of a key, `channel-1.width`, or `facies.sand.volume_m3`.
    pub name: String,
    /// What it is.
    pub role: Role,
}

/// A realisation's row.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The realisation's name.
    pub name: String,
    /// Its scenario.
    pub scenario: Option<String>,
    /// Its number.
    pub number: usize,
    /// Its seed.
    pub seed: u64,
    /// Its value in each column.
    pub values: Vec<Option<f64>>,
    /// What its design says, as it is written.
    pub design: Vec<(String, String)>,
}

/// All realisations that were made.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// The columns: designs, draws, measures.
    pub columns: Vec<Column>,
    /// The realisations, in their order.
    pub rows: Vec<Row>,
}

/// Named numbers, in the order of the report.
type Numbers = Vec<(String, f64)>;

/// The numbers of a realisation's report: all that a summary wants of it, and far less than it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Told {
    drawn: Numbers,
    measures: Numbers,
}

impl Told {
    /// What a report says.
    pub fn by(report: &Value) -> Self {
        Self {
            drawn: drawn(report),
            measures: measures(report),
        }
    }
}

impl Table {
    /// Of members and what their reports say.
    pub fn of<'a>(made: impl Iterator<Item = (&'a Member, &'a Told)>) -> Self {
        let mut rows = Vec::new();
        let mut cells: Vec<(Numbers, &Told)> = Vec::new();
        for (member, told) in made {
            let design = member.design.iter();
            let design = design.filter_map(|(key, value)| Some((key.clone(), value.parse().ok()?)));
            let design = design.filter(|(_, value): &(_, f64)| value.is_finite());
            cells.push((design.collect(), told));
            rows.push(Row {
                name: member.name(),
                scenario: member.scenario.clone(),
                number: member.number,
                seed: member.seed,
                values: Vec::new(),
                design: member.design.clone(),
            });
        }
        let mut columns = Vec::new();
        let mut places: [BTreeMap<String, usize>; 3] = Default::default();
        for (part, role) in [Role::Design, Role::Drawn, Role::Measure]
            .into_iter()
            .enumerate()
        {
            for (name, _) in cells.iter().flat_map(|cells| numbers_of(cells)[part]) {
                if !places[part].contains_key(name) {
                    places[part].insert(name.clone(), columns.len());
                    let name = name.clone();
                    columns.push(Column { name, role });
                }
            }
        }
        for (row, cells) in rows.iter_mut().zip(&cells) {
            row.values = vec![None; columns.len()];
            for (numbers, places) in numbers_of(cells).into_iter().zip(&places) {
                for (name, value) in numbers {
                    if let Some(at) = places.get(name) {
                        row.values[*at] = Some(*value);
                    }
                }
            }
        }
        Self { columns, rows }
    }

    /// All rows, or as many at equal steps.
    pub(super) fn some(&self, most: usize) -> impl Iterator<Item = &Row> {
        let shown = self.rows.len().min(most);
        (0..shown).map(move |at| &self.rows[at * self.rows.len() / shown])
    }

    fn having(&self, wanted: fn(Role) -> bool) -> impl Iterator<Item = (usize, &str)> {
        let columns = self.columns.iter().enumerate();
        columns
            .filter(move |(_, column)| wanted(column.role))
            .map(|(at, column)| (at, column.name.as_str()))
    }

    /// The columns of what came of it.
    pub fn measures(&self) -> impl Iterator<Item = (usize, &str)> {
        self.having(|role| role == Role::Measure)
    }

    /// The columns of what was drawn or designed.
    pub fn parameters(&self) -> impl Iterator<Item = (usize, &str)> {
        self.having(|role| role != Role::Measure)
    }

    /// The column of a measure.
    pub fn measure(&self, name: &str) -> Option<usize> {
        self.measures().find(|one| one.1 == name).map(|(at, _)| at)
    }

    /// The first of some measures that every realisation has; else the first one of a facies, by volume.
    pub(super) fn preferred(&self, names: &[&str]) -> String {
        let in_all = |name: &&&str| {
            let at = self.measure(name);
            at.is_some_and(|at| self.rows.iter().all(|row| row.values[at].is_some()))
        };
        let of_facies = || {
            let mut measures = self.measures();
            measures.find(|(_, name)| name.starts_with("facies.") && name.ends_with(".volume_m3"))
        };
        match names.iter().find(in_all) {
            Some(name) => (*name).to_owned(),
            None => of_facies().map_or_else(String::new, |(_, name)| name.to_owned()),
        }
    }
}

/// What is designed, drawn and measured.
fn numbers_of<'a>(cells: &'a (Numbers, &'a Told)) -> [&'a Numbers; 3] {
    [&cells.0, &cells.1.drawn, &cells.1.measures]
}

fn array<'a>(report: &'a Value, key: &str) -> &'a [Value] {
    report[key].as_array().map_or(&[], Vec::as_slice)
}

fn text<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap_or_default()
}

/// What was drawn: for the domain, then for each volume. Of a parameter that a feature has several times (of each channel, of each
/// clinoform) there is the mean besides: that of one channel of many decides little.
fn drawn(report: &Value) -> Numbers {
    let mut numbers = Numbers::new();
    let of = |name: &str, drawn: &Value, numbers: &mut Numbers| {
        for (parameter, value) in drawn.as_object().into_iter().flatten() {
            if let Some(value) = value.as_f64() {
                numbers.push((format!("{name}.{parameter}"), value));
            }
        }
    };
    of("domain", &report["domain"]["drawn"], &mut numbers);
    let mut of_features: Vec<(String, f64, u32)> = Vec::new();
    for volume in array(report, "volumes") {
        let drawn = &volume["drawn"];
        of(text(volume, "name"), drawn, &mut numbers);
        for (parameter, value) in drawn.as_object().into_iter().flatten() {
            let Some(value) = value.as_f64() else {
                continue;
            };
            let name = format!("{}.{}.mean", text(volume, "feature"), unnumbered(parameter));
            match of_features.iter_mut().find(|(known, ..)| *known == name) {
                Some((_, sum, count)) => {
                    *sum += value;
                    *count += 1;
                }
                None => of_features.push((name, value, 1)),
            }
        }
    }
    let several = of_features.into_iter().filter(|(.., count)| *count > 1);
    numbers.extend(several.map(|(name, sum, count)| (name, sum / f64::from(count))));
    numbers
}

/// A parameter without the number of what it belongs to: `usf.width` of `usf-3.width`.
fn unnumbered(parameter: &str) -> String {
    let plain = |word: &str| match word.rsplit_once('-') {
        Some((name, number)) if number.parse::<u32>().is_ok() => name.to_owned(),
        _ => word.to_owned(),
    };
    let words: Vec<String> = parameter.split('.').map(plain).collect();
    words.join(".")
}

/// What came of a realisation, from its report: over the domain, by facies, by feature.
pub fn measures(report: &Value) -> Vec<(String, f64)> {
    let mut numbers = Numbers::new();
    for (key, value) in report.as_object().into_iter().flatten() {
        if !LEFT_OUT.contains(&key.as_str()) {
            flatten(key, value, DEEPEST, &mut numbers);
        }
    }
    parts(None, &report["totals"], &mut numbers);
    for facies in array(report, "facies") {
        let name = format!("facies.{}", text(facies, "name"));
        for (key, value) in facies.as_object().into_iter().flatten() {
            match key.as_str() {
                "connected" => connected(&name, facies, value, &mut numbers),
                "totals" => parts(Some(&name), value, &mut numbers),
                _ => flatten(&format!("{name}.{key}"), value, DEEPEST, &mut numbers),
            }
        }
    }
    by_feature(report, &mut numbers);
    let counts = array(report, "rejected_draws").iter();
    let rejected: u64 = counts.filter_map(|one| one["count"].as_u64()).sum();
    numbers.push(("rejected_draws".to_owned(), rejected as f64));
    for key in ["solids", "faces"] {
        let value = report["assembly"][key].as_f64();
        numbers.extend(value.map(|value| (key.to_owned(), value)));
    }
    numbers
}

/// The parts of a table, with names as if they stood in what holds it.
fn parts(name: Option<&str>, table: &Value, numbers: &mut Numbers) {
    for (key, value) in table.as_object().into_iter().flatten() {
        let key = match name {
            Some(name) => format!("{name}.{key}"),
            None => key.clone(),
        };
        flatten(&key, value, DEEPEST, numbers);
    }
}

/// How a facies hangs together.
fn connected(name: &str, facies: &Value, groups: &Value, numbers: &mut Numbers) {
    let groups = groups.as_array().map_or(&[][..], Vec::as_slice);
    numbers.push((format!("{name}.groups"), groups.len() as f64));
    let largest = groups.first().and_then(|group| group["volume_m3"].as_f64());
    let total = facies["volume_m3"].as_f64().filter(|total| *total > 0.0);
    if let (Some(largest), Some(total)) = (largest, total) {
        numbers.push((format!("{name}.largest_group_fraction"), largest / total));
    }
}

/// The volume of all instances of each feature, in the order of the report, and how many have one.
fn by_feature(report: &Value, numbers: &mut Numbers) {
    let mut features: Vec<(&str, f64, f64)> = Vec::new();
    for volume in array(report, "volumes") {
        let feature = text(volume, "feature");
        let size = volume["volume_m3"].as_f64().unwrap_or_default();
        let at = features
            .iter()
            .position(|(name, ..)| *name == feature)
            .unwrap_or_else(|| {
                features.push((feature, 0.0, 0.0));
                features.len() - 1
            });
        features[at].1 += size;
        features[at].2 += f64::from(u8::from(size > 0.0));
    }
    for (feature, size, count) in features {
        numbers.push((format!("feature.{feature}.volume_m3"), size));
        numbers.push((format!("feature.{feature}.volumes"), count));
    }
}

/// All numbers in a value: tables by key, lists of three numbers by x, y and z, other lists of numbers by place, of tables by their names.
fn flatten(name: &str, value: &Value, deeper: usize, numbers: &mut Numbers) {
    if deeper == 0 {
        return;
    }
    match value {
        Value::Number(number) => {
            numbers.extend(number.as_f64().map(|value| (name.to_owned(), value)));
        }
        Value::Object(table) => {
            for (key, value) in table {
                flatten(&format!("{name}.{key}"), value, deeper - 1, numbers);
            }
        }
        Value::Array(list) => {
            let is_vector = list.len() == 3 && list.iter().all(Value::is_number);
            for (at, value) in list.iter().enumerate() {
                let place = match value {
                    Value::Number(_) if is_vector => ["x", "y", "z"][at].to_owned(),
                    Value::Object(table) => match table.get("name").and_then(Value::as_str) {
                        Some(name) => name.to_owned(),
                        // What has no name is none of a kind, and no measure of all.
                        None => continue,
                    },
                    _ => (at + 1).to_string(),
                };
                flatten(&format!("{name}.{place}"), value, deeper - 1, numbers);
            }
        }
        Value::Null | Value::Bool(_) | Value::String(_) => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ensemble::member::Changes;
    use serde_json::json;

    fn member(number: usize) -> Member {
        Member {
            number,
            scenario: None,
            seed: 6 + number as u64,
            stratum: None,
            design: vec![("feature.ditch.width".to_owned(), format!("{number}0"))],
            changes: Changes::default(),
        }
    }

    fn report() -> Value {
        json!({
            "schema": "x", "model": { "seed": 3 }, "proof": { "checks": [{ "measured": 1 }] },
            "domain": { "drawn": { "top.level": -2 }, "volume_m3": 100 },
            "volumes": [
                { "name": "background", "feature": "background", "drawn": {}, "volume_m3": 70 },
                { "name": "ditch-1", "feature": "ditch", "drawn": { "width": 5 }, "volume_m3": 30 },
                { "name": "ditch-2", "feature": "ditch", "drawn": { "width": 6 }, "volume_m3": 0 },
            ],
            "facies": [{ "name": "sand", "color": "#ffffff", "volume_m3": 30, "totals": { "net_volume_m3": 15 },
                "connected": [{ "volume_m3": 24 }, { "volume_m3": 6 }] }],
            "totals": { "pore_volume_m3": 6, "net_volume_m3": null, "means": { "permeability": [1, 2, 3] } },
            "net_to_gross": 0.3,
            "connectivity": { "gamma": 0.68, "bodies": [{ "name": "a", "area": 4 }, { "area": 9 }] },
            "rejected_draws": [{ "count": 2 }, { "count": 3 }],
            "assembly": { "solids": 4 },
        })
    }

    #[test]
    fn of_many_rows_some_are_taken_from_the_first_on_at_equal_steps() {
        let rows = |count: usize| {
            let row = |at: usize| Row {
                name: at.to_string(),
                scenario: None,
                number: at,
                seed: 0,
                values: Vec::new(),
                design: Vec::new(),
            };
            Table {
                columns: Vec::new(),
                rows: (0..count).map(row).collect(),
            }
        };
        let numbers = |table: &Table| table.some(1000).map(|row| row.number).collect::<Vec<_>>();
        assert_eq!(numbers(&rows(3)), [0, 1, 2]);
        assert_eq!(numbers(&rows(0)), [0; 0]);
        let many = numbers(&rows(2500));
        assert_eq!(
            (many.len(), many[0], many[1], many[999]),
            (1000, 0, 2, 2497)
        );
    }

    #[test]
    fn every_number_of_the_whole_is_a_column_and_what_is_told_part_by_part_is_summed() {
        let (member, told) = (member(1), Told::by(&report()));
        let table = Table::of(std::iter::once((&member, &told)));
        let found: Vec<(&str, Role, Option<f64>)> = table
            .columns
            .iter()
            .zip(&table.rows[0].values)
            .map(|(column, value)| (column.name.as_str(), column.role, *value))
            .collect();
        let measure = |name, value| (name, Role::Measure, Some(value));
        assert_eq!(
            found,
            [
                ("feature.ditch.width", Role::Design, Some(10.0)),
                ("domain.top.level", Role::Drawn, Some(-2.0)),
                ("ditch-1.width", Role::Drawn, Some(5.0)),
                ("ditch-2.width", Role::Drawn, Some(6.0)),
                ("ditch.width.mean", Role::Drawn, Some(5.5)),
                measure("connectivity.bodies.a.area", 4.0),
                measure("connectivity.gamma", 0.68),
                measure("net_to_gross", 0.3),
                measure("means.permeability.x", 1.0),
                measure("means.permeability.y", 2.0),
                measure("means.permeability.z", 3.0),
                measure("pore_volume_m3", 6.0),
                measure("facies.sand.groups", 2.0),
                measure("facies.sand.largest_group_fraction", 0.8),
                measure("facies.sand.net_volume_m3", 15.0),
                measure("facies.sand.volume_m3", 30.0),
                measure("feature.background.volume_m3", 70.0),
                measure("feature.background.volumes", 1.0),
                measure("feature.ditch.volume_m3", 30.0),
                measure("feature.ditch.volumes", 1.0),
                measure("rejected_draws", 5.0),
                measure("solids", 4.0),
            ]
        );
    }

    #[test]
    fn parameters_lose_the_number_of_what_they_belong_to_and_no_other() {
        for (parameter, name) in [
            ("width", "width"),
            ("usf-3.width", "usf.width"),
            ("spacing-12", "spacing"),
            ("by-hand", "by-hand"),
            ("properties.permeability.0", "properties.permeability.0"),
        ] {
            assert_eq!(unnumbered(parameter), name);
        }
    }

    #[test]
    fn what_a_realisation_lacks_is_an_empty_cell() {
        let (first, second) = (member(1), member(2));
        let (one, mut two) = (report(), report());
        two["connectivity"] = json!({ "new": 1 });
        let (one, two) = (Told::by(&one), Told::by(&two));
        let table = Table::of([(&first, &one), (&second, &two)].into_iter());
        let at = |name| {
            table
                .measure(name)
                .map(|at| [0, 1].map(|row: usize| table.rows[row].values[at]))
        };
        assert_eq!(at("connectivity.gamma"), Some([Some(0.68), None]));
        assert_eq!(at("connectivity.new"), Some([None, Some(1.0)]));
    }
}

//! Which tables there are, from a report.

use std::collections::BTreeSet;

use serde_json::Value;

use super::cell::{Cell, Sheet, columns, text};
use super::wells::{tops, wells};
use crate::export::report::{Report, TotalsEntry, VolumeEntry};

/// The name of the table of volumes.
pub const VOLUMES: &str = "volumes";

/// All tables; those of wells and of tops where there are any.
pub fn sheets(report: &Report) -> Vec<Sheet> {
    let mut all = vec![
        volumes(report),
        facies(report),
        units(report),
        sand_bodies(report),
        measures(report),
        neighbours(report),
        drawn(report),
    ];
    if !report.wells.is_empty() {
        all.push(wells(&report.wells));
    }
    if !report.tops.is_empty() {
        all.push(tops(report));
    }
    all
}

/// A line for each volume.
pub fn volumes(report: &Report) -> Sheet {
    let rock = Rock::of(report);
    let mut names = columns(&[
        "volume",
        "display_name",
        "feature",
        "kind",
        "level",
        "facies",
        "parent",
        "solids",
        "volume_m3",
        "fraction",
        "net_volume_m3",
        "pore_volume_m3",
        "number",
    ]);
    let has_blocks = report.volumes.iter().any(|volume| volume.block.is_some());
    if has_blocks {
        names.extend(columns(&["block", "of"]));
    }
    names.extend(rock.columns());
    let row = |(number, volume): (usize, &VolumeEntry)| {
        let scalar = |name: &str| volume.properties.get(name).and_then(Value::as_f64);
        let part = |fraction: Option<f64>| fraction.map(|fraction| fraction * volume.volume_m3);
        let mut row = vec![
            text(&volume.name),
            Cell::words(volume.display_name.as_deref()),
            text(&volume.feature),
            text(&volume.kind),
            Cell::Whole(u64::from(volume.level)),
            text(&volume.facies),
            Cell::words(volume.parent.as_deref()),
            Cell::count(volume.solids.len()),
            Cell::volume(Some(volume.volume_m3)),
            Cell::share(Some(volume.volume_m3 / report.domain.volume_m3)),
            Cell::volume(part(scalar("net"))),
            Cell::volume(part(scalar("porosity"))),
            Cell::count(number),
        ];
        if has_blocks {
            let block = volume.block.as_ref();
            row.push(Cell::words(block.map(|block| block.name.as_str())));
            let of = block.map_or(volume.name.as_str(), |block| block.of.as_str());
            row.push(text(of));
        }
        row.extend(rock.cells(volume));
        row
    };
    Sheet {
        name: VOLUMES,
        columns: names,
        rows: report.volumes.iter().enumerate().map(row).collect(),
    }
}

/// Rock properties in columns: one for a number, one for each axis of what has directions.
struct Rock {
    scalars: Vec<String>,
    /// Those along axes, and whether some are tensors that are not along these.
    directed: Vec<(String, bool)>,
}

/// The entries of a tensor: along the axes, then between two of them.
const ENTRIES: [(&str, usize, usize); 6] = [
    ("x", 0, 0),
    ("y", 1, 1),
    ("z", 2, 2),
    ("xy", 0, 1),
    ("xz", 0, 2),
    ("yz", 1, 2),
];

impl Rock {
    fn of(report: &Report) -> Self {
        let all = || report.volumes.iter().flat_map(|volume| &volume.properties);
        let names: BTreeSet<&String> = all().map(|(name, _)| name).collect();
        let (mut scalars, mut directed) = (Vec::new(), Vec::new());
        for name in names {
            let own = || {
                all()
                    .filter(|(other, _)| *other == name)
                    .map(|(_, value)| value)
            };
            let is_mixed = own().any(|value| {
                let mut between = ENTRIES[3..].iter();
                between.any(|(_, row, column)| entry(value, *row, *column) != Some(0.0))
            });
            if name != "permeability" && own().all(Value::is_number) {
                scalars.push(name.clone());
            } else {
                directed.push((name.clone(), is_mixed));
            }
        }
        Self { scalars, directed }
    }

    fn entries(is_mixed: bool) -> &'static [(&'static str, usize, usize)] {
        if is_mixed { &ENTRIES } else { &ENTRIES[..3] }
    }

    fn columns(&self) -> Vec<String> {
        let directed = self.directed.iter().flat_map(|(name, is_mixed)| {
            let unit = if name == "permeability" { "_md" } else { "" };
            let entries = Self::entries(*is_mixed).iter();
            entries.map(move |(axes, ..)| format!("{name}_{axes}{unit}"))
        });
        self.scalars.iter().cloned().chain(directed).collect()
    }

    fn cells(&self, volume: &VolumeEntry) -> Vec<Cell> {
        let value = |name: &String| volume.properties.get(name);
        let scalars = self.scalars.iter();
        let mut cells: Vec<Cell> = scalars
            .map(|name| Cell::number(value(name).and_then(Value::as_f64)))
            .collect();
        for (name, is_mixed) in &self.directed {
            for (_, row, column) in Self::entries(*is_mixed) {
                cells.push(Cell::number(
                    value(name).and_then(|value| entry(value, *row, *column)),
                ));
            }
        }
        cells
    }
}

/// An entry of a number, of three along the axes, or of a tensor.
fn entry(value: &Value, row: usize, column: usize) -> Option<f64> {
    let on_axis = |value: Option<f64>| if row == column { value } else { Some(0.0) };
    match value.as_array() {
        None => on_axis(value.as_f64()),
        Some(rows) => match rows.get(row)?.as_array() {
            Some(entries) => entries.get(column)?.as_f64(),
            None => on_axis(rows.get(row)?.as_f64()),
        },
    }
}

/// What lacks a property, in words; nothing if nothing does.
fn missing(totals: &TotalsEntry) -> Cell {
    let words: Vec<String> = totals
        .unknown
        .iter()
        .map(|(name, facies)| format!("{name}: {}", facies.join(", ")))
        .collect();
    Cell::words((!words.is_empty()).then(|| words.join("; ")).as_deref())
}

/// The cells of totals, as `TOTALS` names them.
fn totals(totals: &TotalsEntry) -> [Cell; 5] {
    [
        Cell::volume(totals.net_volume_m3),
        Cell::volume(totals.pore_volume_m3),
        Cell::volume(totals.net_pore_volume_m3),
        Cell::volume(totals.hydrocarbon_volume_m3),
        missing(totals),
    ]
}

const TOTALS: [&str; 5] = [
    "net_volume_m3",
    "pore_volume_m3",
    "net_pore_volume_m3",
    "hydrocarbon_volume_m3",
    "missing",
];

/// A line for each facies, and one for all.
fn facies(report: &Report) -> Sheet {
    let mut names = columns(&["facies", "display_name", "color", "volume_m3", "fraction"]);
    names.extend(columns(&["connected_groups", "net_to_gross"]));
    names.extend(columns(&TOTALS));
    let mut rows: Vec<Vec<Cell>> = Vec::new();
    for facies in &report.facies {
        let mut row = vec![
            text(&facies.name),
            Cell::words(facies.display_name.as_deref()),
            text(&facies.color),
            Cell::volume(Some(facies.volume_m3)),
            Cell::share(Some(facies.fraction)),
            Cell::count(facies.connected.len()),
            Cell::share(facies.net),
        ];
        row.extend(totals(&facies.totals));
        rows.push(row);
    }
    let mut all = vec![
        text("(all)"),
        Cell::Empty,
        Cell::Empty,
        Cell::volume(Some(report.domain.volume_m3)),
        Cell::share(Some(1.0)),
        Cell::Empty,
        Cell::share(report.net_to_gross),
    ];
    all.extend(totals(&report.totals));
    rows.push(all);
    Sheet {
        name: "facies",
        columns: names,
        rows,
    }
}

/// A line for each unit.
fn units(report: &Report) -> Sheet {
    Sheet {
        name: "units",
        columns: columns(&[
            "unit",
            "volume_m3",
            "net_volume_m3",
            "net_to_gross",
            "missing",
        ]),
        rows: report
            .units
            .iter()
            .map(|unit| {
                let missing = format!("net: {}", unit.unknown_net.join(", "));
                vec![
                    text(&unit.unit),
                    Cell::volume(Some(unit.volume_m3)),
                    Cell::volume(unit.net_volume_m3),
                    Cell::share(unit.net_to_gross),
                    Cell::words((!unit.unknown_net.is_empty()).then_some(missing.as_str())),
                ]
            })
            .collect(),
    }
}

/// A line for each net solid, with the group that it hangs together with.
fn sand_bodies(report: &Report) -> Sheet {
    let mut rows = Vec::new();
    for (number, group) in report.connectivity.groups.iter().enumerate() {
        for solid in &group.solids {
            rows.push(vec![
                Cell::count(number + 1),
                Cell::volume(Some(group.net_volume_m3)),
                Cell::share(Some(group.share)),
                text(solid),
            ]);
        }
    }
    Sheet {
        name: "sand-bodies",
        columns: columns(&["group", "group_net_volume_m3", "group_share", "solid"]),
        rows,
    }
}

/// A line for each number about the whole.
fn measures(report: &Report) -> Sheet {
    let (web, rock) = (&report.connectivity, &report.heterogeneity);
    let unknown =
        (!web.unknown_net.is_empty()).then(|| format!("net: {}", web.unknown_net.join(", ")));
    let line = |name: &str, unit: &str, value: Cell, meaning: &str| {
        vec![text(name), value, text(unit), text(meaning)]
    };
    let mut rows = vec![
        line(
            "volume",
            "m3",
            Cell::volume(Some(report.domain.volume_m3)),
            "the whole domain",
        ),
        line(
            "net_to_gross",
            "",
            Cell::share(report.net_to_gross),
            "net volume over gross volume",
        ),
        line(
            "sand_bodies",
            "",
            Cell::count(web.groups.len()),
            "groups of net solids that hang together",
        ),
        line(
            "least_area",
            "m2",
            Cell::Number(web.least_area_m2),
            "what solids share at least to hang together",
        ),
        line(
            "largest_share",
            "",
            Cell::share(web.largest_share),
            "the largest group's share of net volume",
        ),
        line(
            "gamma",
            "",
            Cell::share(web.gamma),
            "chance that two places in net rock lie in one group",
        ),
        line(
            "amalgamation",
            "",
            Cell::share(web.amalgamation),
            "share of net bodies' contacts that lie between two of them",
        ),
        line(
            "lorenz",
            "",
            Cell::share(rock.lorenz),
            "Lorenz coefficient of net volumes",
        ),
        line(
            "dykstra_parsons",
            "",
            Cell::share(rock.dykstra_parsons),
            "Dykstra-Parsons coefficient of net volumes",
        ),
    ];
    if let Some(unknown) = unknown {
        rows.push(vec![
            text("missing"),
            Cell::Empty,
            Cell::Empty,
            text(&unknown),
        ]);
    }
    Sheet {
        name: "measures",
        columns: columns(&["measure", "value", "unit", "meaning"]),
        rows,
    }
}

/// A line for each pair of volumes that touch.
fn neighbours(report: &Report) -> Sheet {
    let place = |name: &str| report.volumes.iter().position(|volume| volume.name == name);
    let net = |volume: &VolumeEntry| volume.properties.get("net").and_then(Value::as_f64);
    let mut rows = Vec::new();
    for (at, volume) in report.volumes.iter().enumerate() {
        for neighbour in &volume.neighbours {
            let Some(other) = place(&neighbour.name).filter(|other| *other > at) else {
                continue;
            };
            let other = &report.volumes[other];
            let both = net(volume).zip(net(other));
            let both = both.map(|(a, b)| if a > 0.0 && b > 0.0 { "yes" } else { "no" });
            rows.push(vec![
                text(&volume.name),
                text(&other.name),
                Cell::Rounded(neighbour.area_m2, 6),
                text(&volume.facies),
                text(&other.facies),
                Cell::words(both),
            ]);
        }
    }
    Sheet {
        name: "neighbours",
        columns: columns(&[
            "volume",
            "neighbour",
            "area_m2",
            "facies",
            "neighbour_facies",
            "both_net",
        ]),
        rows,
    }
}

/// A line for each number that was drawn.
fn drawn(report: &Report) -> Sheet {
    let of_domain = report.domain.drawn.iter();
    let of_domain = of_domain.map(|(name, value)| ("domain", "domain", name, value));
    let of_volumes = report.volumes.iter().flat_map(|volume| {
        let drawn = volume.drawn.iter();
        drawn.map(|(name, value)| (volume.name.as_str(), volume.feature.as_str(), name, value))
    });
    let row = |(volume, feature, name, value): (&str, &str, &String, &f64)| {
        vec![
            text(volume),
            text(feature),
            text(name),
            Cell::Number(*value),
        ]
    };
    Sheet {
        name: "drawn",
        columns: columns(&["volume", "feature", "parameter", "value"]),
        rows: of_domain.chain(of_volumes).map(row).collect(),
    }
}

//! `wells.csv`: one line for each part of a well in one volume. Depths are metres.

use super::entries::{IntervalEntry, WellEntry};
use crate::export::rows;

/// The names of the columns.
const COLUMNS: [&str; 9] = [
    "well",
    "volume",
    "facies",
    "md_from_m",
    "md_to_m",
    "tvdss_from_m",
    "tvdss_to_m",
    "length_m",
    "perforated_m",
];

/// The table, with a header line.
pub fn csv(wells: &[WellEntry]) -> Result<String, csv::Error> {
    let of = |well: &WellEntry| {
        let name = well.name.clone();
        let intervals = well.intervals.iter();
        intervals
            .map(move |one| line(&name, one))
            .collect::<Vec<_>>()
    };
    let header = std::iter::once(COLUMNS.map(str::to_owned));
    rows::csv(header.chain(wells.iter().flat_map(of)))
}

fn line(well: &str, one: &IntervalEntry) -> [String; 9] {
    let number = |value: f64| format!("{value:.6}");
    [
        well.to_owned(),
        one.volume.clone().unwrap_or_default(),
        one.facies.clone().unwrap_or_default(),
        number(one.md_m[0]),
        number(one.md_m[1]),
        number(one.tvdss_m[0]),
        number(one.tvdss_m[1]),
        number(one.length_m),
        number(one.perforated_m),
    ]
}

//! Tables of wells. Depths are metres.

use super::cell::{Cell, Sheet, columns, text};
#[cfg(feature = "occt")]
use crate::export::report::Report;
use crate::export::wells::entries::{IntervalEntry, WellEntry};

/// The name of the table of wells.
pub const WELLS: &str = "wells";

/// A line for each part of a well in one volume.
pub fn wells(wells: &[WellEntry]) -> Sheet {
    let length = |value: f64| Cell::Rounded(value, 6);
    let row = |well: &WellEntry, one: &IntervalEntry| {
        vec![
            text(&well.name),
            Cell::words(one.volume.as_deref()),
            Cell::words(one.facies.as_deref()),
            length(one.md_m[0]),
            length(one.md_m[1]),
            length(one.tvdss_m[0]),
            length(one.tvdss_m[1]),
            length(one.length_m),
            length(one.perforated_m),
        ]
    };
    Sheet {
        name: WELLS,
        columns: columns(&[
            "well",
            "volume",
            "facies",
            "md_from_m",
            "md_to_m",
            "tvdss_from_m",
            "tvdss_to_m",
            "length_m",
            "perforated_m",
        ]),
        rows: wells
            .iter()
            .flat_map(|well| well.intervals.iter().map(|one| row(well, one)))
            .collect(),
    }
}

/// A line for each top that was picked in a well.
#[cfg(feature = "occt")]
pub(super) fn tops(report: &Report) -> Sheet {
    let length = |value: f64| Cell::Rounded(value, 6);
    Sheet {
        name: "tops",
        columns: columns(&["well", "horizon", "md_m", "x", "y", "z", "misfit_m"]),
        rows: report
            .tops
            .iter()
            .map(|top| {
                let mut row = vec![text(&top.well), text(&top.horizon), length(top.md_m)];
                row.extend(top.at.map(length));
                row.push(top.misfit_m.map_or(Cell::Empty, length));
                row
            })
            .collect(),
    }
}

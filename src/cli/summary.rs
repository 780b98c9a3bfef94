//! The readable summary of a build.

use std::fmt::Write;
use std::path::Path;

use crate::export::report::{ConnectivityEntry, Report, VolumeEntry};

/// Rows of the summary's table of volumes.
const MOST_ROWS: usize = 30;

pub(super) fn text(report: &Report, folder: &Path, written: &[String]) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "{}", volumes(report));
    if report.volumes.len() > MOST_ROWS {
        let _ = writeln!(
            out,
            "… and {} more in volumes.csv",
            report.volumes.len() - MOST_ROWS
        );
    }
    for facies in &report.facies {
        let _ = writeln!(
            out,
            "{}: {} m³, {:.2} % in {} connected group{}",
            facies.display_name.as_ref().unwrap_or(&facies.name),
            grouped(facies.volume_m3),
            100.0 * facies.fraction,
            facies.connected.len(),
            if facies.connected.len() == 1 { "" } else { "s" }
        );
    }
    if let Some(net_to_gross) = report.net_to_gross {
        let _ = writeln!(out, "net-to-gross: {net_to_gross:.4}");
    }
    let _ = write!(out, "{}", sand_bodies(&report.connectivity));
    if let Some(pores) = report.totals.pore_volume_m3 {
        let porosity = pores / report.domain.volume_m3;
        let _ = writeln!(
            out,
            "pore volume: {} m³, mean porosity {porosity:.4}",
            grouped(pores)
        );
    }
    for data in &report.data {
        let _ = writeln!(
            out,
            "{}: {} control points miss {} heights of {} by {:.3} m at most, {:.3} m as root mean square",
            data.of,
            data.control_points[0] * data.control_points[1],
            data.used,
            data.file,
            data.most_m,
            data.rms_m,
        );
    }
    for rejected in &report.rejected_draws {
        let _ = writeln!(
            out,
            "{} draw(s) of {} made again: {}",
            rejected.count, rejected.feature, rejected.reason
        );
    }
    let crossing = match report.assembly.crossing_pairs {
        1 => "1 pair of bodies crosses".to_owned(),
        pairs => format!("{pairs} pairs of bodies cross"),
    };
    let _ = writeln!(
        out,
        "\nproven: {} solids, {} faces, {crossing}; engine: {}, remedy: {}",
        report.assembly.solids,
        report.assembly.faces,
        report.assembly.engine,
        report.assembly.remedy
    );
    for check in &report.proof.checks {
        let _ = writeln!(
            out,
            "  {}: {:.3e}, at most {:.3e}",
            check.name, check.measured, check.bound
        );
    }
    let _ = writeln!(
        out,
        "\nwrote to {}: {}",
        folder.display(),
        written.join(", ")
    );
    let is_step = |name: &&String| Path::new(name).extension().is_some_and(|end| end == "step");
    if let Some(step) = written.iter().find(is_step) {
        let path = folder.join(step);
        let _ = writeln!(
            out,
            "next: open {} in FreeCAD or any CAD program",
            path.display()
        );
    }
    out
}

/// How net rock hangs together, and what does not say whether it is net.
fn sand_bodies(web: &ConnectivityEntry) -> String {
    let mut out = String::new();
    if let (Some(largest), Some(gamma)) = (web.largest_share, web.gamma) {
        let (count, bodies) = match web.groups.len() {
            1 => ("1".to_owned(), "sand body"),
            count => (count.to_string(), "sand bodies"),
        };
        let _ = writeln!(
            out,
            "connectivity: {count} {bodies}, the largest has {:.2} % of net volume; Γ {gamma:.4}",
            100.0 * largest
        );
    }
    if !web.unknown_net.is_empty() {
        let _ = writeln!(
            out,
            "net-to-gross: not known, since `net` is not given for {}",
            web.unknown_net.join(", ")
        );
    }
    out
}

/// A row for each of the first volumes.
fn volumes(report: &Report) -> comfy_table::Table {
    let mut volumes = comfy_table::Table::new();
    volumes.load_style(comfy_table::presets::NOTHING);
    volumes.set_header(["volume", "facies", "solids", "volume (m³)", "share"]);
    // Of what faults part, most blocks have some volumes that are nowhere in them.
    let is_there = |volume: &&VolumeEntry| volume.block.is_none() || !volume.solids.is_empty();
    for volume in report.volumes.iter().filter(is_there).take(MOST_ROWS) {
        volumes.add_row([
            match &volume.display_name {
                None => volume.name.clone(),
                Some(label) => format!("{} ({label})", volume.name),
            },
            volume.facies.clone(),
            volume.solids.len().to_string(),
            grouped(volume.volume_m3),
            format!(
                "{:.3} %",
                100.0 * volume.volume_m3 / report.domain.volume_m3
            ),
        ]);
    }
    for column in 2..5 {
        if let Some(column) = volumes.column_mut(column) {
            column.set_cell_alignment(comfy_table::CellAlignment::Right);
        }
    }
    volumes
}

/// A whole number with spaces between groups of three digits.
fn grouped(value: f64) -> String {
    let digits = format!("{:.0}", value.abs());
    let mut out = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i) % 3 == 0 {
            out.push(' ');
        }
        out.push(digit);
    }
    if value < 0.0 && digits != "0" {
        format!("−{out}")
    } else {
        out
    }
}

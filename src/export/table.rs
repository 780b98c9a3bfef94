//! `volumes.csv`: one line per volume.

use super::ExportError;
use super::report::Report;

/// The table, with a header line.
pub fn csv(report: &Report) -> Result<String, ExportError> {
    let failed = |error: &dyn std::fmt::Display| ExportError::Table(error.to_string());
    let mut properties: Vec<&str> = Vec::new();
    for volume in &report.volumes {
        for name in volume.properties.keys() {
            if !properties.contains(&name.as_str()) {
                properties.push(name);
            }
        }
    }
    properties.sort_unstable();
    let mut writer = csv::Writer::from_writer(Vec::new());
    let fixed = [
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
    ];
    writer
        .write_record(fixed.iter().chain(properties.iter()))
        .map_err(|error| failed(&error))?;
    for volume in &report.volumes {
        let mut record = vec![
            volume.name.clone(),
            volume.display_name.clone().unwrap_or_default(),
            volume.feature.clone(),
            volume.kind.clone(),
            volume.level.to_string(),
            volume.facies.clone(),
            volume.parent.clone().unwrap_or_default(),
            volume.solids.len().to_string(),
            format!("{:.6}", volume.volume_m3),
            format!("{:.9}", volume.volume_m3 / report.domain.volume_m3),
        ];
        for name in &properties {
            record.push(volume.properties.get(*name).map(cell).unwrap_or_default());
        }
        writer
            .write_record(&record)
            .map_err(|error| failed(&error))?;
    }
    let bytes = writer.into_inner().map_err(|error| failed(&error))?;
    String::from_utf8(bytes).map_err(|error| failed(&error))
}

/// A property in one cell: one number, three with spaces between them, or the six of a tensor: xx yy zz xy yz xz.
fn cell(value: &serde_json::Value) -> String {
    let numbers: Vec<&serde_json::Value> = match value {
        serde_json::Value::Array(rows) => match rows.iter().map(|row| row.as_array()).collect() {
            None => rows.iter().collect(),
            Some::<Vec<_>>(rows) => {
                let places = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)];
                let at = |(row, column): (usize, usize)| rows.get(row)?.get(column);
                places.into_iter().filter_map(at).collect()
            }
        },
        other => vec![other],
    };
    let numbers: Vec<String> = numbers.iter().map(ToString::to_string).collect();
    numbers.join(" ")
}

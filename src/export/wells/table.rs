//! `wells.csv`: one line for each part of a well in one volume. Depths are metres.

use super::entries::WellEntry;

/// The table, with a header line.
pub fn csv(wells: &[WellEntry]) -> Result<String, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record([
        "well",
        "volume",
        "facies",
        "md_from_m",
        "md_to_m",
        "tvdss_from_m",
        "tvdss_to_m",
        "length_m",
        "perforated_m",
    ])?;
    for well in wells {
        for one in &well.intervals {
            let number = |value: f64| format!("{value:.6}");
            writer.write_record([
                well.name.clone(),
                one.volume.clone().unwrap_or_default(),
                one.facies.clone().unwrap_or_default(),
                number(one.md_m[0]),
                number(one.md_m[1]),
                number(one.tvdss_m[0]),
                number(one.tvdss_m[1]),
                number(one.length_m),
                number(one.perforated_m),
            ])?;
        }
    }
    let bytes = writer
        .into_inner()
        .map_err(csv::IntoInnerError::into_error)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

//! The part of the page in which any two columns are plotted against each other: its data and its script.

use super::columns::Row;
use super::whole::{Summary, TORNADO};

const SCRIPT: &str = include_str!("explorer.js");

/// What is plotted of these rows: every measure, and the parameters that decide the result most.
pub(super) fn html(summary: &Summary, rows: &[&Row]) -> String {
    let table = &summary.table;
    let strongest = summary
        .scenarios
        .iter()
        .flat_map(|one| one.correlations.iter().take(TORNADO))
        .map(|one| one.parameter.as_str());
    let strongest: Vec<&str> = strongest.collect();
    let parameters = table
        .parameters()
        .filter(|(_, name)| strongest.contains(name));
    let columns: Vec<(usize, &str)> = parameters.chain(table.measures()).collect();
    if rows.is_empty() || columns.is_empty() {
        return String::new();
    }
    let scenario = |name: &Option<String>| {
        let found = summary.scenarios.iter().position(|one| one.name == *name);
        found.unwrap_or(0)
    };
    let values = |at: usize| -> Vec<Option<f64>> {
        rows.iter().map(|row| row.values[at].map(short)).collect()
    };
    let data = serde_json::json!({
        "names": rows.iter().map(|row| &row.name).collect::<Vec<_>>(),
        "scenarios": summary.scenarios.iter().map(|one| one.name.as_deref().unwrap_or_default()).collect::<Vec<_>>(),
        "scenario": rows.iter().map(|row| scenario(&row.scenario)).collect::<Vec<_>>(),
        "x": strongest.first().copied().unwrap_or(columns[0].1),
        "y": summary.result,
        "columns": columns.iter().map(|(at, name)| serde_json::json!({ "name": name, "values": values(*at) })).collect::<Vec<_>>(),
    });
    // No name can end the script early.
    let data = data.to_string().replace('<', "\\u003c");
    format!(
        "<h2>Two of them</h2>\n<p><label>across <select id=\"explorer-x\"></select></label> \
         <label>upwards <select id=\"explorer-y\"></select></label></p>\n<figure id=\"explorer\"></figure>\n\
         <script type=\"application/json\" id=\"columns\">{data}</script>\n<script>{SCRIPT}</script>\n"
    )
}

/// A number with as many digits as a plot can show.
fn short(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_plots_have_six_digits() {
        assert_eq!(short(1_837_246.123_4), 1_837_250.0);
        assert_eq!(short(-0.001_234_567), -0.001_234_57);
        assert_eq!(short(0.0), 0.0);
    }
}

//! Responses: measures of a realisation as files of one number each, which engines of ensembles read (`GEN_DATA` in ERT).

use std::path::Path;

use super::failure::Failure;
use crate::ensemble::summary::measures;
use crate::export::report::Report;

/// The folder of the files, in that of the results.
const FOLDER: &str = "responses";

/// A file to write, with its number.
pub(super) struct Response {
    /// Its name in the folder of the results.
    pub(super) file: String,
    /// The measure, in the unit that its name says.
    value: f64,
}

/// The measures of these names, each as `responses/NAME.txt`; what separates folders is `_` in the name of a file.
pub(super) fn of(report: &Report, names: &[String]) -> Result<Vec<Response>, Failure> {
    if names.is_empty() {
        return Ok(Vec::new());
    }
    let report =
        serde_json::to_value(report).map_err(|error| Failure::Surroundings(error.to_string()))?;
    let measures = measures(&report);
    let mut responses: Vec<Response> = Vec::new();
    for name in names {
        let Some((_, value)) = measures.iter().find(|(measure, _)| measure == name) else {
            return Err(unknown(name, &measures));
        };
        let file = format!("{FOLDER}/{}.txt", name.replace(['/', '\\'], "_"));
        if responses.iter().all(|one| one.file != file) {
            let value = *value;
            responses.push(Response { file, value });
        }
    }
    Ok(responses)
}

fn unknown(name: &str, measures: &[(String, f64)]) -> Failure {
    let names: Vec<&str> = measures.iter().map(|(name, _)| name.as_str()).collect();
    Failure::Wrong(format!(
        "--responses: this realisation has no measure `{name}`; it has {}",
        names.join(", ")
    ))
}

impl Response {
    /// Writes it below a folder.
    pub(super) fn write(&self, folder: &Path) -> std::io::Result<()> {
        std::fs::create_dir_all(folder.join(FOLDER))?;
        std::fs::write(folder.join(&self.file), format!("{}\n", self.value))
    }
}

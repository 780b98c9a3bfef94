//! Bodies before they are assembled, one BREP file each, for other programs to make solids of.

use std::path::{Path, PathBuf};

use super::ExportError;
use crate::assembly::{self, kernel};
use crate::model::plan::AssemblyPlan;

/// Writes the domain's box and each body, closed, whole inside the domain and cut off somewhere outside of it.
///
/// File names sort as the files returned do: `0000-background.brep`, then from oldest to youngest.
pub fn write(folder: &Path, plan: &AssemblyPlan) -> Result<Vec<PathBuf>, ExportError> {
    let failed = |message: String| ExportError::Kernel {
        what: "bodies",
        message,
    };
    let bodies = assembly::bodies(plan).map_err(failed)?;
    let mut written = Vec::with_capacity(bodies.len());
    for (at, (volume, solid)) in bodies.iter().enumerate() {
        let path = folder.join(format!("{at:04}-{}.brep", plan.names[*volume]));
        kernel::write_brep(&path, solid).map_err(|error| failed(error.to_string()))?;
        written.push(path);
    }
    Ok(written)
}

#[cfg(test)]
#[allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]
mod tests {
    use super::*;
    use crate::model::realisation::Realisation;
    use crate::model::selection::Selection;
    use crate::model::{Format, Model, Source};

    const QUICKSTART: &str = include_str!("../../models/quickstart/quickstart.toml");

    #[test]
    fn every_body_has_a_file_of_one_solid_and_the_domain_comes_first() {
        let source = Source::from_text("quickstart.toml", QUICKSTART, Format::Toml);
        let model = Model::check(&source).unwrap_or_else(|defects| panic!("{defects}"));
        let realisation = Realisation::new(&model, &Selection::default()).unwrap();
        let plan = AssemblyPlan::new(&realisation).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let files = write(folder.path(), &plan).unwrap();
        let names: Vec<_> = files
            .iter()
            .map(|file| file.file_name().unwrap().to_str().unwrap())
            .collect();
        assert_eq!(
            names,
            [
                "0000-background.brep",
                "0001-old-channel.brep",
                "0002-young-channel.brep"
            ]
        );
        for file in &files {
            let text = std::fs::read_to_string(file).unwrap();
            // In the list of shapes of a BREP file a solid is a line `So`.
            let solids = text.lines().filter(|line| line.trim() == "So").count();
            assert_eq!(solids, 1, "{}", file.display());
        }
    }
}

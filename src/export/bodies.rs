//! Bodies before they are assembled, one BREP file each, for other programs to make solids of.

use std::path::{Path, PathBuf};

use super::ExportError;
use crate::assembly::{self, kernel};
use crate::model::plan::AssemblyPlan;

/// Writes the domain's box and each body, whole inside the domain: closed ones as a solid, cut off somewhere outside of it,
/// sides as the faces of their sheets, which overshoot.
///
/// File names sort as the files returned do: `0000-background.brep`, then from oldest to youngest. A child's `/` is `_`
/// in them.
pub fn write(folder: &Path, plan: &AssemblyPlan) -> Result<Vec<PathBuf>, ExportError> {
    let failed = |message: String| ExportError::Kernel {
        what: "bodies",
        message,
    };
    let bodies = assembly::bodies(plan).map_err(failed)?;
    let mut written = Vec::with_capacity(bodies.len());
    for (at, (volume, solid)) in bodies.iter().enumerate() {
        let name = plan.names[*volume].replace('/', "_");
        let path = folder.join(format!("{at:04}-{name}.brep"));
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
    const PARASEQUENCE: &str = include_str!("../../models/parasequence/parasequence.toml");

    fn written(file: &str, text: &str) -> (tempfile::TempDir, Vec<PathBuf>) {
        let source = Source::from_text(file, text, Format::Toml);
        let model = Model::check(&source).unwrap_or_else(|defects| panic!("{defects}"));
        let realisation = Realisation::new(&model, &Selection::default()).unwrap();
        let plan = AssemblyPlan::new(&realisation).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let files = write(folder.path(), &plan).unwrap();
        (folder, files)
    }

    /// How many solids (`So`) and faces (`Fa`) the list of shapes of a BREP file has.
    fn shapes(file: &Path) -> (usize, usize) {
        let text = std::fs::read_to_string(file).unwrap();
        let count = |kind| text.lines().filter(|line| line.trim() == kind).count();
        (count("So"), count("Fa"))
    }

    #[test]
    fn every_body_has_a_file_of_one_solid_and_the_domain_comes_first() {
        let (_folder, files) = written("quickstart.toml", QUICKSTART);
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
            assert_eq!(shapes(file).0, 1, "{}", file.display());
        }
    }

    #[test]
    fn a_side_is_a_file_of_its_sheets_alone() {
        let (_folder, files) = written("parasequence.toml", PARASEQUENCE);
        let name = |file: &PathBuf| file.file_name().unwrap().to_str().unwrap().to_owned();
        let mut sorted = files.clone();
        sorted.sort();
        assert_eq!(files, sorted);
        assert_eq!(shapes(&files[0]), (1, 6));
        // The flooding surface is one sheet; the older set comes before it, the younger after it.
        let flooding = files
            .iter()
            .position(|file| name(file).ends_with("-flooding.brep"));
        let flooding = flooding.unwrap();
        assert_eq!(shapes(&files[flooding]), (0, 1));
        assert!(flooding > 1 && flooding + 1 < files.len());
        for (at, file) in files.iter().enumerate().skip(1) {
            let (solids, faces) = shapes(file);
            assert!(solids == 0 && faces > 0, "{}", file.display());
            let younger = name(file).contains("-flooding_upper-");
            assert!(
                at == flooding || younger == (at > flooding),
                "{}",
                file.display()
            );
        }
    }
}

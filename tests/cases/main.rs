//! Models that people write first, and shapes that real horizons have: each minimal, and each
//! with what is right, from closed forms and from integrals that know nothing of the program.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod contacts;
mod isochores;
mod newcomer;
mod points;
mod real_data;
mod section;
mod shallow;
mod spline;
#[path = "../assembled/underlined.rs"]
mod underlined;

use std::path::{Path, PathBuf};
use std::process::Output;

use assert_cmd::Command;
use serde_json::Value;

/// A case's file.
fn path(folder: &str, name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/cases")
        .join(folder)
        .join(name)
        .with_extension("toml")
}

fn text(folder: &str, name: &str) -> String {
    std::fs::read_to_string(path(folder, name)).unwrap()
}

/// A case as a table.
fn table(folder: &str, name: &str) -> toml::Table {
    text(folder, name).parse().unwrap()
}

/// Runs the program in a folder of its own that holds the model.
fn run(command: &str, model: &str, arguments: &[&str]) -> Output {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("model.toml"), model).unwrap();
    Command::new(env!("CARGO_BIN_EXE_clinothem"))
        .current_dir(folder.path())
        .args([command, "model.toml"])
        .args(arguments)
        .output()
        .unwrap()
}

/// What a build reports.
struct Report(Value);

impl Report {
    fn of(model: &str, arguments: &[&str]) -> Self {
        let all = [&["--json", "--formats", "none"], arguments].concat();
        let output = run("build", model, &all);
        assert!(
            output.status.success(),
            "refused: {}",
            String::from_utf8_lossy(&output.stderr)
        );
        Self(serde_json::from_slice(&output.stdout).unwrap())
    }

    fn case(folder: &str, name: &str) -> Self {
        Self::of(&text(folder, name), &[])
    }

    fn volume(&self, name: &str) -> &Value {
        let volumes = self.0["volumes"].as_array().unwrap();
        let found = volumes.iter().find(|volume| volume["name"] == name);
        found.unwrap_or_else(|| panic!("no volume {name}"))
    }

    /// A volume's size (m³).
    fn size(&self, name: &str) -> f64 {
        self.volume(name)["volume_m3"].as_f64().unwrap()
    }

    /// Whether a decision says this and that.
    fn decides(&self, this: &str, that: &str) -> bool {
        let decisions = self.0["decisions"].as_array().unwrap();
        let mut words = decisions.iter().map(|one| one.as_str().unwrap());
        words.any(|words| words.contains(this) && words.contains(that))
    }

    fn pieces(&self, name: &str) -> usize {
        self.volume(name)["solids"].as_array().unwrap().len()
    }

    /// All volumes' sizes are these (m³), within a fraction of the largest; and there are no others.
    fn assert_sizes(&self, right: &[(&str, f64)], fraction: f64) {
        let most = right.iter().map(|one| one.1).fold(0.0, f64::max);
        for (name, size) in right {
            let miss = self.size(name) - size;
            assert!(
                miss.abs() <= fraction * most,
                "{name} is {} m³, right is {size} m³",
                self.size(name)
            );
        }
        assert_eq!(self.0["volumes"].as_array().unwrap().len(), right.len());
    }
}

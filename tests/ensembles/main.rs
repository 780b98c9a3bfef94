//! Ensembles: the same bytes whatever happens on the way, and whatever goes wrong told.
#![cfg(feature = "occt")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::cast_possible_truncation,
    reason = "a test fails by panicking; its numbers are small"
)]

mod arguments;
#[cfg(target_os = "linux")]
mod killed;
mod numbers;
#[allow(dead_code, reason = "shared with other tests")]
#[path = "../cli/sandbox.rs"]
mod sandbox;

use std::collections::BTreeMap;
use std::path::Path;

use sandbox::Sandbox;

/// Two channels, one of them drawn: a realisation takes milliseconds.
const QUICK: &str = "quickstart/quickstart.toml";

/// All files of an ensemble by name, but for what differs from run to run.
fn files(sandbox: &Sandbox, folder: &str) -> BTreeMap<String, Vec<u8>> {
    fn list(top: &Path, folder: &Path, found: &mut BTreeMap<String, Vec<u8>>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                list(top, &path, found);
            } else if path.file_name().unwrap() != "run.json" {
                let name = path.strip_prefix(top).unwrap().display().to_string();
                found.insert(name, std::fs::read(&path).unwrap());
            }
        }
    }
    let (top, mut found) = (sandbox.path(folder), BTreeMap::new());
    list(&top, &top, &mut found);
    found
}

/// The same files with the same bytes.
#[track_caller]
fn assert_same(a: &BTreeMap<String, Vec<u8>>, b: &BTreeMap<String, Vec<u8>>) {
    let names = |files: &BTreeMap<String, Vec<u8>>| files.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(a), names(b));
    for (name, bytes) in a {
        assert!(*bytes == b[name], "{name} differs");
    }
}

/// A table's rows by its heads.
fn table(files: &BTreeMap<String, Vec<u8>>, name: &str) -> Vec<BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_reader(files[name].as_slice());
    reader.deserialize().map(Result::unwrap).collect()
}

fn json(files: &BTreeMap<String, Vec<u8>>, name: &str) -> serde_json::Value {
    serde_json::from_slice(&files[name]).unwrap()
}

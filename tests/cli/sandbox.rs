//! A folder to run the program in, and what must be true of it afterwards.

use std::path::{Path, PathBuf};
use std::process::Output;

use assert_cmd::Command;
use serde_json::Value;

/// One straight channel: what it holds is known in closed form.
pub(crate) const STRAIGHT: &str = r#"
name = "Straight"
[domain]
x = [0, 600]
y = [0, 400]
z = [-20, 0]
facies = "mud"
[facies.mud]
[facies.sand]
[[feature]]
id = "ditch"
kind = "channel"
facies = "sand"
width = 60
depth = 8
top = -4
asymmetry = 0.2
origin = "top-centre"
trajectory = { kind = "line", from = [0, 200], to = [600, 200] }
"#;

/// A folder with a model in it, and a folder for temporary files that nothing else uses.
pub(crate) struct Sandbox {
    folder: tempfile::TempDir,
    temporary: tempfile::TempDir,
}

impl Sandbox {
    /// With this text as `model.toml`.
    pub(crate) fn new(model: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("model.toml"), model).unwrap();
        Self {
            folder,
            temporary: tempfile::tempdir().unwrap(),
        }
    }

    /// With a model of the project as `model.toml`.
    pub(crate) fn of(model: &str) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("models")
            .join(model);
        Self::new(&std::fs::read_to_string(path).unwrap())
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Where the program puts what is nobody's business.
    pub(crate) fn temporary(&self) -> &Path {
        self.temporary.path()
    }

    /// The program, in this folder, without a terminal.
    pub(crate) fn command(&self) -> Command {
        Command::from_std(self.std_command())
    }

    pub(crate) fn std_command(&self) -> std::process::Command {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_clinothem"));
        command
            .current_dir(self.folder.path())
            .env("TMPDIR", self.temporary.path());
        command
    }

    /// Runs the program with arguments separated by spaces.
    pub(crate) fn run(&self, arguments: &str) -> Output {
        self.command()
            .args(arguments.split_whitespace())
            .output()
            .unwrap()
    }

    /// Runs what must succeed, and gives its standard output. Notes on the model are no complaints.
    pub(crate) fn answer(&self, arguments: &str) -> String {
        let output = self.run(arguments);
        let errors = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(0), "{arguments}: {errors}");
        let complaint = errors.lines().find(|line| !line.starts_with("note: "));
        assert_eq!(complaint, None, "{arguments} has nothing to complain about");
        String::from_utf8(output.stdout).unwrap()
    }

    /// The same, read as one JSON document.
    pub(crate) fn json(&self, arguments: &str) -> Value {
        let text = self.answer(arguments);
        serde_json::from_str(&text).unwrap_or_else(|error| panic!("{arguments}: {error}\n{text}"))
    }

    /// Runs what must fail with this code, and gives its complaint. Nothing may be left behind.
    pub(crate) fn refusal(&self, arguments: &str, code: i32) -> String {
        let before = self.files();
        let output = self.run(arguments);
        let errors = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(code), "{arguments}: {errors}");
        assert!(!errors.contains("panicked"), "{arguments}: {errors}");
        assert!(!errors.trim().is_empty(), "{arguments}: no reason given");
        let stdout = String::from_utf8(output.stdout).unwrap();
        assert_eq!(stdout, "", "{arguments}: a failure has no results");
        assert_eq!(self.files(), before, "{arguments} left files");
        self.assert_no_temporaries();
        errors
    }

    /// Everything in the folder: paths with contents, folders with none.
    pub(crate) fn files(&self) -> Vec<(PathBuf, Option<Vec<u8>>)> {
        let mut found = Vec::new();
        list(self.folder.path(), &mut found);
        found.sort();
        found
    }

    pub(crate) fn assert_no_temporaries(&self) {
        let mut found = Vec::new();
        list(self.temporary.path(), &mut found);
        assert!(found.is_empty(), "left in TMPDIR: {found:?}");
    }
}

fn list(folder: &Path, found: &mut Vec<(PathBuf, Option<Vec<u8>>)>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            list(&path, found);
            found.push((path, None));
        } else {
            let bytes = std::fs::read(&path).unwrap();
            found.push((path, Some(bytes)));
        }
    }
}

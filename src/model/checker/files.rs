//! Files that models name: what they hold, or why that cannot be read.

use std::fmt::Write as _;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use super::Checker;
use crate::model::tree::{NodeId, quoted};

/// Larger files are refused.
const LARGEST: u64 = 1 << 30;

impl Checker<'_> {
    /// What a file holds; that it cannot be read is a defect of the node that names it.
    pub(crate) fn bytes_of(&self, node: NodeId, what: &str, file: &str) -> Option<Vec<u8>> {
        let path = self.folder.join(file);
        let read = || -> std::io::Result<Result<Vec<u8>, String>> {
            let metadata = std::fs::metadata(&path)?;
            if !metadata.is_file() {
                return Ok(Err("this is no file".to_owned()));
            }
            if metadata.len() > LARGEST {
                let size = metadata.len();
                return Ok(Err(format!(
                    "the file has {size} bytes, more than the {LARGEST} that may be"
                )));
            }
            let mut bytes = Vec::new();
            std::fs::File::open(&path)?
                .take(LARGEST)
                .read_to_end(&mut bytes)?;
            Ok(Ok(bytes))
        };
        let problem = match read() {
            Ok(Ok(bytes)) => return Some(bytes),
            Ok(Err(problem)) => problem,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                "there is no such file".to_owned()
            }
            Err(error) => format!("the file cannot be read: {error}"),
        };
        let remedy = if Path::new(file).is_absolute() {
            "check the path".to_owned()
        } else {
            let folder = absolute(&self.folder);
            format!(
                "its path begins at the model file's folder, {}",
                folder.display()
            )
        };
        let file = quoted(file);
        self.reader
            .wrong(node, format!("{what}: {file}: {problem}"), remedy);
        None
    }
}

/// The SHA-256 of what a file holds, in hexadecimal digits.
pub(crate) fn sha256(bytes: &[u8]) -> String {
    hexadecimal(&Sha256::digest(bytes))
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}

/// A folder as people look for it.
fn absolute(folder: &Path) -> PathBuf {
    // The working directory has no name of its own.
    let folder = if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    };
    std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned())
}

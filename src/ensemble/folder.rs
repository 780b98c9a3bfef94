//! The folder of an ensemble: which realisations are made, and whole.
//!
//! ```text
//! ensemble.json               what it is an ensemble of
//! realisations/0001/          what a build writes, and record.json with checksums
//! .unfinished-XXXXXX/         what is in the making, below a lock
//! ```
//! A realisation is made in the folder of unfinished files and then renamed as a whole, so wherever the program is killed, a
//! realisation is there or not. Whatever became of it since (a copy that ended half-way, an editor), its checksums tell: one that
//! they do not fit is made again.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::member::{Member, hexadecimal};
use crate::assembly::unfinished::{self, Unfinished};
use crate::export::file;

/// What says what the folder is; its presence marks a folder of ours.
const MANIFEST: &str = "ensemble.json";
/// What the names of folders of unfinished files begin with.
const UNFINISHED: &str = ".unfinished-";
/// The realisations.
const REALISATIONS: &str = "realisations";
/// What is kept of one.
const RECORD: &str = "record.json";
/// What of one differs from run to run, so that it has no checksum.
const RUN: &str = "run.json";

/// What all realisations of an ensemble have in common: text by key, so that a difference can be named.
pub type Manifest = BTreeMap<String, serde_json::Value>;

/// How a realisation ended, if it would end so again.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Settled {
    /// It was made.
    Made,
    /// The program refused it: it is no model, or could not be proven.
    Refused {
        /// The exit code.
        code: i32,
        /// The program's words.
        words: String,
    },
}

/// What is kept of a realisation.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Record {
    /// What tells it from every other one.
    pub key: String,
    /// The arguments that make it.
    pub arguments: Vec<String>,
    /// How it ended.
    pub outcome: Settled,
    /// The SHA-256 of each of its files, but of what differs from run to run.
    pub files: BTreeMap<String, String>,
}

/// Why a folder cannot hold an ensemble.
#[derive(Debug, thiserror::Error)]
pub enum FolderError {
    /// It is a file.
    #[error("{} is a file; name a folder with -o", .0.display())]
    IsFile(PathBuf),
    /// It holds other things.
    #[error(
        "the folder {} holds things that are no ensemble; name another one with -o, or add --force (nothing but an ensemble's files is replaced)",
        .0.display()
    )]
    Foreign(PathBuf),
    /// It holds another ensemble.
    #[error(
        "the folder {} holds an ensemble with another {differs}; name another one with -o, or add --force, which removes its realisations",
        path.display()
    )]
    Another {
        /// The folder.
        path: PathBuf,
        /// What is not the same.
        differs: String,
    },
    /// Another process is at work in it.
    #[error("another ensemble is writing to the folder {}; wait until it has ended, or name another one with -o", .0.display())]
    InUse(PathBuf),
    /// The system refuses.
    #[error("cannot use {}: {source}", path.display())]
    Io {
        /// What.
        path: PathBuf,
        /// The system's words.
        source: io::Error,
    },
}

/// A folder that is ours to write to as long as this lives.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    staging: Unfinished,
}

impl Folder {
    /// Opens the folder, which may be new, for an ensemble; what killed runs have left unfinished in it is removed. With
    /// `force` it may hold other things, and the realisations of another ensemble are removed.
    pub fn open(path: &Path, manifest: &Manifest, force: bool) -> Result<Self, FolderError> {
        let failed = |source: io::Error| FolderError::Io {
            path: path.to_owned(),
            source,
        };
        if path.exists() && !path.is_dir() {
            return Err(FolderError::IsFile(path.to_owned()));
        }
        fs::create_dir_all(path).map_err(failed)?;
        if unfinished::clear(path, UNFINISHED).map_err(failed)?.in_use > 0 {
            return Err(FolderError::InUse(path.to_owned()));
        }
        let marked = path.join(MANIFEST).is_file();
        let is_empty = fs::read_dir(path).map_err(failed)?.next().is_none();
        if !marked && !is_empty && !force {
            return Err(FolderError::Foreign(path.to_owned()));
        }
        let staging = Unfinished::new(path, UNFINISHED).map_err(failed)?;
        // Both may have looked before either had its lock; then both find the other's, and neither goes on.
        if unfinished::clear(path, UNFINISHED).map_err(failed)?.in_use > 1 {
            return Err(FolderError::InUse(path.to_owned()));
        }
        if let Some(differs) = marked.then(|| difference(path, manifest)).flatten() {
            if !force {
                let path = path.to_owned();
                return Err(FolderError::Another { path, differs });
            }
            let old = path.join(REALISATIONS);
            if old.is_dir() {
                fs::remove_dir_all(&old).map_err(failed)?;
            }
        }
        let folder = Self {
            path: path.to_owned(),
            staging,
        };
        let text = serde_json::to_string_pretty(manifest).map_err(|e| failed(e.into()))? + "\n";
        folder
            .write(MANIFEST, text.as_bytes())
            .and_then(|()| fs::create_dir_all(folder.realisations()))
            .map_err(failed)?;
        Ok(folder)
    }

    fn realisations(&self) -> PathBuf {
        self.path.join(REALISATIONS)
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Where a member's realisation is, once it is made.
    pub fn of(&self, member: &Member) -> PathBuf {
        self.realisations().join(member.name())
    }

    /// Where a member's realisation is made.
    pub fn unfinished(&self, member: &Member) -> PathBuf {
        self.staging.path().join(member.name().replace('/', "."))
    }

    /// Writes a file that is whole or not there; what a run that is killed leaves of it goes with what else it left unfinished.
    pub fn write(&self, name: &str, bytes: &[u8]) -> io::Result<()> {
        let unfinished = self.staging.path().join(name);
        fs::write(&unfinished, bytes)?;
        file::readable(&unfinished)?;
        fs::rename(unfinished, self.path.join(name))
    }

    /// What is kept of a member that is settled, if every file of it is as it was written.
    pub fn settled(&self, member: &Member, key: &str) -> Option<Record> {
        let folder = self.of(member);
        // Whatever is not as it should be is made again, so no reason is asked for.
        let record = fs::read(folder.join(RECORD)).ok()?;
        let record: Record = serde_json::from_slice(&record).ok()?;
        let is_whole = record.key == key && checksums(&folder).ok()? == record.files;
        is_whole.then_some(record)
    }

    /// Puts what was made of a member in its place.
    pub fn settle(&self, member: &Member, key: String, outcome: Settled) -> io::Result<()> {
        let from = self.unfinished(member);
        if outcome != Settled::Made && from.exists() {
            fs::remove_dir_all(&from)?;
        }
        fs::create_dir_all(&from)?;
        let record = Record {
            key,
            arguments: member.arguments(),
            outcome,
            files: checksums(&from)?,
        };
        let text = serde_json::to_string_pretty(&record)? + "\n";
        file::write(&from.join(RECORD), [text.as_bytes()])?;
        let to = self.of(member);
        if to.exists() {
            fs::remove_dir_all(&to)?;
        }
        if let Some(parent) = to.parent() {
            fs::create_dir_all(parent)?;
        }
        fs::rename(from, to)
    }

    /// Removes what is left of a member that was not made.
    pub fn forget(&self, member: &Member) -> io::Result<()> {
        let from = self.unfinished(member);
        if from.exists() {
            fs::remove_dir_all(from)?;
        }
        let made = self.of(member);
        if made.exists() {
            fs::remove_dir_all(made)?;
        }
        Ok(())
    }
}

/// What the ensemble in a folder has in another way than this one, in words.
fn difference(path: &Path, manifest: &Manifest) -> Option<String> {
    let found = fs::read(path.join(MANIFEST)).ok();
    let found: Option<Manifest> = found.and_then(|bytes| serde_json::from_slice(&bytes).ok());
    let Some(found) = found else {
        return Some("`ensemble.json`, which cannot be read".to_owned());
    };
    let keys = manifest.keys().chain(found.keys());
    let mut differing: Vec<&str> = keys
        .filter(|key| manifest.get(*key) != found.get(*key))
        .map(String::as_str)
        .collect();
    differing.sort_unstable();
    differing.dedup();
    (!differing.is_empty()).then(|| differing.join(", "))
}

/// The checksum of each file in a folder.
fn checksums(folder: &Path) -> io::Result<BTreeMap<String, String>> {
    let mut files = BTreeMap::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        if [RECORD, RUN].contains(&name.as_str()) {
            continue;
        }
        let mut hash = Sha256::new();
        io::copy(&mut fs::File::open(entry.path())?, &mut Hashing(&mut hash))?;
        files.insert(name, hexadecimal(&hash.finalize()));
    }
    Ok(files)
}

struct Hashing<'a>(&'a mut Sha256);

impl io::Write for Hashing<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::super::member::Changes;
    use super::*;

    fn member(number: usize) -> Member {
        Member {
            number,
            scenario: None,
            seed: 5,
            stratum: None,
            design: Vec::new(),
            changes: Changes::default(),
        }
    }

    fn manifest(model: &str) -> Manifest {
        BTreeMap::from([("model".to_owned(), model.into())])
    }

    fn make(folder: &Folder, member: &Member, text: &str) {
        let place = folder.unfinished(member);
        fs::create_dir_all(&place).unwrap();
        fs::write(place.join("report.json"), text).unwrap();
        fs::write(place.join(RUN), "7 s").unwrap();
        folder
            .settle(member, member.key("c"), Settled::Made)
            .unwrap();
    }

    #[test]
    fn what_is_whole_is_kept_and_what_is_not_is_not() {
        let place = tempfile::tempdir().unwrap();
        let path = place.path().join("deep/er");
        let one = member(1);
        let key = one.key("c");
        let folder = Folder::open(&path, &manifest("a"), false).unwrap();
        assert_eq!(folder.settled(&one, &key), None);
        make(&folder, &one, "whole");
        let record = folder.settled(&one, &key).unwrap();
        assert_eq!(record.outcome, Settled::Made);
        // The clock is no part of it; what else is changed, cut, added or lost is.
        let made = folder.of(&one);
        fs::write(made.join(RUN), "8 s").unwrap();
        assert!(folder.settled(&one, &key).is_some());
        assert_eq!(folder.settled(&one, &one.key("another model")), None);
        fs::write(made.join("report.json"), "whol").unwrap();
        assert_eq!(folder.settled(&one, &key), None);
        make(&folder, &one, "whole");
        fs::write(made.join("more"), "").unwrap();
        assert_eq!(folder.settled(&one, &key), None);
        make(&folder, &one, "whole");
        fs::remove_file(made.join("report.json")).unwrap();
        assert_eq!(folder.settled(&one, &key), None);
        make(&folder, &one, "whole");
        fs::write(made.join(RECORD), "{").unwrap();
        assert_eq!(folder.settled(&one, &key), None);
    }

    #[test]
    fn one_process_alone_works_in_a_folder_and_the_next_clears_what_was_left() {
        let place = tempfile::tempdir().unwrap();
        let path = place.path();
        let folder = Folder::open(path, &manifest("a"), false).unwrap();
        let staged = folder.unfinished(&member(1));
        fs::create_dir_all(&staged).unwrap();
        let second = Folder::open(path, &manifest("a"), false);
        assert!(matches!(second, Err(FolderError::InUse(_))), "{second:?}");
        assert!(staged.is_dir());
        // As a process that is killed does: the lock goes, the folder stays.
        let left = path.join(".unfinished-left");
        fs::create_dir_all(left.join("0001")).unwrap();
        fs::write(left.join("clinothem.lock"), "").unwrap();
        drop(folder);
        Folder::open(path, &manifest("a"), false).unwrap();
        assert!(!left.exists());
    }

    #[test]
    fn another_ensemble_or_other_things_are_left_alone_unless_forced() {
        let place = tempfile::tempdir().unwrap();
        let one = member(1);
        let folder = Folder::open(place.path(), &manifest("a"), false).unwrap();
        make(&folder, &one, "whole");
        drop(folder);
        let other = Folder::open(place.path(), &manifest("b"), false);
        assert!(other.unwrap_err().to_string().contains("another model"));
        let forced = Folder::open(place.path(), &manifest("b"), true).unwrap();
        assert!(!forced.of(&one).exists());
        let thesis = tempfile::tempdir().unwrap();
        fs::write(thesis.path().join("thesis"), "ten years of work").unwrap();
        let error = Folder::open(thesis.path(), &manifest("a"), false).unwrap_err();
        assert!(matches!(error, FolderError::Foreign(_)));
        let file = thesis.path().join("thesis");
        let error = Folder::open(&file, &manifest("a"), true).unwrap_err();
        assert!(matches!(error, FolderError::IsFile(_)));
    }
}

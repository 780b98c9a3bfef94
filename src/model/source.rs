//! The text of a model, and the overrides given with it.

use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::parameters::Parameters;
use super::place::Place;
use super::solids::SolidReader;

/// Larger files are refused: a model file is written by hand or by a small script.
pub const LARGEST_FILE: u64 = 64 * 1024 * 1024;

/// How a model is written down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// TOML.
    Toml,
    /// JSON of the same schema.
    Json,
}

/// The text of a model with the overrides given for it.
#[derive(Clone, Debug)]
pub struct Source {
    pub(crate) name: String,
    pub(crate) text: String,
    pub(crate) format: Format,
    pub(crate) assignments: Vec<String>,
    pub(crate) parameters: Option<Parameters>,
    /// Where the paths of files that the model names begin.
    pub(crate) folder: PathBuf,
    /// Reads solids of CAD programs.
    pub(crate) solids: Option<SolidReader>,
}

/// Why a model file could not be read.
#[derive(Debug, Error)]
pub enum ReadError {
    /// There is no such file.
    #[error("{}: there is no such file; check the path, or make a model with `clinothem new`", path.display())]
    Missing {
        /// The path given.
        path: PathBuf,
    },
    /// The path leads to a directory.
    #[error("{}: this is a directory; name the model file inside it", path.display())]
    Directory {
        /// The path given.
        path: PathBuf,
    },
    /// The file is too large.
    #[error("{}: the file has {size} bytes, more than the {LARGEST_FILE} that a model file may have; is it a model file?", path.display())]
    TooLarge {
        /// The path given.
        path: PathBuf,
        /// Its size in bytes.
        size: u64,
    },
    /// The file holds no text.
    #[error(
        "{place}: the file is binary (it contains a zero byte); a model file is text in TOML or JSON"
    )]
    Binary {
        /// Where the zero byte is.
        place: Place,
    },
    /// The file is not UTF-8.
    #[error("{place}: the byte {byte:#04x} is not UTF-8; save the file as UTF-8")]
    NotUtf8 {
        /// Where the byte is.
        place: Place,
        /// The byte.
        byte: u8,
    },
    /// The system refused to read the file.
    #[error("{}: the file cannot be read", path.display())]
    Io {
        /// The path given.
        path: PathBuf,
        /// The system's words.
        source: std::io::Error,
    },
}

impl Source {
    /// Reads a model file: JSON if its name ends in `.json`, else TOML.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ReadError> {
        let path = path.as_ref();
        let bytes = bytes_of(path)?;
        let name = path.display().to_string();
        let text = text_of(&name, bytes)?;
        let json = path
            .extension()
            .is_some_and(|extension| extension.eq_ignore_ascii_case("json"));
        let format = if json { Format::Json } else { Format::Toml };
        let folder = path.parent().map(Path::to_owned).unwrap_or_default();
        Ok(Self::from_text(name, text, format).in_folder(folder))
    }

    /// Reads a model from a stream, such as standard input: JSON if it begins with `{`, else TOML; `name` stands in messages as
    /// its file.
    pub fn read_stream(name: &str, stream: impl std::io::Read) -> Result<Self, ReadError> {
        let bytes = all_of(Path::new(name), stream)?;
        let text = text_of(name, bytes)?;
        let first = text.trim_start_matches('\u{feff}').trim_start();
        // No TOML begins with a brace.
        let format = if first.starts_with('{') {
            Format::Json
        } else {
            Format::Toml
        };
        Ok(Self::from_text(name, text, format))
    }

    /// A model that is in memory already; `name` stands in messages as its file.
    pub fn from_text(name: impl Into<String>, text: impl Into<String>, format: Format) -> Self {
        let mut text = text.into();
        if text.starts_with('\u{feff}') {
            text.drain(..'\u{feff}'.len_utf8());
        }
        Self {
            name: name.into(),
            text,
            format,
            assignments: Vec::new(),
            parameters: None,
            folder: PathBuf::new(),
            solids: None,
        }
    }

    /// Lets the paths of files that the model names begin at a folder: that of the model file, unless it is said; of a model from a
    /// stream or from memory, the working directory.
    #[must_use]
    pub fn in_folder(mut self, folder: impl Into<PathBuf>) -> Self {
        self.folder = folder.into();
        self
    }

    /// Lets solids of CAD programs be read by the kernel (`assembly::read_solid`), or by another reader; without one, a model that names
    /// such a file has a defect.
    #[must_use]
    pub fn with_solids(mut self, reader: SolidReader) -> Self {
        self.solids = Some(reader);
        self
    }

    /// Overrides a value, as `feature.channel.width=30`, `domain.z=[-80, 0]` or `seed=9`.
    ///
    /// The path names tables and keys, and features by id; the value is written as in TOML (the quotes around a single
    /// word may be left out). It is applied, and checked, by [`Model::check`](super::Model::check); later overrides win.
    pub fn set(&mut self, assignment: impl Into<String>) {
        self.assignments.push(assignment.into());
    }

    /// Takes values from a file of parameters; overrides win.
    pub fn set_parameters(&mut self, parameters: Parameters) {
        self.parameters = Some(parameters);
    }

    /// The name of the file.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The text of the file, without overrides.
    pub fn text(&self) -> &str {
        &self.text
    }
}

fn bytes_of(path: &Path) -> Result<Vec<u8>, ReadError> {
    let io = |source: std::io::Error| {
        let path = path.to_owned();
        if source.kind() == std::io::ErrorKind::NotFound {
            ReadError::Missing { path }
        } else {
            ReadError::Io { path, source }
        }
    };
    let metadata = std::fs::metadata(path).map_err(io)?;
    if metadata.is_dir() {
        return Err(ReadError::Directory {
            path: path.to_owned(),
        });
    }
    if metadata.len() > LARGEST_FILE {
        return Err(too_large(path, metadata.len()));
    }
    all_of(path, File::open(path).map_err(io)?)
}

/// All that a stream holds; a pipe has no length, so the limit holds for what is read too.
fn all_of(path: &Path, stream: impl std::io::Read) -> Result<Vec<u8>, ReadError> {
    let mut bytes = Vec::new();
    stream
        .take(LARGEST_FILE + 1)
        .read_to_end(&mut bytes)
        .map_err(|source| ReadError::Io {
            path: path.to_owned(),
            source,
        })?;
    let size = bytes.len() as u64;
    if size > LARGEST_FILE {
        return Err(too_large(path, size));
    }
    Ok(bytes)
}

fn too_large(path: &Path, size: u64) -> ReadError {
    ReadError::TooLarge {
        path: path.to_owned(),
        size,
    }
}

fn text_of(name: &str, bytes: Vec<u8>) -> Result<String, ReadError> {
    let place = |offset: usize| {
        let before = String::from_utf8_lossy(&bytes[..offset]);
        let line = before.rsplit('\n').next().unwrap_or_default();
        Place {
            file: name.to_owned(),
            line: before.matches('\n').count() + 1,
            column: line.chars().count() + 1,
        }
    };
    if let Some(offset) = bytes.iter().position(|&byte| byte == 0) {
        return Err(ReadError::Binary {
            place: place(offset),
        });
    }
    match std::str::from_utf8(&bytes) {
        Ok(_) => {}
        Err(error) => {
            let offset = error.valid_up_to();
            return Err(ReadError::NotUtf8 {
                place: place(offset),
                byte: bytes[offset],
            });
        }
    }
    String::from_utf8(bytes).map_err(|error| ReadError::NotUtf8 {
        place: Place {
            file: name.to_owned(),
            ..Place::default()
        },
        byte: error.as_bytes().first().copied().unwrap_or_default(),
    })
}

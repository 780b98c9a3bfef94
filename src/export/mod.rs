//! Export: one output format per file.

#[cfg(feature = "occt")]
pub mod bodies;
#[cfg(feature = "occt")]
pub mod brep;
pub mod data;
pub mod file;
#[cfg(feature = "occt")]
pub mod mesh;
pub mod picture;
#[cfg(feature = "occt")]
pub mod report;
#[cfg(feature = "occt")]
pub mod step;
#[cfg(feature = "occt")]
pub mod table;
#[cfg(feature = "occt")]
mod text;
pub mod wells;

/// Why a file could not be written.
#[cfg(feature = "occt")]
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// The kernel could not write or convert.
    #[error("{what}: {message}")]
    Kernel {
        /// What was being written.
        what: &'static str,
        /// The kernel's words.
        message: String,
    },
    /// A surface could not be handed over.
    #[error("{volume}: its ends cannot be closed: {source}")]
    Surface {
        /// The volume's name.
        volume: String,
        /// Why.
        source: crate::nurbs::SurfaceError,
    },
    /// What a STEP file was to hold does not fit together.
    #[error("STEP: {0}")]
    Step(String),
    /// The system could not write a file.
    #[error("cannot write {path}: {source}")]
    File {
        /// The file.
        path: std::path::PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A table could not be written.
    #[error("{0}")]
    Table(String),
}

//! Export: one output format per file.

#[cfg(feature = "occt")]
pub mod bodies;
#[cfg(feature = "occt")]
#[cfg(feature = "occt")]
pub mod brep;
pub mod cps3;
pub mod data;
pub mod file;
#[cfg(feature = "occt")]
pub mod glb;
pub mod grid;
#[cfg(feature = "occt")]
pub mod heights;
pub mod irap;
#[cfg(feature = "occt")]
pub mod mesh;
#[cfg(feature = "occt")]
pub mod numbers;
#[cfg(feature = "occt")]
pub mod obj;
#[cfg(feature = "occt")]
pub mod part;
pub mod picture;
#[cfg(feature = "occt")]
pub mod ply;
#[cfg(feature = "occt")]
pub mod report;
pub mod rows;
#[cfg(feature = "occt")]
pub mod sheets;
#[cfg(feature = "occt")]
pub mod step;
#[cfg(feature = "occt")]
pub mod stl;
pub mod table;
mod text;
#[cfg(feature = "occt")]
pub mod tsurf;
#[cfg(feature = "occt")]
pub mod vertical;
pub mod wells;
pub mod zmap;

#[cfg(feature = "occt")]
pub(crate) use text::ascii;

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
    /// There are no triangles.
    #[error("triangles: {0}")]
    Mesh(#[from] crate::mesh::MeshError),
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

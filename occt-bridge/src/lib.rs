//! OpenCASCADE operations that clinothem needs, as plain Rust types.
//!
//! Lengths are metres, areas square metres, volumes cubic metres; the kernel itself has no unit. Every operation returns a
//! [`Result`]: OpenCASCADE's exceptions, error alerts and empty results all become a [`BridgeError`].
//!
//! ```
//! # fn main() -> Result<(), occt_bridge::BridgeError> {
//! use occt_bridge::{Cancel, PartitionOptions, box_solid, partition, volume};
//! let block = box_solid([0.0, 0.0, 0.0], [4.0, 4.0, 1.0])?;
//! let body = box_solid([1.0, -1.0, 0.5], [2.0, 5.0, 2.0])?;
//! let cut = partition(&[block, body], &PartitionOptions::default(), &Cancel::new(), &|_| ())?;
//! // The younger body takes what lies inside the block; what is outside the block is dropped.
//! let owner: Vec<_> = cut.cells().iter().map(|c| if c.inside == [0, 1] { Some(1) } else { c.inside.contains(&0).then_some(0) }).collect();
//! let solids = cut.merge(&owner)?;
//! assert_eq!(solids.solids().len(), 2);
//! let total: f64 = (0..2).map(|i| volume(&solids.shape_of(i)?, 1e-9)).sum::<Result<f64, _>>()?;
//! assert!((total - 16.0).abs() < 1e-9);
//! # Ok(())
//! # }
//! ```

mod assembled;
mod body;
mod boundary;
mod brep;
mod bytes;
mod cells;
mod check;
mod error;
mod ffi;
mod geometry;
mod making;
mod measure;
mod merge;
mod monitor;
mod partition;
mod shape;
mod solids;
mod step;
mod tables;
mod threads;
mod topology;

pub use assembled::{OnSurface, TableEdge, TableFace, TableSolid, TableVertex, Tables};
pub use body::{Body, BodyError, BodyFormat, read_body};
pub use boundary::{
    Boundary, BoundaryEdge, BoundaryFace, BoundaryShape, BoundaryUse, Path, Shell, boundary,
};
pub use brep::{read_brep, write_brep};
pub use cells::{Cell, FaceOrigin, PartitionFace};
pub use check::{Defect, defects};
pub use error::BridgeError;
pub use geometry::{Curve, Pcurve, Surface};
pub use making::{box_solid, faces, solid};
pub use measure::{
    Bounds, Classifier, FaceIntegral, FaceSample, Position, area, bounds, face_integrals,
    face_samples, solid_boxes, volume,
};
pub use monitor::Cancel;
pub use partition::{Partition, PartitionOptions, UNUSED_FACES, partition};
pub use shape::{Shape, ShapeKind, compound, version};
pub use solids::{Solid, SolidFace, Solids};
pub use step::{LengthUnit, ReadPart, read_step, read_step_in};
pub use threads::{Threads, set_threads};
pub use topology::{Edge, EdgeUse, Face, Topology};

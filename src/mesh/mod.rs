//! Triangles of faces: fine enough for their surfaces, and with the same points wherever two faces meet.
//!
//! ```text
//!  tables.rs        what is triangulated
//!  fineness.rs      how far chords may be from surfaces, and how much these may turn
//!  divide.rs        edges: each divided once, for all faces at it
//!  outline.rs       a face's loops as polygons in its surface's parameters
//!  lines.rs         lines of equal u and v that suffice for a surface
//!  grid.rs          their crossings inside a face
//!  planar.rs        constrained Delaunay triangulations
//!  face.rs          triangles of one face, refined where they are too far from its surface
//!  triangulate.rs   all edges, all faces; chords that cross are halved
//!  triangles.rs     the result; whether it closes, and what it encloses
//! ```
//!
//! Parameters are scaled so that cells of lines are squares: along a channel of kilometres and across it triangles are as long as
//! the surface allows in each direction. Points are never compared by their coordinates: a body is closed because
//! its faces are.

mod divide;
mod face;
mod fineness;
mod grid;
mod lines;
mod outline;
mod planar;
mod tables;
mod triangles;
mod triangulate;

pub use fineness::Fineness;
pub use tables::{Edge, Face, Path, Support, Tables, Use};
pub use triangles::{Corner, Counts, FaceMesh, Mesh, Open, Used};
pub use triangulate::{MOST_POINTS, MeshError, triangulate};

#[cfg(test)]
mod tests;

//! The command line as its users meet it: the real program, its exit codes, streams and files.
#![cfg(all(feature = "occt", unix))]
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod abandoned;
mod answers;
mod draws;
mod failures;
mod grids;
mod interrupted;
mod names;
mod notes;
mod parameters;
mod rock;
mod sandbox;
mod tables;
mod triangles;

//! The house stands as ARCHITECTURE.md says: imports go downward only, none goes in a circle, and one file names the kernel.
//!
//! The features of Cargo prove that the lower layers build without the kernel; this finds the rest. It reads the code's tokens,
//! not its meaning: what is named by a path or imported is seen, a method that another file gives to a type is not. `cargo modules`
//! and `cargo cycles` know more, but neither knows layers, nor which circles are known.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod circles;
mod layers;
mod names;
mod tree;

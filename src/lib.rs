//! Surface-based geological reservoir modelling without a grid.
#![forbid(unsafe_code)]

#[cfg(feature = "occt")]
pub mod assembly;
pub mod cli;
pub mod data;
#[cfg(feature = "occt")]
pub mod ensemble;
pub mod export;
pub mod features;
pub mod model;
pub mod nurbs;
pub mod partition;

//! Surface-based geological reservoir modelling without a grid.
#![forbid(unsafe_code)]

pub mod features;
pub mod nurbs;

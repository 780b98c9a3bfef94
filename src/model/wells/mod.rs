//! Wells of a model: their tables, their surveys, and what they pass through.
//!
//! They are no features: nothing is removed or drawn by them. Their paths are made when the model is checked, and what they pass through
//! follows from a realisation and its point evaluator.

pub(crate) mod file;
mod laterals;
pub mod log;
pub mod misfit;
mod read;
pub mod spec;
mod stations;
mod survey;
mod tops;

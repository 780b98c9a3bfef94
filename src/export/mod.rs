//! What the model is written to: one output format per file.

pub mod picture;

//! Wells in results: what they pass through as entries of reports and as logs, and their paths.

pub mod entries;
pub mod gocad;
pub mod las;
pub mod pline;

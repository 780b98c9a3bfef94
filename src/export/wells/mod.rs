//! Wells in results: what they pass through as entries of reports, as tables and as logs.

pub mod entries;
pub mod gocad;
pub mod las;
pub mod table;

//! Ensembles: many realisations of one model, each made by a process of its own, and what they are as a whole.
//!
//! ```text
//! members ──▶ folder: which are made? ──▶ workers: a process each ──▶ folder ──▶ summary
//! ```
//! A [`Member`] says everything that its realisation depends on, so it has the same bytes whenever, wherever and in whichever
//! order it is made. A realisation is in the [`folder`] as a whole or not at all; what was made is verified by its
//! checksums when an ensemble goes on. The [`summary`] reads the reports, and knows no more of a realisation than these say.

pub mod design;
pub mod folder;
pub mod member;
pub mod statistics;
pub mod summary;
pub mod workers;

pub use member::Member;

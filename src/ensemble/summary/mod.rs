//! What an ensemble is as a whole: a table of all realisations, quantiles, what decides the result, plots and a page.
//!
//! All of it is made from the realisations' reports, and is the same whatever the order in which they were made.

mod columnar;
mod columns;
mod explorer;
mod page;
mod plots;
mod tables;
mod whole;

pub use columnar::parquet;
pub use columns::{Column, Role, Table, Told, measures};
pub use page::{Sheet, page};
pub use plots::{Plot, PlotError, plots};
pub use tables::{correlations, quantiles, realisations, unmade};
pub use whole::{Correlation, OfScenario, Summary, SummaryError, TORNADO, Unmade};

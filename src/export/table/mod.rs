//! Tables of a build, for spreadsheets and scripts: as CSV, a file each, and as one workbook (XLSX).
//!
//! Both hold the same sheets: what stands in a column's name as its unit, and every number, is the same in either.

mod cell;
mod csv;
#[cfg(feature = "occt")]
mod sheets;
mod wells;
#[cfg(feature = "occt")]
mod xlsx;

pub use self::csv::csv;
pub use cell::{Cell, Sheet};
#[cfg(feature = "occt")]
pub use sheets::{VOLUMES, sheets, volumes};
pub use wells::{WELLS, wells};
#[cfg(feature = "occt")]
pub use xlsx::xlsx;

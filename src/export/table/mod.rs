//! Tables of a build, for spreadsheets and scripts: as CSV, a file each, and as one workbook (XLSX).
//!
//! Both hold the same sheets: what stands in a column's name as its unit, and every number, is the same in either.

mod cell;
mod csv;
mod sheets;
mod wells;
mod xlsx;

pub use self::csv::csv;
pub use cell::{Cell, Sheet};
pub use sheets::{VOLUMES, sheets, volumes};
pub use wells::{WELLS, wells};
pub use xlsx::xlsx;

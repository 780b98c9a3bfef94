//! Small pictures of a realisation, for the contact sheets of an ensemble.

use std::path::Path;

use super::args::ModelArgs;
use super::engine::Built;
use super::failure::Failure;
use super::section::{self, Cells};
use super::{files, picture, view};

/// What contact sheets show.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, clap::ValueEnum)]
pub(super) enum Picture {
    /// The section through the middle of the domain, from west to east.
    Section,
    /// A map halfway between the domain's base and top.
    Map,
    /// The solids from above.
    View,
}

/// Width of a picture (px).
const WIDTH: u32 = 300;
/// Width and height of a view.
const VIEW: [u32; 2] = [300, 190];
/// Two cells to a pixel across: outlines stay smooth.
const CELLS: Cells = Cells {
    columns: 600,
    rows: 200,
};

impl Picture {
    /// The name of the file in a realisation's folder, and of the sheet without its ending.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Section => "section",
            Self::Map => "map",
            Self::View => "view",
        }
    }

    /// What the pictures show, in words.
    pub(super) fn words(self) -> &'static str {
        match self {
            Self::Section => "sections through the middle, from west to east",
            Self::Map => "maps halfway between base and top",
            Self::View => "views from above",
        }
    }

    /// The file in a realisation's folder.
    pub(super) fn file(self) -> String {
        format!("{}.png", self.name())
    }
}

/// Draws what was built into its folder.
pub(super) fn write(
    pictures: &[Picture],
    model: &ModelArgs,
    built: Built,
    folder: &Path,
) -> Result<(), Failure> {
    if pictures.is_empty() {
        return Ok(());
    }
    let mut solids = None;
    if pictures.contains(&Picture::View) {
        solids = Some(view::solids(&built)?);
    }
    let loaded = built.into_loaded();
    let owners = loaded.owners()?;
    let middle = f64::midpoint(loaded.model.domain.z[0], loaded.model.domain.z[1]);
    for kind in pictures {
        let args = |map| section::Args::usual(model.clone(), map);
        let bytes = match kind {
            Picture::Section => section::section(&args(None), &loaded, &owners, CELLS)?.tile(WIDTH),
            Picture::Map => {
                section::map(&args(Some(middle)), &loaded, &owners, middle, CELLS)?.tile(WIDTH)
            }
            Picture::View => {
                let solids = solids.take().unwrap_or_default();
                Ok(view::tile(model.clone(), &loaded, solids, VIEW)?)
            }
        };
        let bytes = bytes.map_err(|error| picture::refused(&error))?;
        files::write(&folder.join(kind.file()), &bytes)?;
    }
    Ok(())
}

/// Most pictures on a sheet.
pub(super) const MOST: usize = 100;

/// Which of so many are shown where not all of them can be: as many as there may be, at equal steps.
pub(super) fn chosen(count: usize) -> Vec<usize> {
    let shown = count.min(MOST);
    (0..shown).map(|at| at * count / shown).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_are_shown_up_to_a_hundred_and_then_some_at_equal_steps() {
        assert_eq!(chosen(3), [0, 1, 2]);
        assert_eq!(chosen(0), [0; 0]);
        let of_many = chosen(1000);
        assert_eq!(of_many.len(), MOST);
        assert!(of_many.windows(2).all(|pair| pair[1] - pair[0] == 10));
    }
}

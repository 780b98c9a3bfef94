//! The formats of grids.

/// A format of grids.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Format {
    /// VTK's `ImageData`.
    Vti,
    /// `NumPy` arrays, a file each.
    Npy,
    /// GSLIB (Geo-EAS) text.
    Gslib,
    /// `SGeMS` text.
    Sgems,
    /// Eclipse's grid keywords.
    Grdecl,
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 5] = [Self::Vti, Self::Npy, Self::Gslib, Self::Sgems, Self::Grdecl];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Vti => "vti",
            Self::Npy => "npy",
            Self::Gslib => "gslib",
            Self::Sgems => "sgems",
            Self::Grdecl => "grdecl",
        }
    }

    /// Whether it can hold layers that are not level.
    pub fn holds_layers(self) -> bool {
        matches!(self, Self::Grdecl | Self::Npy)
    }
}

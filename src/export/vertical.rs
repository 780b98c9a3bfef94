//! Which way heights grow in files that other programs read.

/// What a file's z is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Vertical {
    /// Up, as in models.
    #[default]
    Elevation,
    /// Down.
    Depth,
}

impl Vertical {
    /// The number for an elevation (m).
    pub fn of(self, elevation: f64) -> f64 {
        match self {
            Self::Elevation => elevation,
            // Without a negative zero.
            Self::Depth => 0.0 - elevation,
        }
    }
}

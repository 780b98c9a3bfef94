//! How text looks: its family, size and weight.

/// The family that PNGs use, with what a browser may use instead.
pub(super) const FAMILY: &str =
    "'Noto Sans', 'DejaVu Sans', 'Segoe UI', Helvetica, Arial, sans-serif";

/// How a text looks: its size in pixels of the drawing, and whether it is bold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Style {
    pub(super) size: f64,
    pub(super) weight: Weight,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Weight {
    Regular,
    Bold,
}

pub(super) const fn regular(size: f64) -> Style {
    Style {
        size,
        weight: Weight::Regular,
    }
}

pub(super) const fn bold(size: f64) -> Style {
    Style {
        size,
        weight: Weight::Bold,
    }
}

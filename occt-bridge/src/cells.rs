//! Cells: what a partition divides space into, and where their faces come from.

/// An index and whether reversed.
pub(crate) type Side = (usize, bool);

/// A region that no argument's boundary divides further.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cell {
    /// Faces that bound it, by index into [`Partition::faces`](crate::Partition::faces), and whether reversed: a cell's faces look out of it.
    pub faces: Vec<(usize, bool)>,
    /// The arguments that contain it, in increasing order, as the kernel's history tells.
    pub inside: Vec<usize>,
}

/// A face of the partition.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PartitionFace {
    /// The faces of arguments that it is a piece of: more than one where arguments touch along it.
    pub origins: Vec<FaceOrigin>,
}

/// Where a face comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FaceOrigin {
    /// Index of the argument.
    pub argument: usize,
    /// Index of the face within it: as in [`Topology::faces`](crate::Topology::faces), or the order of [`crate::box_solid`].
    pub face: usize,
    /// Whether the face, not reversed, looks out of the argument. So a cell that uses the face with `reversed ==
    /// !same_orientation` lies inside the argument, and the one on the other side outside it.
    pub same_orientation: bool,
}

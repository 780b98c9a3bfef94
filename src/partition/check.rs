//! What went wrong, counted. A partition is used only if every count is zero.

use glam::DVec3;

use super::bounds::Bounds;

/// Where two regions' sheets are too near each other to tell how they lie.
#[derive(Clone, Debug, PartialEq)]
pub struct Doubt {
    /// The regions.
    pub regions: [usize; 2],
    /// Lower corner of a box that holds the place (m).
    pub low: DVec3,
    /// Upper corner (m).
    pub high: DVec3,
    /// Greatest distance between the sheets there, as far as it is known (m).
    pub gap: f64,
    /// What they do there.
    pub what: &'static str,
}

impl Doubt {
    fn bounds(&self) -> Bounds {
        Bounds {
            low: self.low,
            high: self.high,
        }
    }

    /// Whether it is one with another, within a distance.
    pub(super) fn is_beside(&self, other: &Self, reach: f64) -> bool {
        self.regions == other.regions && self.bounds().grown(reach).meets(&other.bounds())
    }

    pub(super) fn join(&mut self, other: &Self) {
        let both = self.bounds().and(other.bounds());
        (self.low, self.high) = (both.low, both.high);
        self.gap = self.gap.max(other.gap);
    }
}

/// Counts of what contradicts itself.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Faults {
    /// Places where curve and sheet, or two sheets, come too near to parallel to decide.
    pub undecided: usize,
    /// Branches that stop where their sheets touch.
    pub tangents: usize,
    /// Roots of edges that no branch of an adjacent sheet ends at.
    pub unused_roots: usize,
    /// Ends of branches on borders without a root.
    pub lost_ends: usize,
    /// Points of three sheets that not all three curves pass through.
    pub triples: usize,
    /// Pieces of curves whose sides contradict those before them.
    pub sides: usize,
    /// Half-edges without a next one.
    pub dead_ends: usize,
    /// Half-edges whose next one is not clear.
    pub ambiguous: usize,
    /// Loops with more than one pair of labels.
    pub mixed_loops: usize,
    /// Holes that lie in no face.
    pub homeless_holes: usize,
    /// Shells with more than one label.
    pub mixed_shells: usize,
    /// Voids that lie in no solid.
    pub homeless_voids: usize,
    /// Arcs along which a shell is not closed.
    pub open_shells: usize,
}

impl Faults {
    /// Every count with its name.
    pub fn counts(&self) -> [(&'static str, usize); 13] {
        [
            ("undecided contacts", self.undecided),
            ("tangential contacts", self.tangents),
            ("roots without a branch", self.unused_roots),
            ("branches without a root", self.lost_ends),
            ("inconsistent points of three sheets", self.triples),
            ("contradictory sides", self.sides),
            ("dead ends", self.dead_ends),
            ("ambiguous turns", self.ambiguous),
            ("loops with mixed labels", self.mixed_loops),
            ("holes without a face", self.homeless_holes),
            ("shells with mixed labels", self.mixed_shells),
            ("voids without a solid", self.homeless_voids),
            ("open shells", self.open_shells),
        ]
    }

    /// Whether there is none.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    pub(super) fn add(&mut self, other: &Self) {
        self.undecided += other.undecided;
        self.tangents += other.tangents;
        self.unused_roots += other.unused_roots;
        self.lost_ends += other.lost_ends;
        self.triples += other.triples;
        self.sides += other.sides;
        self.dead_ends += other.dead_ends;
        self.ambiguous += other.ambiguous;
        self.mixed_loops += other.mixed_loops;
        self.homeless_holes += other.homeless_holes;
        self.mixed_shells += other.mixed_shells;
        self.homeless_voids += other.homeless_voids;
        self.open_shells += other.open_shells;
    }
}

impl std::fmt::Display for Faults {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut first = true;
        for (name, count) in self.counts().into_iter().filter(|count| count.1 > 0) {
            if !first {
                f.write_str(", ")?;
            }
            write!(f, "{count} {name}")?;
            first = false;
        }
        if first {
            f.write_str("none")?;
        }
        Ok(())
    }
}

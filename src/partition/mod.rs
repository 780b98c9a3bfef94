//! The partition kernel: an exact arrangement of surfaces, labelled by a rule, as finished topology.
//!
//! It is not a general Boolean operation. Every sheet gets one planar arrangement, in its own (u, v), of the
//! curves that lie on it; what lies around each curve is labelled by the model's rule, not by geometry; solids
//! are connected components of labelled half-faces.
//!
//! 1. `region`, `sheet`, `patch`: surfaces as Bézier patches with a box tree; sides along which the sheets of
//!    a region join are known edges.
//! 2. `pierce`, `seeds`, `march`, `crossings`: where edges pass through sheets, where sheets cross, where three
//!    meet. Curves are pieces of degree 5 with one parameter in space and on both sheets, and a measured
//!    deviation.
//!    `touch`: sheets that touch one level, where their contacts cross.
//! 3. `tracks`, `arcs`, `landing`: curves cut at vertices, each made once; sectors around each piece, labelled.
//! 4. `faces`, `solids`: half-edges linked by angle into loops, loops into faces, faces into solids.
//! 5. `quadrature`, `check`: volumes and areas, and counts of whatever contradicts itself.
//!
//! **Limits.** Sheets of different regions must cross at an angle or stay apart. Where they touch, or run along
//! each other, a count in [`Faults`] is not zero and the result must not be used.

mod alone;
mod along;
mod arcs;
mod bernstein;
mod bounds;
mod boxes;
mod builder;
mod check;
mod common;
mod cone;
mod contours;
mod crossings;
mod edge;
mod faces;
mod facet;
mod heights;
mod hermite;
mod known;
mod landing;
mod linear;
mod march;
mod pair;
mod patch;
mod patches;
mod pierce;
mod place;
mod polygon;
mod quadrature;
mod region;
mod relations;
mod scalar;
mod seeds;
mod sheet;
mod slits;
mod solids;
mod solve;
mod topology;
mod touch;
mod tracks;
mod triples;
mod twins;

#[cfg(test)]
mod tests;

use crate::nurbs::enclosure::EnclosureError;
use glam::DVec3;

pub use check::{Doubt, Faults};
pub use quadrature::Integral;
pub use region::{Membership, Region};
pub use topology::{
    CurveShape, Edge, Face, OnSheet, PlaneCurve, SheetShape, Solid, Topology, Vertex,
};

/// The volume that holds a place; `None` outside of the domain.
pub type Label = Option<usize>;

/// How to partition.
#[derive(Clone, Copy)]
pub struct Options<'a> {
    /// How far computed curves may be from their sheets, against the usual 1e-11 of the domain's diagonal.
    pub tightness: f64,
    /// Asked now and then whether to stop.
    pub stop: &'a (dyn Fn() -> bool + Sync),
    /// Of which two regions both may matter near some place: whether there is one where the label depends on both.
    /// Regions that never meet so are not compared.
    pub meet: &'a (dyn Fn(usize, usize) -> bool + Sync),
    /// Where a region (the first one) holds a place, or does not: whether it makes no difference there on which side of
    /// another one the place is. What lies along such a surface there is not looked for.
    pub hides: &'a (dyn Fn(usize, bool, usize) -> bool + Sync),
}

impl Default for Options<'_> {
    fn default() -> Self {
        Self {
            tightness: 1.0,
            stop: &|| false,
            meet: &|_, _| true,
            hides: &|_, _, _| false,
        }
    }
}

/// Why there is nothing to partition.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PartitionError {
    /// The first region is no box.
    #[error("the first region must be the domain's box, with a volume")]
    NoDomain,
    /// Surfaces that are no closed shell.
    #[error("the surfaces of region {region} are no closed shell: {source}")]
    Shell {
        /// The region's index.
        region: usize,
        /// Where it is open.
        source: EnclosureError,
    },
    /// A side that is the side of no other surface, point by point at equal parameters.
    #[error(
        "region {region} is open from {from} to {to}: sides must join along their whole length, with parameters in proportion"
    )]
    Open {
        /// The region's index.
        region: usize,
        /// Where the side starts.
        from: DVec3,
        /// Where the side ends.
        to: DVec3,
    },
    /// A surface of too high a degree.
    #[error("a surface of region {region} has degrees {} × {}; at most 7 is possible", degrees[0], degrees[1])]
    Degree {
        /// The region's index.
        region: usize,
        /// Its degrees in u and v.
        degrees: [usize; 2],
    },
    /// Stopped on request.
    #[error("stopped on request")]
    Stopped,
    /// A sheet that does not separate inside from outside.
    #[error("sheet {sheet} of region {region} does not have the region on one side only")]
    NoSides {
        /// The region's index.
        region: usize,
        /// The sheet's index.
        sheet: usize,
    },
}

/// A partition: finished topology, and what contradicts itself in it.
#[derive(Clone, Debug)]
pub struct Partition {
    /// Vertices, edges, faces and solids; empty if something contradicts itself.
    pub topology: Topology,
    /// Zero everywhere if the topology may be used.
    pub faults: Faults,
    /// Regions whose curves have faults, as far as it is known.
    pub doubtful_regions: Vec<usize>,
    /// Where sheets are too near each other to tell how they lie.
    pub doubts: Vec<Doubt>,
    /// Pairs of regions whose sheets cross inside the domain.
    pub crossing_regions: Vec<(usize, usize)>,
    /// Computed curves.
    pub branches: usize,
    /// Pairs of patches that a curve was found on.
    pub certificates: Certificates,
    /// Seconds per stage.
    pub timings: Vec<(&'static str, std::time::Duration)>,
}

impl Partition {
    /// One that contradicts itself: nothing is made of what was found until then.
    fn contradictory(faults: Faults, crossings: crossings::Crossings, clock: Clock) -> Self {
        Self {
            topology: Topology::default(),
            faults,
            doubtful_regions: crossings.doubtful,
            doubts: crossings.doubts,
            certificates: crossings.certificates,
            crossing_regions: Vec::new(),
            branches: crossings.curves.len(),
            timings: clock.laps,
        }
    }
}

/// Pairs of patches of sheets that are no heights over one plan, on which a curve was found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Certificates {
    /// Where it is certain to be the only one.
    pub certain: usize,
    /// The smallest ones where another one is not excluded.
    pub uncertain: usize,
}

/// How far beyond the domain curves are followed, as a fraction of its diagonal.
const MARGIN: f64 = 5e-4;

/// Partitions the domain (region 0) by all other regions, and joins what has the same label.
///
/// `labels` names the volume of a place, given for each region whether it holds the place.
pub fn partition(
    regions: Vec<Region>,
    labels: &(dyn Fn(&[bool]) -> Label + Sync),
    options: &Options<'_>,
) -> Result<Partition, PartitionError> {
    let Some(way) = place::way(&regions) else {
        return here(regions, labels, options);
    };
    let moved = regions.into_iter().map(|one| place::moved(one, way));
    let mut made = here(moved.collect(), labels, options)?;
    place::restore(&mut made.topology, &mut made.doubts, -way);
    Ok(made)
}

/// The same where the domain lies.
fn here(
    regions: Vec<Region>,
    labels: &(dyn Fn(&[bool]) -> Label + Sync),
    options: &Options<'_>,
) -> Result<Partition, PartitionError> {
    let mut clock = Clock::start();
    let regions = region::Regions::new(regions, options)?;
    let scale = regions.domain.diagonal();
    let tolerances = pair::Tolerances::new(scale, options.tightness);
    let clip = regions.domain.grown(MARGIN * scale);
    clock.lap("regions");
    let mut faults = Faults::default();
    let search = crossings::Settings {
        tolerances,
        clip,
        stop: options.stop,
    };
    let crossings = crossings::Crossings::find(&regions, search, &mut faults);
    if (options.stop)() {
        return Err(PartitionError::Stopped);
    }
    clock.lap("crossings");
    if !faults.is_none() {
        return Ok(Partition::contradictory(faults, crossings, clock));
    }
    let geometry = tracks::Geometry {
        regions: &regions,
        crossings: &crossings,
    };
    let tracks = tracks::Tracks::new(&regions, &crossings, tolerances, &mut faults);
    let arcs = arcs::arcs(geometry, &tracks, labels, &mut faults);
    clock.lap("labels");
    if !faults.is_none() {
        return Ok(Partition::contradictory(faults, crossings, clock));
    }
    let faces = faces::faces(geometry, &tracks, &arcs, &mut faults);
    clock.lap("faces");
    if !faults.is_none() {
        return Ok(Partition::contradictory(faults, crossings, clock));
    }
    let integrals = quadrature::integrals(geometry, &tracks, &arcs, &faces);
    clock.lap("integrals");
    let parts = solids::Parts {
        geometry,
        tracks: &tracks,
        arcs: &arcs,
        faces: &faces,
        integrals: &integrals,
        tolerances,
    };
    let solids = parts.solids(&mut faults);
    let topology = Topology::new(&parts, solids);
    clock.lap("solids");
    let inside = |crossing: &&crossings::Crossing| {
        crossing
            .branch
            .nodes
            .iter()
            .any(|node| regions.domain.holds(node.point()))
    };
    let mut crossing_regions: Vec<(usize, usize)> = crossings
        .curves
        .iter()
        .filter(inside)
        .map(|crossing| crossing.sheets.map(|sheet| regions.sheets[sheet].region))
        .map(|[a, b]| (a.min(b), a.max(b)))
        .collect();
    crossing_regions.sort_unstable();
    crossing_regions.dedup();
    Ok(Partition {
        topology,
        faults,
        doubtful_regions: crossings.doubtful,
        doubts: crossings.doubts,
        crossing_regions,
        branches: crossings.curves.len(),
        certificates: crossings.certificates,
        timings: clock.laps,
    })
}

struct Clock {
    last: std::time::Instant,
    laps: Vec<(&'static str, std::time::Duration)>,
}

impl Clock {
    fn start() -> Self {
        Self {
            last: std::time::Instant::now(),
            laps: Vec::new(),
        }
    }

    fn lap(&mut self, name: &'static str) {
        self.laps.push((name, self.last.elapsed()));
        self.last = std::time::Instant::now();
    }
}

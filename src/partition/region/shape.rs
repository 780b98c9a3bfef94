//! What a region is: its sheets as they are given, and whether it holds a point.

use std::sync::Arc;

use glam::DVec3;

use crate::nurbs::enclosure::Enclosure;
use crate::nurbs::{KnotVector, Surface};
use crate::partition::PartitionError;
use crate::partition::bounds::Bounds;

/// What sheets are the boundary of.
#[derive(Clone, Debug)]
pub enum Region {
    /// The inside of a closed shell. Its surfaces join along whole sides.
    Shell(Vec<Surface>),
    /// The inside of a shell of which only some surfaces, or parts of them, matter within the domain.
    PartOf {
        /// Those. Sides that join no other are left open: nothing may be labelled differently on both sides of a
        /// surface there.
        surfaces: Vec<Surface>,
        /// The whole.
        shell: Arc<Enclosure>,
    },
    /// A box along the axes.
    Block {
        /// Lower corner (m).
        low: DVec3,
        /// Upper corner (m).
        high: DVec3,
    },
    /// Everything above an elevation (m).
    Above(f64),
    /// What lies on one side of open surfaces that reach through the domain.
    Side {
        /// The surfaces; none if everything lies on that side. Borders that join no other must lie where nothing may
        /// be labelled differently on both sides; or exactly on a level, on which the surface then **lands**: that
        /// contact is known, and may be tangential.
        surfaces: Vec<Surface>,
        /// Tells the side.
        inside: Arc<dyn Membership>,
    },
}

/// Tells whether a region holds a point.
pub trait Membership: Send + Sync + std::fmt::Debug {
    /// Whether it does.
    fn holds(&self, point: DVec3) -> bool;
}

impl Membership for Enclosure {
    fn holds(&self, point: DVec3) -> bool {
        self.contains(point)
    }
}

/// A region's membership.
#[derive(Debug)]
pub(in crate::partition) enum Inside {
    Shell(Arc<Enclosure>),
    Side(Arc<dyn Membership>),
    Block(DVec3, DVec3),
    Above(f64),
}

impl Inside {
    pub(in crate::partition) fn holds(&self, p: DVec3) -> bool {
        match self {
            Self::Shell(shell) => shell.contains(p),
            Self::Side(side) => side.holds(p),
            Self::Block(low, high) => p.cmpge(*low).all() && p.cmple(*high).all(),
            Self::Above(level) => p.z > *level,
        }
    }
}

/// A region as it is given.
pub(super) struct Shape {
    pub(super) sheets: Vec<Surface>,
    pub(super) inside: Inside,
    /// Whether sides may join no other.
    pub(super) may_be_open: bool,
}

/// The sheets of a region, and what it holds.
pub(super) fn shape(
    index: usize,
    region: Region,
    domain: &Bounds,
) -> Result<Shape, PartitionError> {
    match region {
        Region::Shell(sheets) => {
            let shell = Enclosure::new(sheets.clone()).map_err(|source| PartitionError::Shell {
                region: index,
                source,
            })?;
            Ok(Shape {
                sheets,
                inside: Inside::Shell(Arc::new(shell)),
                may_be_open: false,
            })
        }
        Region::PartOf { surfaces, shell } => Ok(Shape {
            sheets: surfaces,
            inside: Inside::Shell(shell),
            may_be_open: true,
        }),
        Region::Side { surfaces, inside } => Ok(Shape {
            sheets: surfaces,
            inside: Inside::Side(inside),
            may_be_open: true,
        }),
        Region::Block { low, high } => {
            let corner = |i: usize| {
                let pick = |axis: usize| {
                    if i >> axis & 1 == 1 {
                        high[axis]
                    } else {
                        low[axis]
                    }
                };
                DVec3::new(pick(0), pick(1), pick(2))
            };
            let sheets = [
                [0, 2, 4, 6],
                [1, 3, 5, 7],
                [0, 1, 4, 5],
                [2, 3, 6, 7],
                [0, 1, 2, 3],
                [4, 5, 6, 7],
            ]
            .iter()
            .map(|corners| rectangle(corners.map(corner)))
            .collect::<Result<_, _>>()
            .map_err(|()| PartitionError::NoDomain)?;
            Ok(Shape {
                sheets,
                inside: Inside::Block(low, high),
                may_be_open: false,
            })
        }
        Region::Above(level) => {
            let (low, high) = (domain.low, domain.high);
            let margin = 0.1 * (high - low).max_element();
            let at = |x: f64, y: f64| DVec3::new(x, y, level);
            let (x, y) = (
                [low.x - margin, high.x + margin],
                [low.y - margin, high.y + margin],
            );
            let corners = [
                at(x[0], y[0]),
                at(x[1], y[0]),
                at(x[0], y[1]),
                at(x[1], y[1]),
            ];
            let sheet = rectangle(corners).map_err(|()| PartitionError::NoDomain)?;
            Ok(Shape {
                sheets: vec![sheet],
                inside: Inside::Above(level),
                may_be_open: true,
            })
        }
    }
}

/// A flat sheet from its corners at (0, 0), (1, 0), (0, 1), (1, 1), with lengths as parameters.
fn rectangle([a, b, c, d]: [DVec3; 4]) -> Result<Surface, ()> {
    let knots = |length: f64| KnotVector::new(1, vec![0.0, 0.0, length, length]).map_err(|_| ());
    let (u, v) = (knots(a.distance(b))?, knots(a.distance(c))?);
    Surface::new(u, v, vec![a, c, b, d]).map_err(|_| ())
}

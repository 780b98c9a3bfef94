//! The point evaluator: which volume holds a point, from control nets and rules alone.
//!
//! It uses no CAD kernel, so it is the independent oracle of every assembly, and enough for whatever
//! needs only sampled answers: sections, previews, logs, Monte Carlo volumes.

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use super::realisation::{Instance, Realisation};
use super::rules::{Rules, Verdict};
use super::spec::Domain;
use crate::nurbs::SurfaceError;
use crate::nurbs::enclosure::{Enclosure, EnclosureError};

/// Answers `owner(p)` for one realisation.
#[derive(Clone, Debug)]
pub struct Owners {
    low: DVec3,
    high: DVec3,
    rules: Rules,
    shells: Vec<Arc<Enclosure>>,
}

/// A body that has no inside.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum OwnersError {
    /// Its sheets leave gaps.
    #[error("{volume}: its shell is not closed: {source}")]
    Open {
        /// The volume's name.
        volume: String,
        /// Which edge is open.
        source: EnclosureError,
    },
    /// Its ends cannot be closed.
    #[error("{volume}: its ends cannot be closed: {source}")]
    Ends {
        /// The volume's name.
        volume: String,
        /// Why.
        source: SurfaceError,
    },
}

/// Where a point belongs, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Location {
    /// The volume that holds the point.
    pub owner: usize,
    /// Every body that the point lies inside, oldest first, and what it did.
    pub history: Vec<(usize, Verdict)>,
    /// All volumes that meet at the point, the owner included, if it lies on a boundary.
    pub boundary: Vec<usize>,
}

impl Owners {
    /// Prepares the shells of all bodies.
    pub fn new(realisation: &Realisation, domain: &Domain) -> Result<Self, OwnersError> {
        let shell = |instance: &Instance| {
            let volume = || realisation.volumes[instance.volume].name.clone();
            let sheets = instance.body.sheets().map_err(|source| OwnersError::Ends {
                volume: volume(),
                source,
            })?;
            Enclosure::new(sheets.into_iter().map(|sheet| sheet.1).collect())
                .map(Arc::new)
                .map_err(|source| OwnersError::Open {
                    volume: volume(),
                    source,
                })
        };
        let shells = realisation
            .instances
            .par_iter()
            .map(shell)
            .collect::<Result<_, _>>()?;
        let corner = |i: usize| DVec3::new(domain.x[i], domain.y[i], domain.z[i]);
        Ok(Self {
            low: corner(0),
            high: corner(1),
            rules: realisation.rules.clone(),
            shells,
        })
    }

    /// The volume that holds a point; `None` outside the domain.
    pub fn at(&self, point: DVec3) -> Option<usize> {
        self.in_domain(point).then(|| {
            self.rules
                .owner(|body| self.shells[body - 1].contains(point))
        })
    }

    /// Whether a point lies inside the shell of a volume's body.
    pub fn inside(&self, volume: usize, point: DVec3) -> bool {
        self.shells[volume - 1].contains(point)
    }

    /// The shell of a volume's body.
    pub fn shell(&self, volume: usize) -> &Arc<Enclosure> {
        &self.shells[volume - 1]
    }

    /// The volumes whose bodies' shells come within a distance of a point (m), whatever holds the point.
    pub fn near(&self, point: DVec3, distance: f64) -> impl Iterator<Item = usize> {
        (1..=self.shells.len())
            .filter(move |volume| self.shells[volume - 1].distance(point, distance).is_some())
    }

    /// Whether the domain holds a point, its faces included.
    pub fn in_domain(&self, point: DVec3) -> bool {
        point.cmpge(self.low).all() && point.cmple(self.high).all()
    }

    /// The owner with its history, and the volumes that meet within `tolerance` of the point (m).
    pub fn locate(&self, point: DVec3, tolerance: f64) -> Option<Location> {
        if !self.in_domain(point) {
            return None;
        }
        let history = self
            .rules
            .history(|body| self.shells[body - 1].contains(point));
        let owner = self
            .rules
            .owner(|body| self.shells[body - 1].contains(point));
        if self.near(point, tolerance).next().is_none() {
            return Some(Location {
                owner,
                history,
                boundary: Vec::new(),
            });
        }
        // What meets at a boundary is what holds the points around it.
        let mut boundary: Vec<usize> = around(point, 10.0 * tolerance)
            .filter_map(|beside| self.at(beside))
            .collect();
        boundary.push(owner);
        boundary.sort_unstable();
        boundary.dedup();
        if boundary.len() < 2 {
            boundary.clear();
        }
        // A point on a face belongs to the younger.
        let owner = boundary.last().copied().unwrap_or(owner);
        Some(Location {
            owner,
            history,
            boundary,
        })
    }

    /// The corners of the domain.
    pub fn domain(&self) -> (DVec3, DVec3) {
        (self.low, self.high)
    }
}

/// The 26 neighbours of a point on a cube of this half-size.
fn around(point: DVec3, reach: f64) -> impl Iterator<Item = DVec3> {
    let steps = [-1.0, 0.0, 1.0];
    let all = steps.into_iter().flat_map(move |x| {
        steps
            .into_iter()
            .flat_map(move |y| steps.into_iter().map(move |z| DVec3::new(x, y, z)))
    });
    all.filter(|step| *step != DVec3::ZERO)
        .map(move |step| point + step * reach)
}

//! The point evaluator: which volume holds a point, from control nets and rules alone.
//!
//! It uses no CAD kernel, so it is the independent oracle of every assembly, and enough for whatever
//! needs only sampled answers: sections, previews, logs, Monte Carlo volumes.

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use super::cells::Cells;
use super::interior::{Interior, InteriorError, around};
use super::realisation::{Instance, Realisation};
use super::rules::{Rules, Takers, Verdict};
use crate::features::extent::Extent;

/// Answers `owner(p)` for one realisation.
#[derive(Clone, Debug)]
pub struct Owners {
    extent: Extent,
    rules: Rules,
    interiors: Vec<Interior>,
    /// Which bodies may hold a place.
    cells: Arc<Cells>,
    takers: Arc<Takers>,
}

/// A body that has no inside.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{volume}: {source}")]
pub struct OwnersError {
    /// The volume's name.
    pub volume: String,
    /// Why.
    pub source: InteriorError,
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
    /// Prepares the interiors of all bodies.
    pub fn new(realisation: &Realisation) -> Result<Self, OwnersError> {
        let interior = |instance: &Instance| {
            Interior::of(&instance.body).map_err(|source| OwnersError {
                volume: realisation.volumes[instance.volume].name.clone(),
                source,
            })
        };
        let interiors = realisation
            .instances
            .par_iter()
            .map(interior)
            .collect::<Result<Vec<_>, _>>()?;
        let extent = realisation.extent.clone();
        let block = [extent.low(), extent.high()];
        Ok(Self {
            cells: Arc::new(Cells::new(block, &interiors, &realisation.rules)),
            takers: Arc::new(Takers::new(realisation.rules.len())),
            extent,
            rules: realisation.rules.clone(),
            interiors,
        })
    }

    /// The volume that holds a point; `None` outside the domain.
    pub fn at(&self, point: DVec3) -> Option<usize> {
        self.in_domain(point).then(|| self.owner(point))
    }

    fn owner(&self, point: DVec3) -> usize {
        let (first, younger) = self.cells.at(point);
        self.rules.owner_by(&self.takers, first, younger, |body| {
            self.inside(body, point)
        })
    }

    /// Whether a volume's body holds a point, by its shell or side alone.
    pub fn inside(&self, volume: usize, point: DVec3) -> bool {
        self.interiors[volume - 1].contains(point)
    }

    /// What a volume's body holds.
    pub fn interior(&self, volume: usize) -> &Interior {
        &self.interiors[volume - 1]
    }

    /// The volumes whose bodies' boundaries come within a distance of a point (m), whatever holds the point.
    pub fn near(&self, point: DVec3, distance: f64) -> impl Iterator<Item = usize> {
        (1..=self.interiors.len())
            .filter(move |volume| self.interiors[volume - 1].is_near(point, distance))
    }

    /// Whether the domain holds a point: the block, its faces included, above the domain's base and not above its top.
    pub fn in_domain(&self, point: DVec3) -> bool {
        self.extent.holds(point)
    }

    /// The owner with its history, and the volumes that meet within `tolerance` of the point (m).
    pub fn locate(&self, point: DVec3, tolerance: f64) -> Option<Location> {
        if !self.in_domain(point) {
            return None;
        }
        let history = self
            .rules
            .history(|body| self.interiors[body - 1].contains(point));
        let owner = self.owner(point);
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

    /// The domain.
    pub fn extent(&self) -> &Extent {
        &self.extent
    }
}

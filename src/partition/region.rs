//! Regions: all sheets with what they bound.
//!
//! What a region is and what it holds is in `shape`, how its sheets join in `joints`, on which side of them it lies in `outward`.

mod joints;
mod outward;
mod shape;

use std::collections::BTreeSet;

use glam::DVec3;
use rayon::prelude::*;

use self::joints::{Joints, Pole, joints, landing};
use self::outward::orient;
use self::shape::{Inside, Shape, shape};
use super::bounds::Bounds;
use super::edge::Edge;
use super::relations::Relations;
use super::sheet::{Border, Sheet};
use super::twins;
use super::{Options, PartitionError};
use crate::nurbs::{Curve, Surface};

pub use self::shape::{Membership, Region};

/// The region that is the domain.
const DOMAIN: usize = 0;

/// All sheets with the regions that they bound.
#[derive(Debug)]
pub(super) struct Regions {
    pub(super) sheets: Vec<Sheet>,
    pub(super) edges: Vec<Edge>,
    pub(super) poles: Vec<Pole>,
    pub(super) inside: Vec<Inside>,
    pub(super) bounds: Vec<Bounds>,
    pub(super) domain: Bounds,
    /// What the rule says of them.
    pub(super) relations: Relations,
    /// Pairs of sheets that run beside each other and do not meet there.
    pub(super) twins: BTreeSet<[usize; 2]>,
    /// By region: its first sheet; then the number of all sheets.
    firsts: Vec<usize>,
}

impl Regions {
    /// Region 0 is the domain.
    pub(super) fn new(regions: Vec<Region>, options: &Options<'_>) -> Result<Self, PartitionError> {
        let Some(Region::Block { low, high }) = regions.first() else {
            return Err(PartitionError::NoDomain);
        };
        let domain = Bounds {
            low: *low,
            high: *high,
        };
        let count = regions.len();
        let made = regions
            .into_par_iter()
            .enumerate()
            .map(|(index, region)| sheets(index, shape(index, region, &domain)?))
            .collect::<Result<Vec<_>, _>>()?;
        let mut all = Self {
            sheets: Vec::new(),
            edges: Vec::new(),
            poles: Vec::new(),
            inside: Vec::new(),
            bounds: Vec::new(),
            domain,
            relations: Relations::new(count, options.meet, options.hides),
            twins: BTreeSet::new(),
            firsts: vec![0],
        };
        let mut own = Vec::new();
        for region in made {
            let first = all.sheets.len();
            let mut bounds = Bounds::EMPTY;
            for sheet in region.sheets {
                bounds = bounds.and(*sheet.bounds());
                all.sheets.push(sheet);
            }
            all.inside.push(region.inside);
            all.bounds.push(bounds);
            own.push((first..all.sheets.len(), region.may_be_open));
            all.firsts.push(all.sheets.len());
        }
        let mut open_borders = Vec::new();
        let joints: Vec<Joints> = own
            .par_iter()
            .enumerate()
            .map(|(index, own)| joints(&all.sheets, &all.bounds[index], index, own.0.clone()))
            .collect();
        for (index, (own, (_, may_be_open))) in joints.into_iter().zip(own).enumerate() {
            match own.open.first() {
                Some((_, _, curve)) if !may_be_open => {
                    return Err(PartitionError::Open {
                        region: index,
                        from: curve.points()[0],
                        to: curve.points()[curve.points().len() - 1],
                    });
                }
                _ => {}
            }
            all.edges.extend(own.edges);
            all.poles.extend(own.poles);
            for (sheet, border, _) in &own.open {
                all.sheets[*sheet].open.push(*border);
            }
            open_borders.extend(own.open);
        }
        orient(&mut all.sheets, &all.edges, &all.inside, &all.bounds)?;
        for open in open_borders {
            all.land(open);
        }
        all.twins = twins::apart(&all.sheets, &domain);
        Ok(all)
    }

    /// The sheets of a region.
    pub(super) fn sheets_of(&self, region: usize) -> std::ops::Range<usize> {
        self.firsts[region]..self.firsts[region + 1]
    }

    /// Whether nothing hides either of two regions at a point.
    pub(super) fn matter(&self, own: [usize; 2], point: DVec3) -> bool {
        let inside = |region: usize| self.inside[region].holds(point);
        self.relations.sides(&own, inside).is_some()
    }

    /// Whether one of two sheets lands on the other.
    pub(super) fn touch(&self, a: usize, b: usize) -> bool {
        self.sheets[a].lands_on.contains(&b) || self.sheets[b].lands_on.contains(&a)
    }

    /// Whether two sheets run beside each other without meeting there.
    pub(super) fn are_twins(&self, a: usize, b: usize) -> bool {
        self.twins.contains(&[a.min(b), a.max(b)])
    }

    /// Whether the curve of two sheets is to be looked for on a third one: not where that lands on either of them, or
    /// either on it, which is known; and not if it matters to neither. Beyond the domain nothing matters: on its own sheets the third
    /// one must matter to the other of the two.
    pub(super) fn may_pierce(&self, ends: [usize; 2], third: usize) -> bool {
        let region = self.sheets[third].region;
        let own = ends.map(|end| self.sheets[end].region);
        let mut inner = own.into_iter().filter(|own| *own != DOMAIN);
        let may_matter = own == [DOMAIN; 2] || inner.any(|own| self.relations.meet(own, region));
        may_matter
            && !ends
                .iter()
                .any(|end| self.touch(*end, third) || self.are_twins(*end, third))
    }

    /// Makes an open border that lies on a level sheet of another region an edge.
    fn land(&mut self, open: (usize, Border, Curve)) {
        let (sheet, border) = (open.0, open.1);
        let Self {
            sheets,
            relations,
            domain,
            ..
        } = &*self;
        if let Some((under, edge)) = landing(sheets, relations, domain, open) {
            self.sheets[sheet].open.retain(|open| *open != border);
            self.sheets[sheet].lands_on.push(under);
            self.edges.push(edge);
        }
    }
}

struct Made {
    sheets: Vec<Sheet>,
    inside: Inside,
    may_be_open: bool,
}

fn sheets(index: usize, shape: Shape) -> Result<Made, PartitionError> {
    let sheet = |surface: Surface| {
        let degrees = [surface.knots_u().degree(), surface.knots_v().degree()];
        Sheet::new(surface, index).ok_or(PartitionError::Degree {
            region: index,
            degrees,
        })
    };
    Ok(Made {
        sheets: shape
            .sheets
            .into_iter()
            .map(sheet)
            .collect::<Result<_, _>>()?,
        inside: shape.inside,
        may_be_open: shape.may_be_open,
    })
}

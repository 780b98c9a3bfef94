//! The plan as regions for the partition kernel.

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use crate::assembly::shapes;
use crate::features::body::{Body, Role, Trough, TroughError};
use crate::features::ellipsoid::Ellipsoid;
use crate::features::side::Side;
use crate::model::Interior;
use crate::model::owner::Owners;
use crate::model::plan::{AssemblyPlan, PlannedShell};
use crate::nurbs::{
    self,
    enclosure::{Enclosure, EnclosureError},
};
use crate::partition::{Membership, Region};

/// Sections of a trough kept beyond the last one whose span meets the domain.
const OVERSHOOT: usize = 2;

/// Why a body has no region.
#[derive(Debug, thiserror::Error)]
pub(in crate::assembly) enum RegionError {
    #[error("a body cannot be cut off outside of the domain: {0}")]
    Cut(#[from] TroughError),
    #[error("the ends of a body cannot be closed: {0}")]
    Ends(#[from] nurbs::SurfaceError),
    #[error("a raised body is not closed: {0}")]
    Raised(#[from] EnclosureError),
}

/// The block, the lids and the shells; then what bounds the domain in the block.
pub(super) fn regions(plan: &AssemblyPlan, owners: &Owners) -> Result<Vec<Region>, RegionError> {
    let mut regions = vec![Region::Block {
        low: plan.low(),
        high: plan.high(),
    }];
    regions.extend(plan.lids.iter().map(|level| Region::Above(*level)));
    let shells: Vec<_> = plan
        .shells
        .par_iter()
        .enumerate()
        .map(|(index, shell)| region(plan, owners, index, shell))
        .collect();
    for shell in shells {
        regions.push(shell?);
    }
    regions.extend(plan.bounds().map(|(_, side)| open(side)));
    Ok(regions)
}

impl Membership for Side {
    fn holds(&self, point: DVec3) -> bool {
        Self::holds(self, point)
    }
}

impl Membership for Ellipsoid {
    fn holds(&self, point: DVec3) -> bool {
        self.contains(point)
    }
}

/// A shell as far as it matters for the domain. A level top that coincides with others is left out: the banks are
/// raised above it, and a lid, or the domain's top, cuts them.
fn region(
    plan: &AssemblyPlan,
    owners: &Owners,
    index: usize,
    shell: &PlannedShell,
) -> Result<Region, RegionError> {
    let near = |trough: &Trough| -> Result<Vec<(Role, nurbs::Surface)>, RegionError> {
        let [first, last] = shapes::ends(trough, [plan.low(), plan.high()], OVERSHOOT);
        Ok(trough.between(first, last)?.sheets()?)
    };
    let only = |sheets: Vec<(Role, nurbs::Surface)>, without: Option<Role>| {
        let kept = sheets.into_iter().filter(|sheet| Some(sheet.0) != without);
        kept.map(|sheet| sheet.1).collect::<Vec<_>>()
    };
    if let Some(flush) = &shell.flush {
        let sheets = near(&flush.raised)?;
        let whole = Enclosure::new(only(sheets.clone(), None))?;
        return Ok(Region::PartOf {
            surfaces: only(sheets, Some(Role::Top)),
            shell: Arc::new(whole),
        });
    }
    let surfaces = match &shell.body {
        Body::Trough(trough) => only(near(trough)?, None),
        Body::Ellipsoid(ellipsoid) => wedges(ellipsoid.skin())?,
        // A plan that has one is never partitioned.
        Body::Imported(_) => return Ok(Region::Shell(Vec::new())),
        Body::Shell(shell) => only(shell.sheets().to_vec(), None),
        Body::Side(side) => {
            return Ok(match side.level() {
                Some(level) => Region::Above(level),
                None => open(side),
            });
        }
    };
    // The point evaluator has the whole shell: within the domain they are the same.
    let whole = plan.bodies.iter().find(|body| body.shell == index);
    Ok(match whole.map(|body| owners.interior(body.volume)) {
        Some(Interior::Shell(shell)) => Region::PartOf {
            surfaces,
            shell: Arc::clone(shell),
        },
        Some(Interior::Ellipsoid(ellipsoid)) => Region::Side {
            surfaces,
            inside: Arc::clone(ellipsoid) as Arc<dyn Membership>,
        },
        _ => Region::Shell(surfaces),
    })
}

/// What lies on one side of open sheets.
fn open(side: &Arc<Side>) -> Region {
    Region::Side {
        surfaces: side.sheets().to_vec(),
        inside: Arc::clone(side) as Arc<dyn Membership>,
    }
}

/// A closed surface cut at its meridians. Smaller faces, without a seam, are what other programs integrate best by
/// their fixed rules: 0.2 % off instead of 0.9 % for a whole ellipsoid.
fn wedges(skin: &nurbs::Surface) -> Result<Vec<nurbs::Surface>, TroughError> {
    let knots = skin.knots_u().distinct();
    let mut rest = skin.clone();
    let mut wedges = Vec::with_capacity(knots.len() - 1);
    for (knot, _) in &knots[1..knots.len() - 1] {
        let (wedge, after) = rest.split_u(*knot)?;
        wedges.push(wedge);
        rest = after;
    }
    wedges.push(rest);
    Ok(wedges)
}

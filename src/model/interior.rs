//! What a body holds: the inside of its shell, or its side of open sheets.

use std::sync::Arc;

use glam::DVec3;

use crate::features::body::Body;
use crate::features::ellipsoid::Ellipsoid;
use crate::features::side::Side;
use crate::nurbs::SurfaceError;
use crate::nurbs::enclosure::{Enclosure, EnclosureError};

/// Tells whether a body holds a point.
#[derive(Clone, Debug)]
pub enum Interior {
    /// Inside a closed shell.
    Shell(Arc<Enclosure>),
    /// Inside an ellipsoid.
    Ellipsoid(Arc<Ellipsoid>),
    /// On the younger side of open sheets.
    Side(Arc<Side>),
}

/// A body that has no inside.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum InteriorError {
    /// Its sheets leave gaps.
    #[error("its shell is not closed: {0}")]
    Open(#[from] EnclosureError),
    /// Its ends cannot be closed.
    #[error("its ends cannot be closed: {0}")]
    Ends(#[from] SurfaceError),
}

impl Interior {
    /// What a body holds.
    pub fn of(body: &Body) -> Result<Self, InteriorError> {
        match body {
            Body::Side(side) => Ok(Self::Side(Arc::clone(side))),
            Body::Ellipsoid(ellipsoid) => Ok(Self::Ellipsoid(Arc::new(ellipsoid.clone()))),
            Body::Shell(shell) => Ok(Self::Shell(Arc::clone(shell.inside()))),
            Body::Imported(imported) => Ok(Self::Shell(Arc::clone(imported.inside()))),
            Body::Trough(_) => {
                let sheets = body.sheets()?.into_iter().map(|sheet| sheet.1).collect();
                Ok(Self::Shell(Arc::new(Enclosure::new(sheets)?)))
            }
        }
    }

    /// Whether it holds a point.
    pub fn contains(&self, point: DVec3) -> bool {
        match self {
            Self::Shell(shell) => shell.contains(point),
            Self::Ellipsoid(ellipsoid) => ellipsoid.contains(point),
            Self::Side(side) => side.holds(point),
        }
    }

    /// Whether its boundary comes within a distance of a point (m); of open sheets, as far as points in 26 directions
    /// around it tell.
    pub fn is_near(&self, point: DVec3, distance: f64) -> bool {
        match self {
            Self::Shell(shell) => shell.distance(point, distance).is_some(),
            Self::Ellipsoid(ellipsoid) => ellipsoid.is_near(point, distance),
            Self::Side(side) => {
                let here = side.holds(point);
                around(point, distance).any(|beside| side.holds(beside) != here)
            }
        }
    }

    /// The corners of a box that holds it.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        match self {
            Self::Shell(shell) => shell.bounds(),
            Self::Ellipsoid(ellipsoid) => ellipsoid.bounds(),
            Self::Side(side) => Body::Side(Arc::clone(side)).bounds(),
        }
    }
}

/// The 26 neighbours of a point on a cube of this half-size.
pub(super) fn around(point: DVec3, reach: f64) -> impl Iterator<Item = DVec3> {
    let steps = [-1.0, 0.0, 1.0];
    let all = steps.into_iter().flat_map(move |x| {
        steps
            .into_iter()
            .flat_map(move |y| steps.into_iter().map(move |z| DVec3::new(x, y, z)))
    });
    all.filter(|step| *step != DVec3::ZERO)
        .map(move |step| point + step * reach)
}

//! Surfaces drawn.

use glam::DVec3;

use super::HorizonSurface;
use crate::features::horizon::{Horizon, HorizonError};
use crate::features::net_horizon::{self, NetHorizonError};
use crate::features::nets::{Nets, Placement};
use crate::model::domain::Domain;
use crate::model::draws::{Key, Rejected, attempt};

/// Draws a horizon over a domain; of one that lies above another one, its thickness.
pub(crate) fn horizon(
    surface: &HorizonSurface,
    domain: &Domain,
    key: Key<'_>,
) -> Result<(Horizon, Vec<(String, f64)>), Rejected> {
    let wrong = |error: HorizonError| ("no horizon", error.to_string());
    attempt(key, |draws| match surface {
        // What it lies above is not asked for: this is its thickness alone.
        HorizonSurface::Above { thickness, .. } => match &**thickness {
            HorizonSurface::Level(thickness) => {
                Horizon::flat(draws.quantity(thickness, "surface.thickness")?).map_err(wrong)
            }
            HorizonSurface::File(file) => Ok(file.fitted.horizon.clone()),
            measured => measured_heights(measured).map_err(wrong),
        },
        HorizonSurface::Level(level) => {
            Horizon::flat(draws.quantity(level, "surface.level")?).map_err(wrong)
        }
        HorizonSurface::Dipping {
            through: [x, y, z],
            dip_deg,
            azimuth_deg,
        } => {
            let through = DVec3::new(
                draws.quantity(x, "surface.dipping.through.x")?,
                draws.quantity(y, "surface.dipping.through.y")?,
                draws.quantity(z, "surface.dipping.through.z")?,
            );
            let dip = draws.quantity(dip_deg, "surface.dipping.dip_deg")?;
            let azimuth = draws.quantity(azimuth_deg, "surface.dipping.azimuth_deg")?;
            Horizon::dipping(through, dip.to_radians(), azimuth.to_radians()).map_err(wrong)
        }
        HorizonSurface::Net { net, tolerance } => {
            let (low, high) = domain.corners();
            let placement = Placement {
                at: DVec3::ZERO,
                azimuth: 0.0,
            };
            let nets = Nets::new(std::slice::from_ref(net), placement);
            let made = nets
                .map_err(NetHorizonError::from)
                .and_then(|nets| net_horizon::horizon(&nets, [low, high], *tolerance));
            let (horizon, _) = made.map_err(|error| ("no horizon", error.to_string()))?;
            Ok(horizon)
        }
        HorizonSurface::File(file) => Ok(file.fitted.horizon.clone()),
        measured => measured_heights(measured).map_err(wrong),
    })
}

/// Through a grid, or near points; of what is neither, nothing.
fn measured_heights(surface: &HorizonSurface) -> Result<Horizon, HorizonError> {
    match surface {
        HorizonSurface::Grid { x, y, heights } => Horizon::grid(*x, *y, heights),
        HorizonSurface::Points { points, tolerance } => {
            let points: Vec<DVec3> = points.iter().map(|p| DVec3::from_array(*p)).collect();
            Horizon::points(&points, *tolerance)
        }
        _ => Err(HorizonError::NoPoints),
    }
}

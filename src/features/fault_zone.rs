//! Fault zones: what lies between two offsets of a fault's surface, along its normals.

use glam::{DVec3, Vec3Swizzles};

use super::body::Role;
use super::displace::{DisplaceError, Displacement};
use super::fault_surface::{FaultError, FaultSurface};
use super::shell::{Shell, ShellError};
use crate::nurbs::{Surface, SurfaceError};

/// Least degree of what is offset and bent.
const DEGREE: usize = 3;
/// Of the least radius of curvature: the thickest that a zone may be to either side.
const THICKEST: f64 = 0.5;
/// Places along dip at which curvature is asked.
const ASKED: usize = 400;

/// Why there is no such zone.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ZoneError {
    /// The fault has no sheet.
    #[error(transparent)]
    Fault(#[from] FaultError),
    /// Its offsets are no surfaces.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// They cannot be followed.
    #[error(transparent)]
    Displace(#[from] DisplaceError<std::convert::Infallible>),
    /// They do not close.
    #[error(transparent)]
    Shell(#[from] ShellError),
    /// The zone is thicker than the fault's bends allow.
    #[error(
        "it reaches {thick} m from a fault that bends with a radius of {radius:.1} m; no more than half of that can be offset"
    )]
    Bent {
        /// How far it reaches (m).
        thick: f64,
        /// The least radius (m).
        radius: f64,
    },
}

/// What lies no farther than two distances from a fault, below it in its footwall and above it in its hanging wall (m). It reaches beyond a box by
/// a margin (m), and is off by no more than a tolerance (m), by nothing if the fault is a plane.
pub fn slab(
    fault: &FaultSurface,
    [below, above]: [f64; 2],
    [low, high]: [DVec3; 2],
    margin: f64,
    tolerance: f64,
) -> Result<Shell, ZoneError> {
    let sheet = fault.sheet(low, high, margin)?;
    if fault.dip().is_some() {
        let normal = fault.normal(fault.through());
        return prism(
            &sheet.mapped(|p| p - below * normal)?,
            (below + above) * normal,
        );
    }
    check_bends(fault, below.max(above), [low, high])?;
    let thickness = below + above;
    let upright = prism(&sheet, thickness * DVec3::Z)?;
    // Of an upright line above the fault: the line along the normal of its foot.
    let by = |p: DVec3| {
        let foot = fault.height(p.xy()).unwrap_or(p.z);
        let part = (p.z - foot) / thickness;
        let from = p.with_z(foot);
        Ok(from + (part * thickness - below) * fault.normal(from) - p)
    };
    let displacement = Displacement {
        by: &by,
        tolerance: &|_| tolerance,
        degree: DEGREE,
    };
    Ok(Shell::new(displacement.of(upright.sheets())?.sheets)?)
}

/// A sheet, the same sheet elsewhere, and what joins their borders.
fn prism(base: &Surface, by: DVec3) -> Result<Shell, ZoneError> {
    let top = base.mapped(|p| p + by)?;
    let ((u0, u1), (v0, v1)) = (base.knots_u().domain(), base.knots_v().domain());
    let walls = [
        Surface::ruled(&base.isocurve_u(u0), &top.isocurve_u(u0))?,
        Surface::ruled(&base.isocurve_u(u1), &top.isocurve_u(u1))?,
        Surface::ruled(&base.isocurve_v(v0), &top.isocurve_v(v0))?,
        Surface::ruled(&base.isocurve_v(v1), &top.isocurve_v(v1))?,
    ];
    let mut sheets = vec![(Role::Base, base.clone()), (Role::Top, top)];
    sheets.extend(walls.map(|wall| (Role::Hidden, wall)));
    Ok(Shell::new(sheets)?)
}

/// Whether a fault bends gently enough for offsets, in a box.
fn check_bends(fault: &FaultSurface, thick: f64, [low, high]: [DVec3; 2]) -> Result<(), ZoneError> {
    let reach = (high - low).xy().length();
    let middle = 0.5 * (low + high).xy();
    let step = reach / ASKED as f64;
    let places = (0..=ASKED).map(|k| {
        let at = middle + (step * k as f64 - 0.5 * reach) * fault.dip_direction();
        let height = fault.height(at).unwrap_or(0.0);
        at.extend(height)
    });
    let places: Vec<DVec3> = places.collect();
    let bend = |pair: &[DVec3]| {
        let turn = fault.normal(pair[0]).angle_between(fault.normal(pair[1]));
        turn / pair[0].distance(pair[1])
    };
    let most = places.windows(2).map(bend).fold(0.0, f64::max);
    if thick * most > THICKEST {
        return Err(ZoneError::Bent {
            thick,
            radius: 1.0 / most,
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use super::*;

    const BOX: [DVec3; 2] = [DVec3::new(0.0, 0.0, -300.0), DVec3::new(1000.0, 200.0, 0.0)];

    fn check(fault: &FaultSurface, distances: [f64; 2]) {
        let shell = slab(fault, distances, BOX, 50.0, 1e-3).unwrap();
        let sheet = fault.sheet(BOX[0], BOX[1], 0.0).unwrap();
        for k in 0..300 {
            let part = |ratio: f64| 0.05 + 0.9 * (f64::from(k) * ratio).fract();
            let on = sheet.point(part(0.754_877_666), part(0.569_840_291));
            let normal = fault.normal(on);
            let [below, above] = distances;
            for (off, is_inside) in [
                (-below - 0.01, false),
                (-below + 0.01, true),
                (above - 0.01, true),
                (above + 0.01, false),
            ] {
                assert_eq!(shell.contains(on + off * normal), is_inside, "{on} {off}");
            }
        }
    }

    #[test]
    fn a_zone_is_as_thick_as_it_should_be_on_planes_and_along_bends() {
        let through = DVec3::new(300.0, 100.0, 0.0);
        let azimuth = 1.3;
        check(
            &FaultSurface::planar(through, 1.1, azimuth).unwrap(),
            [2.0, 3.0],
        );
        check(
            &FaultSurface::planar(through, std::f64::consts::FRAC_PI_2, azimuth).unwrap(),
            [2.0, 3.0],
        );
        check(
            &FaultSurface::circular(through, 1.0, azimuth, 250.0).unwrap(),
            [4.0, 1.5],
        );
        check(
            &FaultSurface::exponential(through, 1.0, azimuth, 250.0).unwrap(),
            [4.0, 1.5],
        );
    }

    #[test]
    fn a_zone_thicker_than_bends_allow_is_refused_with_their_radius() {
        let fault = FaultSurface::circular(DVec3::new(300.0, 100.0, 0.0), 1.0, 1.3, 100.0).unwrap();
        let error = slab(&fault, [150.0, 1.0], BOX, 50.0, 1e-3).unwrap_err();
        let radius = 100.0 / (1.0 - 1_f64.cos());
        assert!(
            matches!(error, ZoneError::Bent { radius: found, .. } if (found / radius - 1.0).abs() < 0.1)
        );
    }
}

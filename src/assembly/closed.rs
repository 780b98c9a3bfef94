//! Closed surfaces as the kernel's topology: a seam where u begins and ends, a point at either end of v.
//!
//! The surface is cut into a few equal faces around u, all on the same surface. The meridian at the seam
//! has two pcurves, one for u at its start and one for its end; the edges at the poles are degenerate.

use super::kernel::{Edge, Face, Topology};
use super::splines::{EXACT, along_u, along_v, curve, spline};
use crate::nurbs::Surface;

/// The shell of a surface that is closed in u and shrinks to a point at both ends of v, its normal
/// outwards, in so many faces.
pub(crate) fn shell(surface: &Surface, faces: usize) -> Topology {
    let ((u0, u1), v) = (surface.knots_u().domain(), surface.knots_v().domain());
    let at = |k: usize| {
        if k == faces {
            u1
        } else {
            u0 + (u1 - u0) * k as f64 / faces as f64
        }
    };
    let pole = |v: f64| surface.point(u0, v).to_array();
    // Numbering of curves and edges: meridians 0..n; curves at the poles n, n + 1; edges n.., 2n...
    let mut curves: Vec<_> = (0..faces)
        .map(|k| curve(&surface.isocurve_u(at(k))))
        .collect();
    curves.extend([v.0, v.1].map(|v| curve(&surface.isocurve_v(v))));
    let mut edges: Vec<_> = (0..faces)
        .map(|curve| Edge {
            curve,
            range: [v.0, v.1],
            start: 0,
            end: 1,
        })
        .collect();
    for pole in 0..2 {
        edges.extend((0..faces).map(|k| Edge {
            curve: faces + pole,
            range: [at(k), at(k + 1)],
            start: pole,
            end: pole,
        }));
    }
    let face = |k: usize| Face {
        surface: 0,
        reversed: false,
        loops: vec![vec![
            along_u(faces + k, v.0, false),
            along_v((k + 1) % faces, at(k + 1), false),
            along_u(2 * faces + k, v.1, true),
            along_v(k, at(k), true),
        ]],
    };
    Topology {
        vertices: vec![pole(v.0), pole(v.1)],
        curves,
        surfaces: vec![spline(surface)],
        edges,
        faces: (0..faces).map(face).collect(),
        tolerance: EXACT,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use std::f64::consts::PI;

    use glam::DVec3;

    use super::shell;
    use crate::assembly::kernel::{Classifier, Position, solid};
    use crate::features::ellipsoid::EllipsoidDesign;

    #[test]
    fn the_kernel_takes_an_ellipsoid_in_any_number_of_faces_as_the_same_solid() {
        let design = EllipsoidDesign {
            center: DVec3::new(400.0, 300.0, -20.0),
            semi_axes: [9.0, 6.0, 2.5],
            azimuth: 0.6,
            plunge: 0.3,
        };
        let ellipsoid = design.build().unwrap();
        let [a, b, c] = ellipsoid.axes();
        for faces in [1, 2, 4, 6, 8] {
            let shape = solid(&shell(ellipsoid.skin(), faces)).unwrap();
            let mut classifier = Classifier::new(&shape).unwrap();
            for k in 0..200_u32 {
                // A spiral over the whole sphere, a thousandth inside and outside of the surface.
                let z = 1.0 - (2.0 * f64::from(k) + 1.0) / 200.0;
                let angle = PI * (3.0 - 5_f64.sqrt()) * f64::from(k);
                let level = (1.0 - z * z).sqrt();
                let unit = a * (level * angle.cos()) + b * (level * angle.sin()) + c * z;
                let at = |stretch: f64| (design.center + unit * stretch).to_array();
                let mut told = |p| classifier.contains(p, 1e-7).unwrap();
                assert_eq!(told(at(0.999)), Position::In, "{faces} {unit}");
                assert_eq!(told(at(1.001)), Position::Out, "{faces} {unit}");
            }
        }
    }
}

//! Ellipsoids: concretions and cemented nodules as exact rational surfaces (\[J19\] §2.3, §2.4.1).
//!
//! One biquadratic surface, 9 × 5 control points: full circles in u (four quarters, closed by a seam
//! at u = 0 = 1), half circles in v from the lower pole to the upper one, stretched by the semi-axes
//! (PT97 §8.5). The weights are products of 1 and √½. Both v-ends are single points. The normal
//! `S_u × S_v` points **outwards**.

use glam::{DMat3, DVec3, EulerRot};

use super::nudge::Nudge;
use super::trajectory::azimuth_vector;
use crate::nurbs::{KnotError, KnotVector, Surface, SurfaceError};

const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// Control points of the unit circle with their weights, anticlockwise.
const CIRCLE: [(f64, f64, f64); 9] = [
    (1.0, 0.0, 1.0),
    (1.0, 1.0, HALF),
    (0.0, 1.0, 1.0),
    (-1.0, 1.0, HALF),
    (-1.0, 0.0, 1.0),
    (-1.0, -1.0, HALF),
    (0.0, -1.0, 1.0),
    (1.0, -1.0, HALF),
    (1.0, 0.0, 1.0),
];
/// Knots of the circle: a quarter each.
const AROUND: [f64; 12] = [
    0.0, 0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1.0, 1.0, 1.0,
];
/// Control points of the half circle: distance from the axis, height, weight.
const MERIDIAN: [(f64, f64, f64); 5] = [
    (0.0, -1.0, 1.0),
    (1.0, -1.0, HALF),
    (1.0, 0.0, 1.0),
    (1.0, 1.0, HALF),
    (0.0, 1.0, 1.0),
];
/// Knots of the half circle.
const UP: [f64; 8] = [0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0];

/// Angles by which a nudged ellipsoid's seams and poles are turned (rad).
const TURN: [f64; 3] = [0.571, 0.387, 0.443];

/// An ellipsoid's parameters, sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipsoidDesign {
    /// Its centre.
    pub center: DVec3,
    /// Semi-axes (m): the first along azimuth and plunge, the second level and across it, the third at
    /// right angles to both (vertical if the plunge is 0).
    pub semi_axes: [f64; 3],
    /// Direction of the first axis in plan, clockwise from north (rad).
    pub azimuth: f64,
    /// Angle of the first axis below the horizontal (rad).
    pub plunge: f64,
}

/// A closed surface without edges.
#[derive(Clone, Debug, PartialEq)]
pub struct Ellipsoid {
    skin: Surface,
    center: DVec3,
    /// The semi-axes as vectors.
    axes: [DVec3; 3],
}

/// Why numbers make no ellipsoid.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EllipsoidError {
    /// A semi-axis has no length.
    #[error("semi-axis {axis} is {value} m; semi-axes must be above 0")]
    SemiAxis {
        /// Which, from 1.
        axis: usize,
        /// Its length.
        value: f64,
    },
    /// Its knots are wrong.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// Its control points are wrong: the centre or an angle is not finite.
    #[error("the ellipsoid has no surface: {0}")]
    Surface(#[from] SurfaceError),
}

impl EllipsoidError {
    /// The reason in two or three words, for counts of rejected draws.
    pub fn reason(&self) -> &'static str {
        match self {
            Self::SemiAxis { .. } => "semi-axis not above 0",
            Self::Knots(_) | Self::Surface(_) => "impossible ellipsoid",
        }
    }
}

impl EllipsoidDesign {
    /// The ellipsoid.
    pub fn build(&self) -> Result<Ellipsoid, EllipsoidError> {
        let bad = |value: &f64| !(*value > 0.0 && value.is_finite());
        if let Some(at) = self.semi_axes.iter().position(bad) {
            return Err(EllipsoidError::SemiAxis {
                axis: at + 1,
                value: self.semi_axes[at],
            });
        }
        let axes = self.axes();
        let mut net = Vec::with_capacity(CIRCLE.len() * MERIDIAN.len());
        let mut weights = Vec::with_capacity(net.capacity());
        for (x, y, around) in CIRCLE {
            for (reach, z, up) in MERIDIAN {
                let point = axes[0] * (reach * x) + axes[1] * (reach * y) + axes[2] * z;
                net.push(self.center + point);
                weights.push(around * up);
            }
        }
        let (u, v) = (
            KnotVector::new(2, AROUND.to_vec())?,
            KnotVector::new(2, UP.to_vec())?,
        );
        Ok(Ellipsoid {
            skin: Surface::rational(u, v, net, weights)?,
            center: self.center,
            axes,
        })
    }

    /// The semi-axes as vectors, right-handed: along azimuth and plunge, level to the left of that, up.
    fn axes(&self) -> [DVec3; 3] {
        let [a, b, c] = self.semi_axes;
        let heading = azimuth_vector(self.azimuth);
        let (sin, cos) = self.plunge.sin_cos();
        let first = (heading * cos).extend(-sin);
        let left = heading.perp().extend(0.0);
        [first * a, left * b, first.cross(left) * c]
    }
}

impl Ellipsoid {
    /// Its surface: u around (anticlockwise seen from its upper pole) from the first axis, v from the
    /// lower pole to the upper one, the normal outwards.
    pub fn skin(&self) -> &Surface {
        &self.skin
    }

    /// See [`super::body::Body::nudged`]: smaller by the rise along its shortest axis, and moved. Its seams and poles are
    /// elsewhere, too: a wall or a horizon through its centre would run along them.
    pub(super) fn nudged(&self, nudge: &Nudge) -> Result<Self, SurfaceError> {
        let shortest = self
            .axes
            .iter()
            .fold(f64::INFINITY, |least, axis| least.min(axis.length()));
        let (scale, shift) = (1.0 - nudge.rise / shortest, nudge.shift);
        // A turn of the unit sphere about no direction that symmetry prefers: the ellipsoid stays the same.
        let turn = DMat3::from_euler(EulerRot::ZYX, TURN[0], TURN[1], TURN[2]);
        let [a, b, c] = self.axes;
        let turned = DMat3::from_cols(a, b, c) * turn;
        let back = DMat3::from_cols(a, b, c).inverse();
        let moved = |p: &DVec3| {
            let unit = back * (*p - self.center);
            self.center + shift + scale * (turned * unit)
        };
        let (u, v) = (self.skin.knots_u().clone(), self.skin.knots_v().clone());
        let net = self.skin.net().iter().map(moved).collect();
        Ok(Self {
            skin: Surface::rational(u, v, net, self.skin.weights().to_vec())?,
            center: self.center + shift,
            axes: self.axes.map(|axis| scale * axis),
        })
    }

    /// The same ellipsoid elsewhere.
    #[must_use]
    pub fn moved(&self, by: DVec3) -> Self {
        Self {
            skin: self.skin.moved(by),
            center: self.center + by,
            axes: self.axes,
        }
    }

    /// Whether it holds a point. On its surface that is a matter of rounding.
    pub fn contains(&self, point: DVec3) -> bool {
        self.unit(point).length_squared() < 1.0
    }

    /// Whether its surface comes within a distance of a point (m), to first order of that.
    pub fn is_near(&self, point: DVec3, distance: f64) -> bool {
        let unit = self.unit(point);
        let length = unit.length();
        let off = (length - 1.0).abs();
        let [shortest, longest] = self.axes.iter().fold([f64::INFINITY, 0.0], |range, axis| {
            [axis.length().min(range[0]), axis.length().max(range[1])]
        });
        // One unit of the unit sphere is at least the shortest semi-axis, at most the longest.
        if off * shortest > distance {
            return false;
        }
        if off * longest <= distance {
            return true;
        }
        // The gradient of the length by the point, of which `off` is the change.
        let unit = unit / length;
        let gradient = (0..3).fold(DVec3::ZERO, |sum, i| {
            sum + self.axes[i] * (unit[i] / self.axes[i].length_squared())
        });
        off <= distance * gradient.length()
    }

    /// A point in the frame in which it is the unit sphere. Its semi-axes are at right angles.
    fn unit(&self, point: DVec3) -> DVec3 {
        let from = point - self.center;
        DVec3::from_array(self.axes.map(|axis| from.dot(axis) / axis.length_squared()))
    }

    /// Its centre.
    pub fn center(&self) -> DVec3 {
        self.center
    }

    /// Its semi-axes as vectors: first, second (to the left of it) and third (upwards).
    pub fn axes(&self) -> [DVec3; 3] {
        self.axes
    }

    /// The corners of its box: the half-extent along a coordinate is the norm of the semi-axes' shares.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let squares: DVec3 = self.axes.iter().map(|axis| axis * axis).sum();
        let reach = DVec3::new(squares.x.sqrt(), squares.y.sqrt(), squares.z.sqrt());
        (self.center - reach, self.center + reach)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use std::f64::consts::PI;

    use glam::DVec3;

    use super::{Ellipsoid, EllipsoidDesign, EllipsoidError};
    use crate::nurbs::enclosure::Enclosure;
    use crate::nurbs::quadrature;

    /// Axes of 30, 12 and 5 m, the first towards N 50° E and 20° down.
    const TILTED: EllipsoidDesign = EllipsoidDesign {
        center: DVec3::new(431.0, -652.0, -20.0),
        semi_axes: [30.0, 12.0, 5.0],
        azimuth: 50.0 * PI / 180.0,
        plunge: 20.0 * PI / 180.0,
    };

    fn grid(n: usize) -> impl Iterator<Item = (f64, f64)> {
        let steps = move || (0..=n).map(move |i| i as f64 / n as f64);
        steps().flat_map(move |u| steps().map(move |v| (u, v)))
    }

    #[test]
    fn a_point_is_inside_and_near_as_the_closed_surface_says() {
        let ellipsoid = TILTED.build().unwrap();
        let shell = Enclosure::new(vec![ellipsoid.skin().clone()]).unwrap();
        let (low, high) = ellipsoid.bounds();
        let mut counts = [0; 4];
        for k in 0..4000 {
            let part = |ratio: f64| (f64::from(k) * ratio).fract();
            let unit = DVec3::new(
                part(0.819_172_513),
                part(0.671_043_607),
                part(0.549_700_478),
            );
            let point = low + (high - low) * unit;
            assert_eq!(ellipsoid.contains(point), shell.contains(point), "{point}");
            counts[usize::from(ellipsoid.contains(point))] += 1;
        }
        // Points at known distances from the surface.
        for (u, v) in grid(12) {
            let Some(normal) = ellipsoid.skin().normal(u, v) else {
                continue;
            };
            for off in [-1e-3, 1e-3, -1e-6, 1e-6_f64] {
                let point = ellipsoid.skin().point(u, v) + off * normal;
                assert_eq!(ellipsoid.contains(point), off < 0.0);
                assert!(ellipsoid.is_near(point, 1.01 * off.abs()));
                assert!(!ellipsoid.is_near(point, 0.99 * off.abs()));
                counts[2 + usize::from(off > 0.0)] += 1;
            }
        }
        assert!(counts.iter().all(|count| *count > 200), "{counts:?}");
        assert!(ellipsoid.is_near(TILTED.center, 31.0) && !ellipsoid.is_near(TILTED.center, 4.9));
    }

    /// (first, second, third) / semi-axes, with the rotation written out by its angles.
    fn coordinates(design: &EllipsoidDesign, p: DVec3) -> [f64; 3] {
        let d = p - design.center;
        let (sa, ca) = design.azimuth.sin_cos();
        let (sp, cp) = design.plunge.sin_cos();
        let ahead = d.x * sa + d.y * ca;
        let left = d.y * sa - d.x * ca;
        let [a, b, c] = design.semi_axes;
        [
            (ahead * cp - d.z * sp) / a,
            left / b,
            (ahead * sp + d.z * cp) / c,
        ]
    }

    #[test]
    fn every_point_of_the_surface_satisfies_the_ellipsoids_equation() {
        let ellipsoid = TILTED.build().unwrap();
        for (u, v) in grid(97) {
            let [x, y, z] = coordinates(&TILTED, ellipsoid.skin().point(u, v));
            // Relative to the centre's distance from the origin: 780 m, 156 times the least semi-axis.
            let miss = x * x + y * y + z * z - 1.0;
            assert!(miss.abs() < 1e-12, "{u} {v}: {miss:e}");
        }
    }

    #[test]
    fn the_first_axis_points_where_azimuth_and_plunge_say() {
        let ellipsoid = TILTED.build().unwrap();
        let tip = ellipsoid.skin().point(0.0, 0.5) - TILTED.center;
        // 30 m, 20° down, N 50° E.
        let level = 30.0 * 20_f64.to_radians().cos();
        let expected = DVec3::new(
            level * 50_f64.to_radians().sin(),
            level * 50_f64.to_radians().cos(),
            -30.0 * 20_f64.to_radians().sin(),
        );
        assert!(tip.distance(expected) < 1e-12, "{tip}");
        assert!((ellipsoid.axes()[0] - expected).length() < 1e-12);
        let side = ellipsoid.skin().point(0.25, 0.5) - TILTED.center;
        assert!(side.z.abs() < 1e-12 && (side.length() - 12.0).abs() < 1e-12);
        let top = ellipsoid.skin().point(0.3, 1.0) - TILTED.center;
        assert!(top.z > 0.0 && (top.length() - 5.0).abs() < 1e-12);
    }

    #[test]
    fn the_normal_is_the_gradient_of_the_equation_and_points_outwards() {
        let ellipsoid = TILTED.build().unwrap();
        let [a, b, c] = ellipsoid.axes();
        for (u, v) in grid(24) {
            let d = ellipsoid.skin().point(u, v) - TILTED.center;
            let gradient: DVec3 = [a, b, c]
                .iter()
                .map(|axis| *axis * d.dot(*axis) / axis.length_squared().powi(2))
                .sum();
            let normal = ellipsoid.skin().normal(u, v).unwrap();
            assert!(
                normal.distance(gradient.normalize()) < 1e-9,
                "{u} {v}: {normal} {gradient}"
            );
        }
    }

    /// The flux of (p − centre)/3 through the surface, by Gauss's rule of 8 points on n pieces each way.
    fn volume(ellipsoid: &Ellipsoid, pieces: usize) -> f64 {
        let nodes: Vec<(f64, f64)> = (0..pieces)
            .flat_map(|k| {
                let at = |k: usize| k as f64 / pieces as f64;
                quadrature::between(quadrature::EIGHT, at(k), at(k + 1))
            })
            .collect();
        let mut sum = 0.0;
        for (u, wu) in &nodes {
            for (v, wv) in &nodes {
                let d = ellipsoid.skin().derivatives(*u, *v, 1);
                let normal = d[1][0].cross(d[0][1]);
                sum += wu * wv * (d[0][0] - ellipsoid.center()).dot(normal) / 3.0;
            }
        }
        sum
    }

    #[test]
    fn the_volume_is_four_thirds_pi_a_b_c() {
        let ellipsoid = TILTED.build().unwrap();
        let expected = 4.0 / 3.0 * PI * 30.0 * 12.0 * 5.0;
        let found = volume(&ellipsoid, 4);
        assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
    }

    #[test]
    fn the_shell_holds_the_points_that_the_equation_holds() {
        let ellipsoid = TILTED.build().unwrap();
        let shell = Enclosure::new(vec![ellipsoid.skin().clone()]).unwrap();
        let (low, high) = ellipsoid.bounds();
        let n = 24;
        for i in 0..n * n * n {
            // Beyond the box too, and never on the surface.
            let part = |k: usize| (k as f64 + 0.487) / n as f64 * 1.2 - 0.1;
            let unit = DVec3::new(part(i % n), part(i / n % n), part(i / n / n));
            let p = low + (high - low) * unit;
            let [x, y, z] = coordinates(&TILTED, p);
            assert_eq!(shell.contains(p), x * x + y * y + z * z < 1.0, "{p}");
        }
    }

    #[test]
    fn the_box_touches_the_surface_on_all_sides() {
        let ellipsoid = TILTED.build().unwrap();
        let (low, high) = ellipsoid.bounds();
        let (least, greatest) = ellipsoid.skin().bounds();
        assert!((low - least).abs().max_element() < 1e-6, "{low} {least}");
        assert!((high - greatest).abs().max_element() < 1e-6);
    }

    #[test]
    fn a_semi_axis_without_length_makes_no_ellipsoid() {
        for value in [0.0, -3.0, f64::NAN, f64::INFINITY] {
            let design = EllipsoidDesign {
                semi_axes: [3.0, value, 1.0],
                ..TILTED
            };
            let error = design.build().unwrap_err();
            assert!(matches!(error, EllipsoidError::SemiAxis { axis: 2, .. }));
            assert_eq!(error.reason(), "semi-axis not above 0");
        }
    }
}

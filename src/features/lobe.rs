//! Lobes: one exact template for turbidite lobes, mouth bars and crevasse splays (our reconstruction).
//!
//! Over the unit disc, X along the axis and downstream, r² = X² + Y²:
//!
//! ```text
//! x = a X,   y = b Y (1 + τ X),   z = base + H (1 − r²)(1 − λ X)
//! ```
//!
//! τ tapers the plan (0 is an ellipse; above 0 it is widest downstream), λ skews the thickness (above 0 it is thickest upstream).
//! The plan's area is π a b, the volume (π/2) a b H (1 − λτ/6).
//!
//! The cap is exact: a quarter of the circle is c(v)/w(v), s(v)/w(v) with quadratic c, s, w. Lines of v run from a pole at (p, q)
//! (the middle, unless something else is asked for) straight to the circle, X = p (1 − u) + u c/w and Y = q (1 − u) + u s/w. So with
//! W = w² the homogeneous coordinates
//!
//! ```text
//! x W = a (p (1 − u) w² + u c w)
//! y W = b (q (1 − u) w + u s)(w + τ (p (1 − u) w + u c))
//! z W = base w² + H (1 − u) (A w − 2 u (p c + q s))(B w − λ u c),   A = 1 + u − (p² + q²)(1 − u),   B = 1 − λ p (1 − u)
//! ```
//!
//! are polynomials of degree 3 in u and 4 in v. Cap and base share the rim's control points; both have the pole.

use std::f64::consts::FRAC_1_SQRT_2;

use glam::{DVec2, DVec3};

use super::body::Role;
use super::shell::{Shell, ShellError};
use super::trajectory::{Place, azimuth_vector};
use crate::nurbs::{KnotError, KnotVector, Surface, SurfaceError};

/// Greatest taper and skew.
pub const MOST: f64 = 0.9;
/// A mouth bar's length and width in the channel's widths, its taper and its skew.
const MOUTH_BAR: [f64; 4] = [5.0, 3.2, 0.5, 0.3];
/// How far inside the channel a mouth bar begins, in the channel's widths: at its very end the rim would touch the end's plane.
const INSIDE: f64 = 0.1;
/// How far a base is sunk below what it lies on, as a fraction of the thickness: so that it does not coincide with it.
pub const SUNK: f64 = 0.02;

/// A lobe's parameters, sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LobeDesign {
    /// Middle of the disc (X = Y = 0), at the elevation of the base.
    pub center: DVec3,
    /// Length along the axis (m).
    pub length: f64,
    /// Width across (m): that of the ellipse without taper.
    pub width: f64,
    /// Greatest thickness (m).
    pub thickness: f64,
    /// Direction of the axis, downstream, clockwise from north (rad).
    pub azimuth: f64,
    /// τ, −0.9 to 0.9.
    pub taper: f64,
    /// λ, −0.9 to 0.9.
    pub skew: f64,
}

/// Where the lines are along which a lobe's sheets are parametrized. The lobe is the same whatever they are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LobeLines {
    /// The pole (X, Y) on the unit disc, from which they run to the rim.
    pub pole: DVec2,
    /// By how much the seam, and the three other lines at which sheets are less smooth, are turned about the middle (rad).
    pub turn: f64,
}

impl LobeLines {
    /// Away from all that symmetry prefers: a wall through the middle of a lobe, along its axis or across, would pass through its
    /// pole and run along its seam.
    pub const ASIDE: Self = Self {
        pole: DVec2::new(0.137, 0.211),
        turn: 0.571,
    };
}

/// A lobe that is possible.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lobe {
    design: LobeDesign,
    /// H.
    height: f64,
    axis: DVec2,
}

/// Why numbers make no lobe.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LobeError {
    /// A length that is none.
    #[error("the lobe's {name} is {value} m: it must be a positive, finite length")]
    Size {
        /// `length`, `width` or `thickness`.
        name: &'static str,
        /// The offending length.
        value: f64,
    },
    /// Taper or skew out of range.
    #[error("the lobe's {name} is {value}: keep it within −{MOST} to {MOST}")]
    Shape {
        /// `taper` or `skew`.
        name: &'static str,
        /// The number.
        value: f64,
    },
    /// A pole beyond the rim.
    #[error("the lobe's pole is at {0} on the disc of radius 1: keep it within that")]
    Pole(DVec2),
    /// A place or a direction that is none.
    #[error("the lobe's centre {center} and azimuth {azimuth} must be finite")]
    Place {
        /// The centre.
        center: DVec3,
        /// The azimuth (rad).
        azimuth: f64,
    },
    /// It has no knots.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// A sheet is no surface.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// It has no closed shell.
    #[error(transparent)]
    Shell(#[from] ShellError),
}

/// X at which (1 − X²)(1 − λX) is greatest.
fn thickest(skew: f64) -> f64 {
    if skew.abs() < 1e-8 {
        return -0.5 * skew;
    }
    (1.0 - (1.0 + 3.0 * skew * skew).sqrt()) / (3.0 * skew)
}

impl LobeDesign {
    /// The same lobe with its middle at a place in plan.
    #[must_use]
    pub fn with_center(self, center: DVec2) -> Self {
        Self {
            center: center.extend(self.center.z),
            ..self
        }
    }

    /// The same lobe with its upstream end at a place in plan.
    #[must_use]
    pub fn with_apex(self, apex: DVec2) -> Self {
        let center = apex + 0.5 * self.length * azimuth_vector(self.azimuth);
        Self {
            center: center.extend(self.center.z),
            ..self
        }
    }

    /// The mouth bar at the end of a channel of some width and depth, with its top at an elevation (m).
    pub fn mouth_bar(end: &Place, width: f64, depth: f64, top: f64) -> Self {
        let [length, across, taper, skew] = MOUTH_BAR;
        let tangent = end.tangent();
        let bar = Self {
            center: DVec3::new(0.0, 0.0, top - (1.0 + SUNK) * depth),
            length: length * width,
            width: across * width,
            thickness: depth,
            azimuth: tangent.x.atan2(tangent.y),
            taper,
            skew,
        };
        bar.with_apex(Self::mouth(end, width))
    }

    /// Where the mouth bar of a channel of some width begins, in plan: a little upstream of the channel's end.
    pub fn mouth(end: &Place, width: f64) -> DVec2 {
        end.point - INSIDE * width * end.tangent()
    }

    /// The lobe, if there is one.
    pub fn build(&self) -> Result<Lobe, LobeError> {
        let sizes = [
            ("length", self.length),
            ("width", self.width),
            ("thickness", self.thickness),
        ];
        // Written so that numbers that are none fail too.
        for (name, value) in sizes {
            if !(value > 0.0 && value.is_finite()) {
                return Err(LobeError::Size { name, value });
            }
        }
        for (name, value) in [("taper", self.taper), ("skew", self.skew)] {
            if !(value.abs() <= MOST) {
                return Err(LobeError::Shape { name, value });
            }
        }
        if !(self.center.is_finite() && self.azimuth.is_finite()) {
            return Err(LobeError::Place {
                center: self.center,
                azimuth: self.azimuth,
            });
        }
        let x = thickest(self.skew);
        Ok(Lobe {
            design: *self,
            height: self.thickness / ((1.0 - x * x) * (1.0 - self.skew * x)),
            axis: azimuth_vector(self.azimuth),
        })
    }
}

impl Lobe {
    /// Its parameters.
    pub fn design(&self) -> &LobeDesign {
        &self.design
    }

    /// Its volume (m³).
    pub fn volume(&self) -> f64 {
        let LobeDesign {
            length,
            width,
            taper,
            skew,
            ..
        } = self.design;
        std::f64::consts::PI / 8.0 * length * width * self.height * (1.0 - skew * taper / 6.0)
    }

    /// The corners of a box in plan that holds it.
    pub fn plan(&self) -> [DVec2; 2] {
        let LobeDesign {
            center,
            length,
            width,
            taper,
            ..
        } = self.design;
        // |b Y (1 + τ X)| is at most b (1 + |τ|).
        let across = 0.5 * width * (1.0 + taper.abs()) * self.axis.perp().abs();
        let reach = 0.5 * length * self.axis.abs() + across;
        [center.truncate() - reach, center.truncate() + reach]
    }

    /// Its thickness at a place in plan (m); 0 beyond its rim.
    pub fn thickness_at(&self, at: DVec2) -> f64 {
        let from = at - self.design.center.truncate();
        let along = from.dot(self.axis) / (0.5 * self.design.length);
        if along.abs() >= 1.0 {
            return 0.0;
        }
        let wide = 0.5 * self.design.width * (1.0 + self.design.taper * along);
        let across = from.perp_dot(self.axis) / wide;
        let rest = 1.0 - along * along - across * across;
        (self.height * rest * (1.0 - self.design.skew * along)).max(0.0)
    }

    /// Its closed shell: [`Role::Top`], the cap, and [`Role::Base`], u from the pole to the rim.
    pub fn shell(&self) -> Result<Shell, LobeError> {
        self.along(LobeLines::default())
    }

    /// The same along other lines: with its pole where nothing passes by, since next to a pole curves are hard to follow.
    pub fn along(&self, lines: LobeLines) -> Result<Shell, LobeError> {
        self.eroding(0.0, lines)
    }

    /// The same of a lobe that erodes what it lies on: its base is as much deeper than its rim as a fraction of its thickness says.
    pub fn eroding(&self, erosion: f64, lines: LobeLines) -> Result<Shell, LobeError> {
        // Written so that a number that is none fails too.
        if !(lines.pole.length() < 1.0) {
            return Err(LobeError::Pole(lines.pole));
        }
        let (net, weights) = self.cap(lines);
        let around: Vec<f64> = (0..=4)
            .flat_map(|quarter| {
                let times = if quarter % 4 == 0 { 5 } else { 4 };
                std::iter::repeat_n(f64::from(quarter) / 4.0, times)
            })
            .collect();
        let around = KnotVector::new(4, around)?;
        let radial = KnotVector::uniform(3, 4)?;
        let level = self.design.center.z;
        let flat = |p: &DVec3| p.with_z(level - erosion * (p.z - level));
        // The same places in plan, so that cap and base have one net of knots whatever they are bent to.
        let base = net.iter().map(flat).collect();
        let sheet = |net| Surface::rational(radial.clone(), around.clone(), net, weights.clone());
        let (top, base) = (sheet(net)?, sheet(base)?);
        Ok(Shell::new(vec![(Role::Top, top), (Role::Base, base)])?)
    }

    /// Control points and weights of the cap: 4 along u, 17 around.
    fn cap(&self, lines: LobeLines) -> (Vec<DVec3>, Vec<f64>) {
        let LobeDesign { taper, skew, .. } = self.design;
        let DVec2 { x: p, y: q } = lines.pole;
        let square = lines.pole.length_squared();
        // Polynomials in u, by their powers: u, 1 − u, A, B, and what the taper makes of the width on the way from the pole.
        let u = [0.0, 1.0];
        let inward = [1.0, -1.0];
        let wide = [1.0 - square, 1.0 + square];
        let thick = [1.0 - skew * p, skew * p];
        let tapered = [1.0 + taper * p, -taper * p];
        let times = |a: &[f64], b: &[f64]| {
            let mut product = [0.0; 4];
            for (i, a) in a.iter().enumerate() {
                for (j, b) in b.iter().enumerate() {
                    product[i + j] += a * b;
                }
            }
            product
        };
        let scaled = |a: [f64; 4], factor: f64| a.map(|power| factor * power);
        let sum = |a: [f64; 4], b: [f64; 4]| std::array::from_fn(|i| a[i] + b[i]);
        let both = times(&inward, &u);
        let x = [scaled(times(&inward, &[1.0]), p), times(&u, &[1.0])];
        let y = [
            scaled(times(&inward, &tapered), q),
            scaled(both, q * taper),
            times(&u, &tapered),
            scaled(times(&u, &u), taper),
        ];
        let z = [
            times(&times(&inward, &wide)[..3], &thick),
            sum(
                scaled(times(&both[..3], &wide), -skew),
                scaled(times(&both[..3], &thick), -2.0 * p),
            ),
            scaled(times(&both[..3], &thick), -2.0 * q),
            scaled(times(&both[..3], &u), 2.0 * q * skew),
            scaled(times(&both[..3], &u), 2.0 * p * skew),
        ];
        let (x, y, z) = (x.map(bernstein), y.map(bernstein), z.map(bernstein));
        let (mut net, mut weights) = (Vec::with_capacity(68), Vec::with_capacity(68));
        for row in 0..4 {
            for quarter in 0..4 {
                let [ww, cw, sw, cs, cc] = products(quarter, lines.turn);
                // A quarter begins where the one before it ends.
                for k in usize::from(quarter > 0)..5 {
                    let sum_of = |of: &[[f64; 4]], around: &[[f64; 5]]| {
                        let terms = of
                            .iter()
                            .zip(around)
                            .map(|(of, around)| of[row] * around[k]);
                        terms.sum::<f64>()
                    };
                    let x = 0.5 * self.design.length * sum_of(&x, &[ww, cw]);
                    let y = 0.5 * self.design.width * sum_of(&y, &[ww, cw, sw, cs]);
                    let z = self.height * sum_of(&z, &[ww, cw, sw, cs, cc]);
                    // The rim is at the base's elevation to the last bit.
                    let z = if row == 3 { 0.0 } else { z / ww[k] };
                    let plan = (self.axis * x + self.axis.perp() * y) / ww[k];
                    net.push(self.design.center + plan.extend(z));
                    weights.push(ww[k]);
                }
            }
        }
        // The seam is closed, and the pole a point, to the last bit.
        for row in net.chunks_mut(17) {
            row[16] = row[0];
        }
        let (first, rest) = net.split_at_mut(1);
        rest[..16].fill(first[0]);
        (net, weights)
    }
}

/// Bernstein coefficients of a polynomial of degree 3 given by its powers.
fn bernstein(powers: [f64; 4]) -> [f64; 4] {
    let [a, b, c, d] = powers;
    [a, a + b / 3.0, a + 2.0 * b / 3.0 + c / 3.0, a + b + c + d]
}

/// Of a quarter of the unit circle, c/w and s/w, turned (rad): the Bernstein coefficients of w², c w, s w, c s and c².
fn products(quarter: usize, turn: f64) -> [[f64; 5]; 5] {
    let turned = DVec2::from_angle(turn);
    let corner = |k: usize| turned.rotate([DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y][k % 4]);
    let (from, to) = (corner(quarter), corner(quarter + 1));
    let middle = (from + to) * FRAC_1_SQRT_2;
    let (c, s, w) = (
        [from.x, middle.x, to.x],
        [from.y, middle.y, to.y],
        [1.0, FRAC_1_SQRT_2, 1.0],
    );
    [
        product(&w, &w),
        product(&c, &w),
        product(&s, &w),
        product(&c, &s),
        product(&c, &c),
    ]
}

/// The product of two quadratic polynomials in Bernstein form.
fn product(a: &[f64; 3], b: &[f64; 3]) -> [f64; 5] {
    const OF_TWO: [f64; 3] = [1.0, 2.0, 1.0];
    const OF_FOUR: [f64; 5] = [1.0, 4.0, 6.0, 4.0, 1.0];
    let mut sum = [0.0; 5];
    for i in 0..3 {
        for j in 0..3 {
            sum[i + j] += OF_TWO[i] * OF_TWO[j] / OF_FOUR[i + j] * a[i] * b[j];
        }
    }
    sum
}

#[cfg(test)]
#[path = "lobe_tests.rs"]
mod tests;

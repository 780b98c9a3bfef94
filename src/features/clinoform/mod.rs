//! Clinoforms: the sheets of a set that steps into a basin (\[J19\] §3.5, after Graham et al. 2015).
//!
//! In the coordinates d and q of [`ClinoformFrame`] a sheet with origin P runs from the ellipse at which it is truncated
//! by the top, `d_top(q) = P + tD √(1 − q²/tS²)`, to the one at which it laps down on the base, `d_toe(q)`, of which both
//! semi-extents are larger by the length L. v = (q + Q)/2Q and u, from 0 to 1 between the ellipses, are linear in plan.
//! With s = 1 − u, exponent E and toe fraction t,
//!
//! ```text
//! w = (1 − t) s^E + t s          z = z_base + w (z_top − z_base)
//! ```
//!
//! where `z_base` and `z_top` are the horizons' heights at the same place. Above the top the formula goes on; below the
//! base a sheet goes on along its tangent, unless it touches a level base: then it ends there.
//!
//! The ellipses are cubic splines in v. Between level horizons with E = 2 the net is exact in u, with three control
//! points; else z is interpolated, with cubic splines that are refined until the sheet is near enough to the
//! formula in the domain ([`ClinoformFrame::tolerance`] in plan, [`ClinoformUnit::tolerance`] in elevation): evenly at
//! first, then where it is not. \[J19\] measures radially instead of along dip; for its Table 1 this makes a difference
//! of less than 3 mm in z.

mod design;
mod net;

use std::sync::Arc;

use glam::{DVec2, DVec3, Vec3Swizzles};

pub use self::design::{ClinoformDesign, ClinoformError};
use self::net::{Fit, Net, between};
use super::body::Role;
use super::frame::{ClinoformFrame, ClinoformUnit};
use super::side::{Borders, Ends, Open, Side};
use crate::nurbs::{Function, Surface};

/// A sheet of a clinoform set.
#[derive(Clone, Debug, PartialEq)]
pub struct Clinoform {
    frame: ClinoformFrame,
    surface: Surface,
    top: Function,
    toe: Function,
    /// Landward of the first d (m) there is no sheet at any strike, basinward of the second neither.
    dips: [f64; 2],
    deviation: f64,
}

impl Clinoform {
    /// The sheet of a design in a unit.
    pub fn new(
        design: &ClinoformDesign,
        frame: &ClinoformFrame,
        unit: &ClinoformUnit,
    ) -> Result<Self, ClinoformError> {
        design.check(frame, unit)?;
        let fit = Fit {
            design,
            frame,
            unit,
        };
        let Net {
            across,
            along,
            heights,
            ellipses: [top, toe],
            deviation,
        } = fit.refined()?;
        let mut net = Vec::with_capacity(heights.len());
        for i in 0..across.count() {
            let u = across.greville(i);
            for j in 0..along.count() {
                let q = frame.reach() * (2.0 * along.greville(j) - 1.0);
                let d = between(top.coefficients()[j], toe.coefficients()[j], u);
                net.push(frame.place(d, q).extend(heights[net.len()]));
            }
        }
        // A spline function lies between its coefficients.
        let (first, last) = across.domain();
        let ends = top.coefficients().iter().zip(toe.coefficients());
        let dips = ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], (a, b)| {
            let [start, end] = [first, last].map(|u| between(*a, *b, u));
            [low.min(start), high.max(end)]
        });
        Ok(Self {
            frame: frame.clone(),
            dips,
            surface: Surface::new(across, along, net)?,
            top,
            toe,
            deviation,
        })
    }

    /// The frame of its set.
    pub fn frame(&self) -> &ClinoformFrame {
        &self.frame
    }

    /// The sheet: u from above the top (below 0) through the top's ellipse (0) to the toe's (1) or below it, v along
    /// strike from 0 to 1.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// How far the sheet was found to be from its formula in the domain, at the most (m).
    pub fn deviation(&self) -> f64 {
        self.deviation
    }

    /// d (m) at which the sheet leaves the top, at a strike q (m).
    pub fn d_top(&self, q: f64) -> f64 {
        self.top.value(self.v(q))
    }

    /// d (m) at which the sheet reaches the base, at a strike q (m).
    pub fn d_toe(&self, q: f64) -> f64 {
        self.toe.value(self.v(q))
    }

    /// Whether a point lies above the sheet, or basinward of all of it.
    pub fn holds(&self, point: DVec3) -> bool {
        let DVec2 { x: d, y: q } = self.frame.local(point.xy());
        if d < self.dips[0] || d > self.dips[1] {
            return d > self.dips[1];
        }
        let (u, v) = self.parameters(d, q);
        let (first, last) = self.surface.knots_u().domain();
        if u <= first {
            false
        } else {
            u >= last || point.z > self.surface.point(u, v).z
        }
    }

    /// The sheet's elevation (m) at d and q (m); `None` past its toe and landward of its upper border.
    pub fn elevation(&self, d: f64, q: f64) -> Option<f64> {
        let (u, v) = self.parameters(d, q);
        let (first, _) = self.surface.knots_u().domain();
        (first..=1.0)
            .contains(&u)
            .then(|| self.surface.point(u, v).z)
    }

    /// The sheet's elevation (m) at a place in plan; beyond its borders that of its tangent planes there.
    pub fn height(&self, at: DVec2) -> f64 {
        let DVec2 { x: d, y: q } = self.frame.local(at);
        let reach = self.frame.reach();
        let edge = q.clamp(-reach, reach);
        let (u, v) = self.parameters(d, edge);
        let (first, last) = self.surface.knots_u().domain();
        let on = u.clamp(first, last);
        let of = self.surface.derivatives(on, v, 1);
        let (along_u, along_v) = (of[1][0], of[0][1]);
        let height = of[0][0].z + along_u.z * (u - on);
        if q == edge {
            return height;
        }
        // Along strike at one d: v alone, and u by so much that d stays.
        let dips = |step: DVec3| step.xy().dot(self.frame.dip());
        let strikes = along_v.xy().dot(self.frame.strike());
        let slope = (along_v.z - along_u.z * dips(along_v) / dips(along_u)) / strikes;
        height + slope * (q - edge)
    }

    /// Whether the sheet meets its base at no angle, as without a toe.
    pub fn is_tangent_to_base(&self) -> bool {
        let height = |u: f64| self.surface.point(u, 0.5).z;
        // A thousandth up the profile a straight toe has risen by a thousandth of its share of the height, a curved one by less.
        let part = (height(0.999) - height(1.0)) / (height(0.0) - height(1.0));
        part < 5e-5
    }

    fn v(&self, q: f64) -> f64 {
        let reach = self.frame.reach();
        ((q + reach) / (2.0 * reach)).clamp(0.0, 1.0)
    }

    fn parameters(&self, d: f64, q: f64) -> (f64, f64) {
        let v = self.v(q);
        let (top, toe) = (self.top.value(v), self.toe.value(v));
        ((d - top) / (toe - top), v)
    }
}

impl Open for Clinoform {
    fn sheets(&self) -> &[Surface] {
        std::slice::from_ref(self.surface())
    }

    fn holds(&self, point: DVec3) -> bool {
        Self::holds(self, point)
    }

    fn height(&self, at: DVec2) -> Option<f64> {
        Some(Self::height(self, at))
    }
}

impl From<Clinoform> for Side {
    fn from(clinoform: Clinoform) -> Self {
        let ends = Ends::Hanging {
            frame: clinoform.frame().clone(),
            borders: Borders::Unit {
                is_tangent: clinoform.is_tangent_to_base(),
            },
        };
        Self::new(Role::Open("clinoform"), Arc::new(clinoform), ends)
    }
}

#[cfg(test)]
mod tests;

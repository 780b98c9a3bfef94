//! Fabric: three directions at right angles that rock has by how it was laid down, and tensors along them.
//!
//! e₁ points down dip, or along what flowed; e₂ runs along strike, or across the flow; e₃ is the normal of the layers. A property that has a
//! value along each of these is the symmetric tensor K = Σ kᵢ eᵢ eᵢᵀ. A volume has one fabric: that of the *mean* plane of the sheet that
//! it lies on, or of the *mean* direction of its channel. A sinuous channel loses anisotropy by that, which a tensor at each place
//! would keep.

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::body::Body;
use super::ellipsoid::Ellipsoid;
use super::extent::Extent;
use super::horizon::Horizon;
use super::side::{Borders, Ends, Side};
use super::trajectory::Trajectory;
use crate::nurbs::Surface;

/// Samples of a sheet along u and v.
const ACROSS: usize = 48;
/// Slopes below this are none: which way so flat a plane dips is rounding.
const LEVEL: f64 = 1e-9;
/// Entries of a tensor below this part of its greatest value are rounding.
const ROUNDING: f64 = 1e-14;
/// A way whose ends are nearer than this fraction of its length leads nowhere.
const NOWHERE: f64 = 1e-6;

/// Directions of layers; of length 1, at right angles, right-handed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fabric {
    /// Down dip, or along the flow.
    pub dip: DVec3,
    /// Along strike, or across the flow.
    pub strike: DVec3,
    /// The normal of the layers, upwards.
    pub normal: DVec3,
}

impl Fabric {
    /// Of level layers without a direction: dip to the north, strike to the east.
    pub const LEVEL: Self = Self {
        dip: DVec3::Y,
        strike: DVec3::X,
        normal: DVec3::Z,
    };

    /// Level, along a direction in plan.
    pub fn along(direction: DVec2) -> Self {
        let dip = direction.normalize_or(DVec2::Y).extend(0.0);
        Self::of(dip, DVec3::Z)
    }

    /// Of a plane with this normal, however long; of level planes, along a direction in plan.
    pub fn of_plane(normal: DVec3, level: DVec2) -> Self {
        let up = if normal.z < 0.0 { -normal } else { normal }.normalize_or(DVec3::Z);
        // The steepest way down: what is left of −z within the plane.
        let down = up.z * up - DVec3::Z;
        if down.length() < LEVEL {
            return Self::along(level);
        }
        Self::of(down.normalize(), up)
    }

    /// Of an ellipsoid: along its first axis and at right angles to its third.
    pub fn of_ellipsoid(ellipsoid: &Ellipsoid) -> Self {
        let [dip, _, normal] = ellipsoid.axes().map(DVec3::normalize);
        Self::of(dip, if normal.z < 0.0 { -normal } else { normal })
    }

    /// The same of layers that were sheared upright by a slope (rise along x and y), as bodies are that conform to a surface.
    #[must_use]
    pub fn sheared(&self, slope: DVec2) -> Self {
        let moved = |direction: DVec3| direction + slope.dot(direction.xy()) * DVec3::Z;
        let dip = moved(self.dip);
        let normal = moved(self.strike).cross(dip);
        Self::of(dip.normalize(), normal.normalize())
    }

    /// Of what lies on sheets that hang in a unit of the extent, or of what lies above a horizon; nothing of other bodies.
    pub fn of_body(body: &Body, unit: [Option<&Horizon>; 2], extent: &Extent) -> Option<Self> {
        match body {
            Body::Ellipsoid(ellipsoid) => Some(Self::of_ellipsoid(ellipsoid)),
            Body::Side(side) => Self::of_side(side, unit, extent),
            Body::Trough(_) | Body::Shell(_) | Body::Imported(_) => None,
        }
    }

    /// Of a horizon, over the plan of an extent.
    pub fn of_horizon(horizon: &Horizon, extent: &Extent) -> Self {
        let plan = [extent.low().xy(), extent.high().xy()];
        let slope = mean_slope(&|at| horizon.height(at.x, at.y), plan);
        Self::of_plane((-slope).extend(1.0), DVec2::Y)
    }

    fn of_side(side: &Side, unit: [Option<&Horizon>; 2], extent: &Extent) -> Option<Self> {
        let inside = |point: DVec3| {
            let [base, top] = unit.map(|one| one.map(|one| one.height(point.x, point.y)));
            let is_between =
                base.is_none_or(|base| point.z >= base) && top.is_none_or(|top| point.z <= top);
            is_between && extent.holds(point)
        };
        let normal = || -> DVec3 {
            let sheets = side.sheets().iter();
            sheets.map(|sheet| vector_area(sheet, &inside)).sum()
        };
        match side.ends() {
            Ends::Hanging {
                frame,
                borders: Borders::Unit { .. },
            } => Some(Self::of_plane(normal(), frame.dip())),
            // Of no area where it is nowhere in its unit.
            Ends::Closed(_) => Some(normal())
                .filter(|normal| *normal != DVec3::ZERO)
                .map(|normal| Self::of_plane(normal, DVec2::Y)),
            Ends::Plan(_) | Ends::NoSheet | Ends::Hanging { .. } => None,
        }
    }

    fn of(dip: DVec3, normal: DVec3) -> Self {
        Self {
            dip,
            strike: dip.cross(normal),
            normal,
        }
    }

    /// K = Σ kᵢ eᵢ eᵢᵀ of values along dip, strike and normal, by rows; symmetric to the last digit, and without what is rounding.
    pub fn tensor(&self, along: [f64; 3]) -> [[f64; 3]; 3] {
        let axes = [self.dip, self.strike, self.normal].map(|axis| axis.to_array());
        let largest = along.iter().fold(0.0_f64, |most, k| most.max(k.abs()));
        let entry = |row: usize, column: usize| {
            let parts = axes.iter().zip(along);
            let sum: f64 = parts.map(|(e, k)| k * e[row] * e[column]).sum();
            if sum.abs() < ROUNDING * largest {
                0.0
            } else {
                sum
            }
        };
        let [xy, xz, yz] = [entry(0, 1), entry(0, 2), entry(1, 2)];
        [
            [entry(0, 0), xy, xz],
            [xy, entry(1, 1), yz],
            [xz, yz, entry(2, 2)],
        ]
    }
}

/// The mean slope of heights over a rectangle of the plan: how far they rise along x and along y (m/m).
pub fn mean_slope(height: &dyn Fn(DVec2) -> f64, [low, high]: [DVec2; 2]) -> DVec2 {
    let size = high - low;
    let mean = |at: &dyn Fn(f64) -> f64| {
        let middles = (0..ACROSS).map(|i| (i as f64 + 0.5) / ACROSS as f64);
        middles.map(at).sum::<f64>() / ACROSS as f64
    };
    // The mean of a slope over a rectangle is the rise from one side to the other.
    let rise_x = mean(&|part| {
        let y = low.y + part * size.y;
        height(DVec2::new(high.x, y)) - height(DVec2::new(low.x, y))
    });
    let rise_y = mean(&|part| {
        let x = low.x + part * size.x;
        height(DVec2::new(x, high.y)) - height(DVec2::new(x, low.y))
    });
    DVec2::new(rise_x, rise_y) / size
}

/// The integral of the unit normal over what of a sheet lies inside: the normal of its mean plane, as long as that has area. It is
/// taken at the middles of cells.
fn vector_area(sheet: &Surface, inside: &dyn Fn(DVec3) -> bool) -> DVec3 {
    let ((u0, u1), (v0, v1)) = (sheet.knots_u().domain(), sheet.knots_v().domain());
    let at = |i: usize| (i as f64 + 0.5) / ACROSS as f64;
    let cells = (0..ACROSS * ACROSS).map(|cell| {
        let u = u0 + (u1 - u0) * at(cell % ACROSS);
        let v = v0 + (v1 - v0) * at(cell / ACROSS);
        let derivatives = sheet.derivatives(u, v, 1);
        if inside(derivatives[0][0]) {
            derivatives[1][0].cross(derivatives[0][1])
        } else {
            DVec3::ZERO
        }
    });
    cells.sum()
}

impl Trajectory {
    /// The mean of its direction over its length, as far as it lies in a rectangle of the plan, or all of it if it misses that;
    /// nothing if it leads back to where it began.
    pub fn mean_direction(&self, low: DVec2, high: DVec2) -> Option<DVec2> {
        let mut within = (DVec2::ZERO, 0.0);
        let mut whole = (DVec2::ZERO, 0.0);
        for pair in self.places().windows(2) {
            let (from, to) = (pair[0].point, pair[1].point);
            let share = share_within(from, to, low, high);
            for (sum, share) in [(&mut within, share), (&mut whole, 1.0)] {
                sum.0 += share * (to - from);
                sum.1 += share * (pair[1].s - pair[0].s);
            }
        }
        let (sum, length) = if within.1 > 0.0 { within } else { whole };
        (sum.length() > NOWHERE * length).then(|| sum.normalize())
    }
}

/// What share of a straight piece lies in a rectangle.
fn share_within(from: DVec2, to: DVec2, low: DVec2, high: DVec2) -> f64 {
    let along = to - from;
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        if along[axis] == 0.0 {
            if from[axis] < low[axis] || from[axis] > high[axis] {
                return 0.0;
            }
            continue;
        }
        let one = (low[axis] - from[axis]) / along[axis];
        let other = (high[axis] - from[axis]) / along[axis];
        enters = enters.max(one.min(other));
        leaves = leaves.min(one.max(other));
    }
    (leaves - enters).max(0.0)
}

#[cfg(test)]
#[path = "fabric_tests.rs"]
mod tests;

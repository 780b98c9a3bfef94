//! Edges: known curves along which sheets meet, because their sides are the same or because one lands on the other.

use glam::{DVec2, DVec3};

use super::bounds::Bounds;
use super::pierce::Segment;
use super::sheet::{Border, Sheet};
use crate::nurbs::{Curve, Surface};

/// Where sheets of a region join, along a whole side of each; or where a side lands on a level sheet of another.
#[derive(Clone, Debug)]
pub(super) struct Edge {
    /// The curve, with the parameter of its first sheet's side.
    pub(super) curve: Curve,
    pub(super) segments: Vec<Segment>,
    pub(super) sides: [Side; 2],
    /// The sheet that the first side's sheet lands on; there is no second side then.
    pub(super) landing: Option<Landing>,
    pub(super) region: usize,
    pub(super) bounds: Bounds,
}

/// A level sheet under an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Landing {
    pub(super) sheet: usize,
    chart: Chart,
}

impl Landing {
    /// On a sheet whose surface is a parallelogram.
    pub(super) fn on(sheet: usize, surface: &Surface) -> Option<Self> {
        Chart::of(surface).map(|chart| Self { sheet, chart })
    }
}

impl Edge {
    /// The sheets that meet along it.
    pub(super) fn sheets(&self) -> [usize; 2] {
        let second = self.landing.map_or(self.sides[1].sheet, |on| on.sheet);
        [self.sides[0].sheet, second]
    }

    /// The sides of sheets along it.
    pub(super) fn borders(&self) -> &[Side] {
        &self.sides[..if self.landing.is_some() { 1 } else { 2 }]
    }

    /// Its Bézier piece at t.
    pub(super) fn segment(&self, t: f64) -> &Segment {
        let inner = &self.segments[..self.segments.len() - 1];
        &self.segments[inner.partition_point(|segment| segment.t[1] <= t)]
    }

    /// Parameters on one of its sheets, and their derivative, at t.
    pub(super) fn on_sheet(&self, side: usize, sheets: &[Sheet], t: f64) -> (DVec2, DVec2) {
        match self.landing {
            Some(on) if side == 1 => {
                let (point, tangent) = self.segment(t).evaluate(t);
                (on.chart.at(point), on.chart.along(tangent))
            }
            _ => self.sides[side].at(sheets, t),
        }
    }
}

/// An edge as the side of a sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Side {
    pub(super) sheet: usize,
    pub(super) border: Border,
    /// The side's running parameter is `shift + scale t`.
    pub(super) shift: f64,
    pub(super) scale: f64,
}

impl Side {
    /// Parameters on the sheet, and their derivative, at t.
    pub(super) fn at(&self, sheets: &[Sheet], t: f64) -> (DVec2, DVec2) {
        let fixed = sheets[self.sheet].at_border(self.border);
        let running = self.shift + self.scale * t;
        if self.border.axis() == 0 {
            (DVec2::new(fixed, running), DVec2::new(0.0, self.scale))
        } else {
            (DVec2::new(running, fixed), DVec2::new(self.scale, 0.0))
        }
    }

    /// Whether the sheet lies to the left in the direction of growing t.
    pub(super) fn sheet_is_left(&self) -> bool {
        self.border.sheet_is_left() == (self.scale > 0.0)
    }
}

/// The parameters of a parallelogram, from places in space.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Chart {
    origin: DVec3,
    /// Parameters at the origin.
    first: DVec2,
    /// What grows by 1 with u, and with v.
    rows: [DVec3; 2],
}

impl Chart {
    /// The chart of a surface with four control points that are a parallelogram's corners.
    fn of(surface: &Surface) -> Option<Self> {
        let [a, b, c, d] = surface.net() else {
            return None;
        };
        let closes = ((*b - *a) - (*d - *c)).length() <= 1e-12 * b.distance(*c);
        if !closes || surface.is_rational() {
            return None;
        }
        let ((u0, u1), (v0, v1)) = (surface.knots_u().domain(), surface.knots_v().domain());
        let (su, sv) = ((*c - *a) / (u1 - u0), (*b - *a) / (v1 - v0));
        let normal = su.cross(sv);
        let size = normal.length_squared();
        Some(Self {
            origin: *a,
            first: DVec2::new(u0, v0),
            rows: [sv.cross(normal) / size, normal.cross(su) / size],
        })
    }

    fn at(&self, point: DVec3) -> DVec2 {
        self.first + self.along(point - self.origin)
    }

    fn along(&self, vector: DVec3) -> DVec2 {
        DVec2::new(self.rows[0].dot(vector), self.rows[1].dot(vector))
    }
}

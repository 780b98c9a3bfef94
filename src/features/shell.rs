//! Closed shells of any sheets: what a feature is that is neither trough nor ellipsoid.
//!
//! A feature that lies in another one is a **tube**: two sheets, one above or beside the other, each carried along the same
//! trajectory, ruled sides between their borders and ruled ends. A part of a tube is *visible*, the surface of the rock; the
//! rest is *hidden*: it lies outside of what the feature lies in, whose own surface cuts the tube (\[J19\] §2.5.2: overshoot
//! and cut). No sheet is trimmed, and none coincides with another one. Which sheets are hidden, their roles say.

use std::sync::Arc;

use glam::{DVec3, Vec3Swizzles};

use super::body::Role;
use super::fan;
use super::nudge::Nudge;
use super::side::points_bounds;
use crate::nurbs::enclosure::{Enclosure, EnclosureError};
use crate::nurbs::{
    Curve, ElevateError, ExtendError, KnotError, KnotVector, RefineError, Surface, SurfaceError,
};

/// Why sheets make no closed shell.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ShellError {
    /// A sheet is no surface.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// A sheet has no knots.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// A knot cannot be inserted.
    #[error(transparent)]
    Refine(#[from] RefineError),
    /// A degree cannot be elevated.
    #[error(transparent)]
    Elevate(#[from] ElevateError),
    /// A sheet cannot go on.
    #[error(transparent)]
    Extend(#[from] ExtendError),
    /// The sheets leave gaps.
    #[error("its sheets do not join: {0}")]
    Open(#[from] EnclosureError),
}

/// A closed shell: sheets with roles, of which every side is the side of another one, of itself, or a point.
#[derive(Clone, Debug)]
pub struct Shell {
    sheets: Vec<(Role, Surface)>,
    inside: Arc<Enclosure>,
}

impl PartialEq for Shell {
    fn eq(&self, other: &Self) -> bool {
        self.sheets == other.sheets
    }
}

impl Shell {
    /// The shell of sheets that join.
    pub fn new(sheets: Vec<(Role, Surface)>) -> Result<Self, ShellError> {
        let surfaces = sheets.iter().map(|sheet| sheet.1.clone()).collect();
        let inside = Arc::new(Enclosure::new(surfaces)?);
        Ok(Self { sheets, inside })
    }

    /// Its sheets with their roles.
    pub fn sheets(&self) -> &[(Role, Surface)] {
        &self.sheets
    }

    /// The first sheet of a role.
    pub fn sheet(&self, role: Role) -> Option<&Surface> {
        let found = self.sheets.iter().find(|sheet| sheet.0 == role);
        found.map(|sheet| &sheet.1)
    }

    /// Tells whether it holds a point.
    pub fn inside(&self) -> &Arc<Enclosure> {
        &self.inside
    }

    /// Whether it holds a point; what is on it counts as held.
    pub fn contains(&self, point: DVec3) -> bool {
        self.inside.contains(point)
    }

    /// See [`super::body::Body::nudged`]: stretched about its own box, and moved. One affine map for all of it, so that sheets still
    /// join, whatever their degrees and weights.
    pub(super) fn nudged(&self, nudge: &Nudge) -> Result<Self, ShellError> {
        let (low, high) = self.bounds();
        let (middle, size) = (0.5 * (low + high).xy(), high - low);
        let longer = 2.0 * nudge.reach / size.xy().max_element();
        let flatter = nudge.rise / size.z;
        let moved = |p: &DVec3| {
            let at = p.xy() + longer * (p.xy() - middle);
            at.extend(p.z + flatter * (high.z - p.z)) + nudge.shift
        };
        let sheets = self
            .sheets
            .iter()
            .map(|(role, sheet)| Ok((*role, sheet.mapped(moved)?)));
        Self::new(sheets.collect::<Result<_, SurfaceError>>()?)
    }

    /// The corners of the box of its control points.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        points_bounds(self.sheets.iter().flat_map(|sheet| sheet.1.net()))
    }
}

/// Two sheets over the same v, with u across, between which a tube is.
#[derive(Clone, Debug, PartialEq)]
pub struct Tube {
    /// The sheets.
    pub sheets: [Surface; 2],
    /// Their roles.
    pub roles: [Role; 2],
    /// The roles of what is ruled between their borders at the first and at the last u.
    pub sides: [Role; 2],
}

impl Tube {
    /// The tube closed by ruled sides and ends. Edges are the sheets' own control points (of degrees that differ across, the
    /// ends have degree-elevated copies, \[J19\] §2.5.1).
    pub fn close(&self) -> Result<Shell, ShellError> {
        let sides = self.sides()?;
        self.closed(&sides)
    }

    /// The ruled sheets between the borders at the first and at the last u.
    fn sides(&self) -> Result<[Surface; 2], SurfaceError> {
        let [one, other] = &self.sheets;
        let ends = |knots: &KnotVector| {
            let (first, last) = knots.domain();
            [first, last]
        };
        let [from, to] = ends(one.knots_u());
        let [other_from, other_to] = ends(other.knots_u());
        let side = |u: f64, v: f64| Surface::ruled(&one.isocurve_u(u), &other.isocurve_u(v));
        Ok([side(from, other_from)?, side(to, other_to)?])
    }

    /// The same of two sheets that share their borders at the first and the last u already: without sides.
    pub fn close_at_rims(&self) -> Result<Shell, ShellError> {
        self.closed(&[])
    }

    /// The shell with these sides. Sheets with creases are as many sheets, and the ends fans of them.
    fn closed(&self, sides: &[Surface]) -> Result<Shell, ShellError> {
        let [one, other] = [0, 1].map(|at| self.sheets[at].smooth_parts_u());
        let has_creases = one.len() + other.len() > 2;
        let ends = if has_creases {
            let (first, last) = self.sheets[0].knots_v().domain();
            let mut around: Vec<&Surface> = one.iter().collect();
            around.extend(sides.get(1));
            around.extend(other.iter().rev());
            around.extend(sides.first());
            let mut ends = Vec::new();
            for (role, v) in [(Role::Start, first), (Role::End, last)] {
                let end: Vec<Curve> = around.iter().map(|sheet| sheet.isocurve_v(v)).collect();
                let face = fan::face(&end).transpose()?.unwrap_or_default();
                ends.extend(face.into_iter().map(|sheet| (role, sheet)));
            }
            ends
        } else {
            self.ends()?.to_vec()
        };
        let mut sheets = Vec::new();
        for (role, parts) in self.roles.into_iter().zip([one, other]) {
            sheets.extend(parts.into_iter().map(|part| (role, part)));
        }
        sheets.extend(self.sides.into_iter().zip(sides.iter().cloned()));
        Shell::new(sheets.into_iter().chain(ends).collect())
    }

    /// The ruled sheets at the first and the last v.
    fn ends(&self) -> Result<[(Role, Surface); 2], SurfaceError> {
        let [one, other] = &self.sheets;
        let (start, end) = one.knots_v().domain();
        let across = |v: f64| Surface::ruled(&one.isocurve_v(v), &other.isocurve_v(v));
        Ok([(Role::Start, across(start)?), (Role::End, across(end)?)])
    }

    /// The tube continued beyond its ends along the ends' own tangents, by lengths of v.
    pub fn continued(&self, [before, after]: [f64; 2]) -> Result<Self, ShellError> {
        let [one, other] = &self.sheets;
        Ok(Self {
            sheets: [
                one.extended_v([before, after])?,
                other.extended_v([before, after])?,
            ],
            ..self.clone()
        })
    }
}

#[cfg(test)]
#[path = "shell_tests.rs"]
mod tests;

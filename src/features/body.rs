//! Bodies: what holds places, inside a closed shell or on one side of open sheets, made of named sheets.

use std::sync::Arc;

use glam::{DVec3, Vec3Swizzles};

use super::ellipsoid::Ellipsoid;
use super::fan;
use super::imported::Imported;
pub use super::nudge::Nudge;
use super::shell::{Shell, ShellError};
use super::side::{Side, points_bounds};
use crate::nurbs::{Curve, KnotError, KnotVector, RefineError, Surface, SurfaceError};

/// What a sheet of a body is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Role {
    /// The erosive base.
    Base,
    /// The top, between the rims.
    Top,
    /// The vertical end at the trajectory's start.
    Start,
    /// The vertical end at the trajectory's end.
    End,
    /// The whole surface of a body without edges.
    Skin,
    /// An open sheet, which divides; by its name.
    Open(&'static str),
    /// Where the inner bank of a river once was.
    Accretion,
    /// Closes a shell outside of what the body lies in.
    Hidden,
}

impl Role {
    /// Whether the sheet is a surface of the rock, not only the end of a shell.
    pub fn is_geological(self) -> bool {
        !matches!(self, Self::Start | Self::End | Self::Hidden)
    }

    /// The role's name in files and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Base => "base",
            Self::Top => "top",
            Self::Start => "start",
            Self::End => "end",
            Self::Skin => "skin",
            Self::Open(name) => name,
            Self::Accretion => "accretion-surface",
            Self::Hidden => "hidden",
        }
    }
}

/// What an instance holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Body {
    /// Two sheets that share their rims, between flat ends.
    Trough(Trough),
    /// An ellipsoid.
    Ellipsoid(Ellipsoid),
    /// Any sheets that close.
    Shell(Shell),
    /// What lies on the younger side of open sheets.
    Side(Arc<Side>),
    /// A solid of another program.
    Imported(Arc<Imported>),
}

impl Body {
    /// All sheets of the closed shell, or of the side; those of a solid of another program reach beyond its faces.
    pub fn sheets(&self) -> Result<Vec<(Role, Surface)>, SurfaceError> {
        match self {
            Self::Trough(trough) => trough.sheets(),
            Self::Ellipsoid(ellipsoid) => Ok(vec![(Role::Skin, ellipsoid.skin().clone())]),
            Self::Shell(shell) => Ok(shell.sheets().to_vec()),
            Self::Side(side) => {
                let role = side.role();
                Ok(side.sheets().iter().map(|s| (role, s.clone())).collect())
            }
            Self::Imported(imported) => {
                let surfaces = imported.surfaces().iter();
                Ok(surfaces
                    .map(|surface| (Role::Skin, surface.clone()))
                    .collect())
            }
        }
    }

    /// The corners of a box that holds the body: that of a trough's or a shell's control net, and for an ellipsoid
    /// the smallest one. A side reaches to infinity.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        match self {
            Self::Trough(trough) => points_bounds(trough.base.net()),
            Self::Ellipsoid(ellipsoid) => ellipsoid.bounds(),
            Self::Shell(shell) => shell.bounds(),
            Self::Side(side) => {
                let least = side
                    .heights()
                    .map_or(f64::NEG_INFINITY, |heights| heights[0]);
                let low = DVec3::NEG_INFINITY.with_z(least);
                (low, DVec3::INFINITY)
            }
            Self::Imported(imported) => imported.bounds(),
        }
    }

    /// Its bounds bit by bit: bodies that are the same have the same.
    pub fn bounds_bits(&self) -> [u64; 6] {
        let (low, high) = self.bounds();
        let [a, b] = [low, high].map(|corner| corner.to_array().map(f64::to_bits));
        [a[0], a[1], a[2], b[0], b[1], b[2]]
    }

    /// The elevation of its top, if it has one that is level to within a tolerance (m).
    pub fn level_top(&self, tolerance: f64) -> Option<f64> {
        match self {
            Self::Trough(trough) => trough.level_top(tolerance),
            Self::Ellipsoid(_) | Self::Shell(_) | Self::Side(_) | Self::Imported(_) => None,
        }
    }
}

impl Body {
    /// The body a little shallower, longer and elsewhere; sides and solids of other programs stay as they are.
    pub fn nudged(&self, nudge: &Nudge) -> Result<Self, ShellError> {
        Ok(match self {
            Self::Trough(trough) => Self::Trough(trough.nudged(nudge)?),
            Self::Ellipsoid(ellipsoid) => Self::Ellipsoid(ellipsoid.nudged(nudge)?),
            Self::Shell(shell) => Self::Shell(shell.nudged(nudge)?),
            Self::Side(side) => Self::Side(Arc::clone(side)),
            Self::Imported(imported) => Self::Imported(Arc::clone(imported)),
        })
    }
}

/// A trough: a base with u across and v along, closed by a ruled top between its two rims.
///
/// The rims (u = first and last) are the *same* control points in both sheets, so that base and top
/// share their edges exactly (\[J19\] Fig. 4: CP2 of the top is CP7 of the base). The two ends are
/// vertical and flat: sections are.
#[derive(Clone, Debug, PartialEq)]
pub struct Trough {
    base: Surface,
    top: Surface,
    sections: Vec<f64>,
}

/// Why a base cannot be closed, raised or cut.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TroughError {
    /// A sheet is no surface.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// The raised base has no knot vector.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// A part's end is no place between its ends.
    #[error(transparent)]
    Part(#[from] RefineError),
}

/// Of a raised bank: its height, in steps from the rim's neighbour to the rim.
const RISE: f64 = 0.5;
/// Of a raised bank: the farthest it may lean in, as a fraction of the distance between the rims.
const LEAN: f64 = 0.2;

impl Trough {
    /// Closes a base by the ruled top between its rims (degree 1 across). `sections` are the v at
    /// which the base is flat and upright, its two ends included.
    pub fn new(base: Surface, sections: Vec<f64>) -> Result<Self, SurfaceError> {
        let (first, last) = base.knots_u().domain();
        let top = Surface::ruled(&base.isocurve_u(first), &base.isocurve_u(last))?;
        Ok(Self {
            base,
            top,
            sections,
        })
    }

    /// The base: u across from the left rim to the right one, v along.
    pub fn base(&self) -> &Surface {
        &self.base
    }

    /// The top: u across from the left rim to the right one, v along.
    pub fn top(&self) -> &Surface {
        &self.top
    }

    /// The v of the sections, where the base is flat and upright.
    pub fn sections(&self) -> &[f64] {
        &self.sections
    }

    /// The rims, left and right, with v as parameter.
    pub fn rims(&self) -> [Curve; 2] {
        let (first, last) = self.base.knots_u().domain();
        [self.base.isocurve_u(first), self.base.isocurve_u(last)]
    }

    /// The elevation of the top, if it is level to within a tolerance (m).
    pub fn level_top(&self, tolerance: f64) -> Option<f64> {
        let net = self.top.net();
        let (low, high) = net
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| {
                (low.min(p.z), high.max(p.z))
            });
        (high - low <= tolerance).then(|| f64::midpoint(low, high))
    }

    /// Whether its base has creases along it, where its section has corners.
    pub fn has_creases(&self) -> bool {
        self.base.smooth_parts_u().len() > 1
    }

    /// All sheets of the closed shell.
    ///
    /// A base with creases is as many sheets, and each end a fan of them: sheets are smooth.
    pub fn sheets(&self) -> Result<Vec<(Role, Surface)>, SurfaceError> {
        let (first, last) = self.base.knots_v().domain();
        let parts = self.base.smooth_parts_u();
        if parts.len() > 1 {
            let mut sheets = Vec::new();
            for (role, v) in [(Role::Start, first), (Role::End, last)] {
                let sides = parts.iter().chain([&self.top]).map(|one| one.isocurve_v(v));
                let sides: Vec<Curve> = sides.collect();
                let face = fan::face(&sides).transpose()?.unwrap_or_default();
                sheets.extend(face.into_iter().map(|sheet| (role, sheet)));
            }
            let parts = parts.into_iter().map(|part| (Role::Base, part));
            sheets.extend(parts.chain([(Role::Top, self.top.clone())]));
            return Ok(sheets);
        }
        let end = |v: f64| Surface::ruled(&self.base.isocurve_v(v), &self.top.isocurve_v(v));
        Ok(vec![
            (Role::Base, self.base.clone()),
            (Role::Top, self.top.clone()),
            (Role::Start, end(first)?),
            (Role::End, end(last)?),
        ])
    }

    /// The same trough elsewhere.
    #[must_use]
    pub fn moved(&self, by: DVec3) -> Self {
        Self {
            base: self.base.moved(by),
            top: self.top.moved(by),
            sections: self.sections.clone(),
        }
    }

    /// See [`Body::nudged`]. Sections stay flat and upright, and a level top level.
    fn nudged(&self, nudge: &Nudge) -> Result<Self, SurfaceError> {
        let net = self.base.net();
        let (low, high) = points_bounds(net);
        let (middle, size) = (0.5 * (low + high).xy(), high - low);
        let (longer, flatter) = (
            2.0 * nudge.reach / size.xy().max_element(),
            nudge.rise / size.z,
        );
        let (rows, columns) = (self.base.knots_u().count(), self.base.knots_v().count());
        let moved = |(k, p): (usize, &DVec3)| {
            let rims = [k % columns, (rows - 1) * columns + k % columns].map(|at| net[at].xy());
            let (centre, width) = (0.5 * (rims[0] + rims[1]), rims[0].distance(rims[1]));
            let narrower = 2.0 * nudge.rise / width;
            let at = p.xy() - narrower * (p.xy() - centre) + longer * (p.xy() - middle);
            at.extend(p.z + flatter * (high.z - p.z)) + nudge.shift
        };
        let sheet = |sheet: &Surface| {
            let (u, v) = (sheet.knots_u().clone(), sheet.knots_v().clone());
            let net = sheet.net().iter().enumerate().map(moved).collect();
            if sheet.is_rational() {
                Surface::rational(u, v, net, sheet.weights().to_vec())
            } else {
                Surface::new(u, v, net)
            }
        };
        Ok(Self {
            base: sheet(&self.base)?,
            top: sheet(&self.top)?,
            sections: self.sections.clone(),
        })
    }

    /// The part between two sections, with their v.
    pub fn between(&self, from: f64, to: f64) -> Result<Self, TroughError> {
        let (first, last) = self.base.knots_v().domain();
        let part = |sheet: &Surface| {
            let mut part = sheet.clone();
            if from > first {
                part = part.split_v(from)?.1;
            }
            if to < last {
                part = part.split_v(to)?.0;
            }
            Ok::<_, RefineError>(part)
        };
        let within = |v: &f64| (from..=to).contains(v);
        Ok(Self {
            base: part(&self.base)?,
            top: part(&self.top)?,
            sections: self.sections.iter().copied().filter(within).collect(),
        })
    }

    /// The same trough with its banks continued upwards in their own direction, above the old rims.
    ///
    /// Below the old top nothing changes: the old base is a part of the new one (knots of multiplicity
    /// p at the old rims). Whatever stops the trough at its old top then meets the banks at an angle,
    /// instead of touching them along the rims, which no kernel does reliably.
    pub fn raised(&self) -> Result<Self, TroughError> {
        let p = self.base.knots_u().degree();
        let (nu, nv) = (self.base.knots_u().count(), self.base.knots_v().count());
        let knots = self.base.knots_u().as_slice();
        let rise = self.rise();
        // C1 across the old rims: the speed of a clamped end is p/(knot span) times the first leg, and the ratio of their weights.
        let weight = |i: usize| self.base.weights()[i * nv];
        let (before, after) = (
            rise * (knots[p + 1] - knots[p]) * weight(0) / weight(1),
            rise * (knots[nu] - knots[nu - 1]) * weight(nu - 1) / weight(nu - 2),
        );
        let scale = 1.0 / p as f64;
        let mut raised = vec![knots[p] - before * scale; p + 1];
        raised.extend(std::iter::repeat_n(knots[p], p));
        raised.extend(&knots[p + 1..nu]);
        raised.extend(std::iter::repeat_n(knots[nu], p));
        raised.extend(std::iter::repeat_n(knots[nu] + after * scale, p + 1));
        let net = self.base.net();
        let row = |i: usize| &net[i * nv..(i + 1) * nv];
        let beyond = |rim: usize, neighbour: usize, step: usize| {
            let part = rise * step as f64 * scale;
            let leg = move |(rim, inner): (&DVec3, &DVec3)| *rim + (*rim - *inner) * part;
            row(rim)
                .iter()
                .zip(row(neighbour))
                .map(leg)
                .collect::<Vec<_>>()
        };
        let mut points: Vec<DVec3> = (1..=p).rev().flat_map(|step| beyond(0, 1, step)).collect();
        points.extend_from_slice(net);
        points.extend((1..=p).flat_map(|step| beyond(nu - 1, nu - 2, step)));
        let across = KnotVector::new(p, raised)?;
        let along = self.base.knots_v().clone();
        let base = if self.base.is_rational() {
            let weights = self.base.weights();
            let end = |rim: usize| weights[rim * nv..(rim + 1) * nv].repeat(p);
            let all = [end(0), weights.to_vec(), end(nu - 1)].concat();
            Surface::rational(across, along, points, all)?
        } else {
            Surface::new(across, along, points)?
        };
        Ok(Self::new(base, self.sections.clone())?)
    }

    /// How far banks are raised: less where they lean in.
    fn rise(&self) -> f64 {
        let (nu, nv) = (self.base.knots_u().count(), self.base.knots_v().count());
        let at = |i: usize, j: usize| self.base.net()[i * nv + j];
        (0..nv).fold(RISE, |rise, j| {
            let across = at(nu - 1, j) - at(0, j);
            let width = across.length();
            let lean = |rim: usize, inner: usize, inward: f64| {
                (at(rim, j) - at(inner, j)).dot(across) / width * inward
            };
            let most = lean(0, 1, 1.0).max(lean(nu - 1, nu - 2, -1.0));
            if most > 0.0 {
                rise.min(LEAN * width / most)
            } else {
                rise
            }
        })
    }
}

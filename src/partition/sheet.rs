//! Sheets: surfaces as grids of Bézier patches with a box tree.

use std::borrow::Cow;

use glam::{DVec2, DVec3};

use super::bounds::Bounds;
use super::facet::Facet;
use super::heights::Plan;
use super::patch::{Jet, ORDER, Patch};
use super::patches::Patches;
use crate::nurbs::Surface;

/// A surface that bounds a region.
#[derive(Clone, Debug)]
pub(super) struct Sheet {
    pub(super) surface: Surface,
    /// The region that it bounds.
    pub(super) region: usize,
    /// 1 if `S_u × S_v` points out of the region, −1 if it points in.
    pub(super) outward: f64,
    /// A point, the unit normal `S_u × S_v` and the direction of u, if it is flat.
    pub(super) plane: Option<[DVec3; 3]>,
    /// Where its parameters are in plan, if it is a height over it.
    pub(super) plan: Option<Plan>,
    /// Borders that join no other sheet: where curves end there, nobody asks.
    pub(super) open: Vec<Border>,
    /// Level sheets of other regions that it ends on.
    pub(super) lands_on: Vec<usize>,
    /// Distinct knots.
    pub(super) knots: [Vec<f64>; 2],
    patches: Patches,
    tree: Vec<Node>,
}

/// Surfaces flatter than this fraction of their size are planes.
const FLAT: f64 = 1e-10;

/// A node of a box tree: two children, or a patch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) bounds: Bounds,
    pub(super) kind: NodeKind,
}

#[derive(Clone, Copy, Debug)]
pub(super) enum NodeKind {
    Leaf(usize),
    Pair(usize, usize),
}

/// One of the four borders of a sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Border {
    ULow,
    UHigh,
    VLow,
    VHigh,
}

pub(super) const BORDERS: [Border; 4] = [Border::ULow, Border::UHigh, Border::VLow, Border::VHigh];

impl Border {
    /// 0 if u is constant along it, 1 if v is.
    pub(super) fn axis(self) -> usize {
        match self {
            Self::ULow | Self::UHigh => 0,
            Self::VLow | Self::VHigh => 1,
        }
    }

    pub(super) fn is_high(self) -> bool {
        matches!(self, Self::UHigh | Self::VHigh)
    }

    pub(super) fn of(axis: usize, high: bool) -> Self {
        BORDERS[2 * axis + usize::from(high)]
    }

    /// Whether the sheet lies to the left of the border in the direction of the growing parameter.
    pub(super) fn sheet_is_left(self) -> bool {
        matches!(self, Self::UHigh | Self::VLow)
    }
}

impl Sheet {
    /// A sheet of a surface; `None` if its degree is too high for this kernel.
    pub(super) fn new(surface: Surface, region: usize) -> Option<Self> {
        let order = |knots: &crate::nurbs::KnotVector| knots.degree() + 1;
        if order(surface.knots_u()) > ORDER || order(surface.knots_v()) > ORDER {
            return None;
        }
        let distinct = |knots: &crate::nurbs::KnotVector| -> Vec<f64> {
            knots.distinct().iter().map(|k| k.0).collect()
        };
        let knots = [distinct(surface.knots_u()), distinct(surface.knots_v())];
        let plan = Plan::of(&surface);
        let mut sheet = Self {
            region,
            outward: 1.0,
            open: Vec::new(),
            lands_on: Vec::new(),
            plane: None,
            plan,
            patches: Patches::of(&surface, &knots, plan.is_some()),
            surface,
            knots,
            tree: Vec::new(),
        };
        let spans = [sheet.knots[0].len() - 1, sheet.knots[1].len() - 1];
        sheet.branch([0, spans[0]], [0, spans[1]]);
        sheet.plane = sheet.flat();
        Some(sheet)
    }

    /// A point of the plane, its normal and the direction of u, if all control points lie on one.
    fn flat(&self) -> Option<[DVec3; 3]> {
        let middle = |axis: usize| self.low(axis) + 0.5 * self.length(axis);
        let (point, u, v) = self.first_jet(middle(0), middle(1));
        let normal = u.cross(v).try_normalize()?;
        let reach = FLAT * self.bounds().diagonal();
        let is_near = |p: &DVec3| (*p - point).dot(normal).abs() <= reach;
        let flat = self.surface.net().iter().all(is_near);
        flat.then(|| [point, normal, u.normalize()])
    }

    fn branch(&mut self, u: [usize; 2], v: [usize; 2]) -> usize {
        let (long_u, long_v) = (u[1] - u[0], v[1] - v[0]);
        if long_u == 1 && long_v == 1 {
            let patch = u[0] * (self.knots[1].len() - 1) + v[0];
            self.tree.push(Node {
                bounds: self.patches.bounds(patch),
                kind: NodeKind::Leaf(patch),
            });
            return self.tree.len() - 1;
        }
        let (first, second) = if long_u >= long_v {
            let middle = u[0].midpoint(u[1]);
            (
                self.branch([u[0], middle], v),
                self.branch([middle, u[1]], v),
            )
        } else {
            let middle = v[0].midpoint(v[1]);
            (
                self.branch(u, [v[0], middle]),
                self.branch(u, [middle, v[1]]),
            )
        };
        self.tree.push(Node {
            bounds: self.tree[first].bounds.and(self.tree[second].bounds),
            kind: NodeKind::Pair(first, second),
        });
        self.tree.len() - 1
    }

    pub(super) fn root(&self) -> usize {
        self.tree.len() - 1
    }

    pub(super) fn node(&self, at: usize) -> &Node {
        &self.tree[at]
    }

    pub(super) fn patch(&self, at: usize) -> Cow<'_, Patch> {
        self.patches.get(at)
    }

    /// The parameters that a patch covers, from and to.
    pub(super) fn range_of(&self, at: usize) -> [DVec2; 2] {
        let columns = self.knots[1].len() - 1;
        let (i, j) = (at / columns, at % columns);
        [0, 1].map(|end| DVec2::new(self.knots[0][i + end], self.knots[1][j + end]))
    }

    /// A patch with its tangents and normals.
    pub(super) fn facet(&self, at: usize) -> Cow<'_, Facet> {
        self.patches.facet(at)
    }

    /// All patches, u-major.
    pub(super) fn patches(&self) -> impl Iterator<Item = Cow<'_, Patch>> {
        let count = (self.knots[0].len() - 1) * (self.knots[1].len() - 1);
        (0..count).map(|at| self.patch(at))
    }

    pub(super) fn bounds(&self) -> &Bounds {
        &self.tree[self.root()].bounds
    }

    pub(super) fn low(&self, axis: usize) -> f64 {
        self.knots[axis][0]
    }

    pub(super) fn high(&self, axis: usize) -> f64 {
        self.knots[axis][self.knots[axis].len() - 1]
    }

    pub(super) fn length(&self, axis: usize) -> f64 {
        self.high(axis) - self.low(axis)
    }

    /// The constant parameter of a border.
    pub(super) fn at_border(&self, border: Border) -> f64 {
        if border.is_high() {
            self.high(border.axis())
        } else {
            self.low(border.axis())
        }
    }

    fn span(&self, axis: usize, value: f64) -> usize {
        let inner = &self.knots[axis][1..self.knots[axis].len() - 1];
        inner.partition_point(|knot| *knot <= value)
    }

    /// The spans of patches that meet a rectangle of parameters.
    pub(super) fn patches_between(
        &self,
        low: DVec2,
        high: DVec2,
    ) -> [std::ops::RangeInclusive<usize>; 2] {
        [0, 1].map(|axis| self.span(axis, low[axis])..=self.span(axis, high[axis]))
    }

    /// The patches of such spans.
    pub(super) fn patches_of(&self, spans: &[std::ops::RangeInclusive<usize>; 2]) -> Vec<usize> {
        let columns = self.knots[1].len() - 1;
        let row = |u: usize| spans[1].clone().map(move |v| u * columns + v);
        spans[0].clone().flat_map(row).collect()
    }

    /// The patch that holds a place, or is nearest to it; for its points and derivatives.
    pub(super) fn patch_at(&self, u: f64, v: f64) -> Cow<'_, Patch> {
        let at = self.span(0, u) * (self.knots[1].len() - 1) + self.span(1, v);
        self.patches.bare(at)
    }

    /// Point and derivatives; beyond the borders the polynomial at the border goes on.
    pub(super) fn jet(&self, u: f64, v: f64) -> Jet {
        self.patch_at(u, v).jet(u, v)
    }

    /// Point and first derivatives.
    pub(super) fn first_jet(&self, u: f64, v: f64) -> (DVec3, DVec3, DVec3) {
        self.patch_at(u, v).first_jet(u, v)
    }

    pub(super) fn point(&self, u: f64, v: f64) -> DVec3 {
        self.patch_at(u, v).point(u, v)
    }

    /// The parameters on the sheet that are nearest to some.
    pub(super) fn nearest_parameters(&self, at: DVec2) -> DVec2 {
        let [low, high] = [Self::low, Self::high].map(|end| DVec2::new(end(self, 0), end(self, 1)));
        at.clamp(low, high)
    }

    /// Whether parameters lie on the sheet.
    pub(super) fn holds(&self, u: f64, v: f64) -> bool {
        self.low(0) <= u && u <= self.high(0) && self.low(1) <= v && v <= self.high(1)
    }
}

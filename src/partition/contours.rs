//! Where two heights over one plan cross: all of the zero set of their difference, closed curves too.
//!
//! On each common cell of their patches the difference is a polynomial. Its Bernstein coefficients bound it: of one sign,
//! no curve passes. Its derivatives' coefficients bound those: if one of them has one sign, the zero set in the cell is a
//! graph, so every piece of it ends on the cell's border, where its ends are roots of polynomials of one variable. Else the
//! cell is halved. So each cell is its own certificate that no curve is missed, at any angle between the sheets.

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::bounds::Bounds;
use super::check::Doubt;
use super::heights::Heights;
use super::hermite::{Branch, Node};
use super::pair::{Closing, Pair};
use super::scalar::{Scalar, sign_changes};
use super::sheet::NodeKind;

/// Cells are halved down to this fraction of the domain's size.
const LEAST: f64 = 1e-6;
/// Most cells that are looked at for each common cell of the patches, and for all of them at least.
const MOST: [usize; 2] = [64, 20_000];
/// Differences below this many times their rounding tell nothing.
const CERTAIN: f64 = 4.0;
/// How near to a known branch a root must be to lie on it, in tolerances of curves.
const ON_IT: f64 = 50.0;

/// Looks for the curves of a pair of heights, and hands a point of each to `found`, which returns the branch through it.
pub(super) struct Contours<'a, F> {
    pair: Pair<'a>,
    heights: Heights<'a>,
    clip: Bounds,
    /// Beyond this box curves are not followed.
    far: Bounds,
    pub(super) branches: Vec<Branch>,
    found: F,
    /// Whether both regions may matter at a place; elsewhere sheets may come as near as they like.
    matters: &'a dyn Fn(DVec3) -> bool,
    noise: f64,
    /// Where the sheets are too near each other, or touch.
    pub(super) doubts: Vec<Doubt>,
    cells: usize,
    visited: usize,
}

impl<'a, F: FnMut(Node) -> Option<Branch>> Contours<'a, F> {
    /// Between two boxes: what is wanted, and what curves are followed in.
    pub(super) fn new(
        pair: Pair<'a>,
        heights: Heights<'a>,
        [clip, far]: [Bounds; 2],
        branches: Vec<Branch>,
        found: F,
        matters: &'a dyn Fn(DVec3) -> bool,
    ) -> Self {
        Self {
            pair,
            heights,
            clip,
            far,
            branches,
            found,
            matters,
            noise: CERTAIN * heights.noise(),
            doubts: Vec::new(),
            cells: 0,
            visited: 0,
        }
    }

    pub(super) fn run(&mut self) {
        let [a, b] = self.pair.sheets;
        self.nodes(a.root(), b.root());
    }

    fn nodes(&mut self, i: usize, j: usize) {
        let [a, b] = self.pair.sheets;
        let (x, y) = (a.node(i), b.node(j));
        let near = x.bounds.grown(self.noise).meets(&y.bounds);
        if !near || !self.clip.meets(&x.bounds) || !self.clip.meets(&y.bounds) {
            return;
        }
        match (x.kind, y.kind) {
            (NodeKind::Leaf(p), NodeKind::Leaf(q)) => {
                if let Some(cell) = self.heights.cell([p, q], &self.clip) {
                    self.cells += 1;
                    self.visit(&cell, [p, q]);
                }
            }
            (NodeKind::Pair(first, second), NodeKind::Leaf(_)) => {
                self.nodes(first, j);
                self.nodes(second, j);
            }
            (NodeKind::Leaf(_), NodeKind::Pair(first, second)) => {
                self.nodes(i, first);
                self.nodes(i, second);
            }
            (NodeKind::Pair(p, q), NodeKind::Pair(r, s)) => {
                if x.bounds.extent() >= y.bounds.extent() {
                    self.nodes(p, j);
                    self.nodes(q, j);
                } else {
                    self.nodes(i, r);
                    self.nodes(i, s);
                }
            }
        }
    }

    fn visit(&mut self, cell: &Scalar, patches: [usize; 2]) {
        let [low, high] = cell.values();
        if low > self.noise || high < -self.noise {
            return;
        }
        self.visited += 1;
        let is_equal = high.max(-low) <= self.noise;
        let widths = cell.range.map(|[from, to]| to - from);
        let is_small = widths[0].max(widths[1]) < LEAST * self.pair.tolerances.scale;
        if !is_equal && self.is_graph(cell) && (is_small || self.ends_are_within(cell, patches)) {
            self.follow(cell);
        } else if is_equal || is_small || self.gave_up() {
            self.doubt(cell, patches);
        } else {
            let axis = usize::from(widths[1] > widths[0]);
            for half in cell.halves(axis) {
                self.visit(&half, patches);
            }
        }
    }

    /// Whether the zero set is a graph over one of the axes.
    fn is_graph(&self, cell: &Scalar) -> bool {
        (0..2).any(|axis| {
            let [low, high] = cell.slopes(axis);
            let certain = self.noise / (cell.range[axis][1] - cell.range[axis][0]);
            low > certain || high < -certain
        })
    }

    /// Whether curves can be followed from every end on the cell's border, or none is wanted. Where sheets leave the box in
    /// which curves are followed, a curve may come into it between ends that lie beyond.
    fn ends_are_within(&self, cell: &Scalar, patches: [usize; 2]) -> bool {
        let [low, high] = self.heights.part(0, patches[0], cell.range).values();
        let within = |bounds: &Bounds| bounds.low.z <= low && high <= bounds.high.z;
        within(&self.far) || high < self.clip.low.z || low > self.clip.high.z
    }

    /// Finds the branches through the ends of all pieces of the zero set in a cell.
    fn follow(&mut self, cell: &Scalar) {
        for axis in 0..2 {
            for is_high in [false, true] {
                let [from, to] = cell.range[1 - axis];
                for root in sign_changes(&cell.side(axis, is_high)) {
                    let mut at = DVec2::ZERO;
                    at[axis] = cell.range[axis][usize::from(is_high)];
                    at[1 - axis] = from + root * (to - from);
                    self.through(at, axis);
                }
            }
        }
    }

    /// The branch through a root on a line along which one coordinate is fixed.
    fn through(&mut self, at: DVec2, fixed: usize) {
        let mut q = self.heights.parameters(at);
        // A root that polishing does not improve is good enough: its curve crosses the line at a small angle.
        let closing = Closing::Fixed(fixed, q[fixed]);
        let mut polished = q;
        let reach = LEAST * self.pair.tolerances.scale;
        if self.pair.newton(&mut polished, closing, 8)
            && self.heights.place(&polished).distance(at) < reach
        {
            q = polished;
        }
        let Some(node) = self.pair.node(q, None) else {
            self.doubt_at(at);
            return;
        };
        if !self.far.holds(node.point()) || self.is_traced(&node) {
            return;
        }
        match (self.found)(node) {
            Some(branch) => self.branches.push(branch),
            None if self.clip.holds(node.point()) => self.doubt_at(at),
            None => {}
        }
    }

    /// Whether a known branch passes through a point, as seen in plan.
    fn is_traced(&self, node: &Node) -> bool {
        let (_, slope) = self.heights.difference(node.point().xy());
        let near = ON_IT * self.pair.tolerances.curve + 2.0 * self.noise / slope.length();
        self.branches
            .iter()
            .any(|branch| branch.project(node.point()).1 < near)
    }

    fn doubt(&mut self, cell: &Scalar, patches: [usize; 2]) {
        let [x, y] = cell.range;
        let [low, high] = self.heights.part(0, patches[0], cell.range).values();
        let corner = |at: usize, z: f64| DVec3::new(x[at], y[at], z);
        let (low, high) = (corner(0, low), corner(1, high));
        let middle = 0.5 * (low + high);
        let (height, _) = self.heights.first(0, middle.xy());
        if (self.matters)(middle.xy().extend(height)) {
            let [least, most] = cell.values();
            self.add(low, high, most.max(-least));
        }
    }

    fn doubt_at(&mut self, at: DVec2) {
        let point = at.extend(self.heights.first(0, at).0);
        if (self.matters)(point) {
            self.add(point, point, self.heights.difference(at).0.abs());
        }
    }

    /// Doubts beside each other are one.
    fn add(&mut self, low: DVec3, high: DVec3, gap: f64) {
        let doubt = Doubt {
            regions: self.pair.sheets.map(|sheet| sheet.region),
            low,
            high,
            gap,
            what: "run along each other",
        };
        let reach = 1e-3 * self.pair.tolerances.scale;
        match self
            .doubts
            .iter_mut()
            .find(|known| known.is_beside(&doubt, reach))
        {
            Some(known) => known.join(&doubt),
            None => self.doubts.push(doubt),
        }
    }

    /// Whether so much has been looked at that the sheets must run along each other.
    fn gave_up(&self) -> bool {
        self.visited > MOST[0] * self.cells + MOST[1]
    }
}

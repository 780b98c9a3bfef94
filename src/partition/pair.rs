//! Two sheets: points of their intersection by Newton's method, and the curve's derivatives there.

use glam::{DVec3, Vec3Swizzles};

use super::heights::Heights;
use super::hermite::Node;
use super::patch::Jet;
use super::sheet::Sheet;
use super::solve::solve;
use super::touch::Lifted;

/// What is small, in metres: fractions of the domain's size.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tolerances {
    /// The diagonal of the domain.
    pub(super) scale: f64,
    /// How far a computed curve may be from its sheets.
    pub(super) curve: f64,
    /// Newton's method stops below this residual.
    pub(super) residual: f64,
    /// And below this step.
    pub(super) step: f64,
    /// Points nearer than this are the same.
    pub(super) same: f64,
}

impl Tolerances {
    pub(super) fn new(scale: f64, tightness: f64) -> Self {
        Self {
            scale,
            curve: 1e-11 * scale * tightness,
            residual: 1e-12 * scale,
            step: 1e-11 * scale,
            same: 1e-10 * scale,
        }
    }

    /// A curve of which rounding hides the place by more than this is none.
    pub(super) fn hidden(&self) -> f64 {
        1e-9 * self.scale
    }
}

/// How much being off a curve of heights in plan counts against being off the sheets.
const ACROSS: f64 = 0.1;

/// Sheets nearer to parallel than this have no curve that can be followed, unless they are heights over one plan.
pub(super) const PARALLEL: f64 = 1e-5;

/// What closes the system of three equations `A(u, v) = B(s, t)` in four unknowns.
#[derive(Clone, Copy, Debug)]
pub(super) enum Closing {
    /// The middle of both points lies on a plane, given by its normal and a point.
    Plane(DVec3, DVec3),
    /// One parameter has a value.
    Fixed(usize, f64),
}

/// Whether parameters lie within ranges.
pub(super) fn lies(q: &[f64; 4], ranges: &[[f64; 2]; 4]) -> bool {
    q.iter()
        .zip(ranges)
        .all(|(x, [low, high])| low < x && x < high)
}

/// A step of Newton's method.
pub(super) struct Step {
    by: [f64; 4],
    residual: f64,
    moved: f64,
}

impl Step {
    /// The step from parameters with points and first derivatives of both sheets there.
    pub(super) fn new(
        [a, b]: &[(DVec3, DVec3, DVec3); 2],
        q: &[f64; 4],
        closing: Closing,
    ) -> Option<Self> {
        let ((pa, au, av), (pb, bu, bv)) = (*a, *b);
        let gap = pa - pb;
        let mut matrix = [[0.0; 4]; 4];
        let mut right = [0.0; 4];
        for i in 0..3 {
            matrix[i] = [au[i], av[i], -bu[i], -bv[i]];
            right[i] = -gap[i];
        }
        match closing {
            Closing::Plane(normal, point) => {
                let half = 0.5 * normal;
                matrix[3] = [half.dot(au), half.dot(av), half.dot(bu), half.dot(bv)];
                right[3] = -normal.dot(0.5 * (pa + pb) - point);
            }
            Closing::Fixed(k, value) => {
                // In the units of the others, so that pivots compare.
                let unit = [au, av, bu, bv][k].length();
                matrix[3][k] = unit;
                right[3] = unit * (value - q[k]);
            }
        }
        let by = solve(matrix, right)?;
        Some(Self {
            by,
            residual: gap.abs().element_sum() + right[3].abs(),
            moved: (au * by[0] + av * by[1]).length() + (bu * by[2] + bv * by[3]).length(),
        })
    }

    pub(super) fn apply(&self, q: &mut [f64; 4]) {
        for (x, by) in q.iter_mut().zip(self.by) {
            *x += by;
        }
    }
}

/// Two sheets of different regions.
#[derive(Clone, Copy)]
pub(super) struct Pair<'a> {
    pub(super) sheets: [&'a Sheet; 2],
    pub(super) tolerances: Tolerances,
    /// Both as heights over one plan, if they are.
    pub(super) heights: Option<Heights<'a>>,
    /// Both lifted, if they touch one level and cross up to there.
    pub(super) lifted: Option<Lifted<'a>>,
}

impl<'a> Pair<'a> {
    pub(super) fn new(sheets: [&'a Sheet; 2], tolerances: Tolerances) -> Self {
        Self {
            sheets,
            tolerances,
            heights: Heights::of(sheets),
            lifted: None,
        }
    }

    /// The same, lifted.
    pub(super) fn lifted(self, lifted: Option<Lifted<'a>>) -> Self {
        Self { lifted, ..self }
    }

    /// Points and derivatives of both sheets, lifted if they are.
    fn jets(&self, q: &[f64; 4]) -> [Jet; 2] {
        match &self.lifted {
            Some(lifted) => lifted.jets(self.sheets, q),
            None => [0, 1].map(|side| self.sheets[side].jet(q[2 * side], q[2 * side + 1])),
        }
    }

    fn first_jets(&self, q: &[f64; 4]) -> [(DVec3, DVec3, DVec3); 2] {
        match &self.lifted {
            Some(_) => self.jets(q).map(|jet| (jet.p, jet.u, jet.v)),
            None => [0, 1].map(|side| self.sheets[side].first_jet(q[2 * side], q[2 * side + 1])),
        }
    }

    /// Moves parameters to a common point of both sheets. `false` if it does not converge near them.
    pub(super) fn newton(&self, q: &mut [f64; 4], closing: Closing, most: usize) -> bool {
        // A third of a sheet's parameters beyond its borders.
        let around: [[f64; 2]; 4] = std::array::from_fn(|i| {
            let (sheet, axis) = (self.sheets[i / 2], i % 2);
            let slack = 0.3 * sheet.length(axis);
            [sheet.low(axis) - slack, sheet.high(axis) + slack]
        });
        self.newton_within(q, closing, most, &around)
    }

    /// As [`Self::newton`], given up as soon as the parameters leave their ranges.
    pub(super) fn newton_within(
        &self,
        q: &mut [f64; 4],
        closing: Closing,
        most: usize,
        ranges: &[[f64; 2]; 4],
    ) -> bool {
        if let Some(heights) = &self.heights {
            return heights.newton(q, closing, most, ranges, &self.tolerances);
        }
        let closing = match (closing, &self.lifted) {
            // A plane upright on the level is the same for what is lifted.
            (Closing::Plane(normal, point), Some(lifted)) => {
                Closing::Plane(lifted.along_level(normal), point)
            }
            _ => closing,
        };
        for _ in 0..most {
            let jets = self.first_jets(q);
            let Some(step) = Step::new(&jets, q, closing) else {
                return false;
            };
            step.apply(q);
            if !lies(q, ranges) {
                return false;
            }
            if let Closing::Fixed(k, value) = closing {
                q[k] = value;
            }
            if step.residual < self.tolerances.residual && step.moved < self.tolerances.step {
                return true;
            }
        }
        false
    }

    /// The curve's node at a common point, running along `towards` if given. `None` where the sheets touch.
    pub(super) fn node(&self, q: [f64; 4], towards: Option<DVec3>) -> Option<Node> {
        if let Some(heights) = &self.heights {
            return heights.node(q, towards, &self.tolerances);
        }
        let jets = self.jets(&q);
        let Some(lifted) = &self.lifted else {
            return node_of(&jets, q, towards);
        };
        let node = lifted.back(&node_of(&jets, q, None)?);
        let turns = towards.is_some_and(|d| d.dot(node.tangent()) < 0.0);
        Some(if turns { node.reversed() } else { node })
    }

    /// Farthest of a piece from both sheets, at some fractions of its length.
    pub(super) fn deviation(&self, a: &Node, b: &Node, length: f64, fractions: &[f64]) -> f64 {
        let points = super::hermite::control(a, b, length);
        let mut most: f64 = 0.0;
        for fraction in fractions {
            let value = super::hermite::at(&points, *fraction);
            let space = super::hermite::space(&value);
            for side in 0..2 {
                let q = super::hermite::on_sheet(&value, side);
                let gap = self.sheets[side].point(q.x, q.y).distance(space);
                // `max` would drop a NaN.
                if gap.is_nan() {
                    return f64::INFINITY;
                }
                most = most.max(gap);
            }
            if let Some(heights) = &self.heights {
                // Nearly parallel sheets are near each other far from where they cross.
                let off = heights.off(space.xy());
                most = most.max(if off.is_nan() {
                    f64::INFINITY
                } else {
                    ACROSS * off
                });
            }
            if let Some(lifted) = &self.lifted {
                // So are sheets that touch one level.
                let q = std::array::from_fn(|i| value[3 + i]);
                let [a, b] = lifted.jets(self.sheets, &q);
                let (na, nb) = (a.normal().normalize(), b.normal().normalize());
                let off = (a.p - b.p).dot(na).abs() / na.cross(nb).length();
                most = most.max(if off.is_nan() {
                    f64::INFINITY
                } else {
                    ACROSS * off
                });
            }
        }
        most
    }
}

/// The node of two sheets' curve at a common point with these derivatives, running along `towards` if given.
fn node_of([a, b]: &[Jet; 2], q: [f64; 4], towards: Option<DVec3>) -> Option<Node> {
    let (na, nb) = (a.normal(), b.normal());
    let (ga, gb) = (na.length_squared(), nb.length_squared());
    let cross = na.cross(nb);
    let length = cross.length();
    let sine = length / (ga * gb).sqrt();
    if !(sine > PARALLEL) {
        return None;
    }
    let mut tangent = cross / length;
    if towards.is_some_and(|d| d.dot(tangent) < 0.0) {
        tangent = -tangent;
    }
    // Components of a tangent vector in a sheet's own parameters.
    let split = |w: DVec3, u: DVec3, v: DVec3, n: DVec3, g: f64| {
        [w.cross(v).dot(n) / g, u.cross(w).dot(n) / g]
    };
    let da = split(tangent, a.u, a.v, na, ga);
    let db = split(tangent, b.u, b.v, nb, gb);
    let bend = |jet: &Jet, d: [f64; 2]| {
        d[0] * d[0] * jet.uu + 2.0 * d[0] * d[1] * jet.uv + d[1] * d[1] * jet.vv
    };
    let (qa, qb) = (bend(a, da), bend(b, db));
    // The curvature vector is normal to the tangent and has each sheet's normal curvature.
    let determinant = tangent.dot(na.cross(nb));
    let curvature = (na.dot(qa) * nb.cross(tangent) + nb.dot(qb) * tangent.cross(na)) / determinant;
    let ea = split(curvature - qa, a.u, a.v, na, ga);
    let eb = split(curvature - qb, b.u, b.v, nb, gb);
    let point = 0.5 * (a.p + b.p);
    let join = |x: DVec3, y: [f64; 2], z: [f64; 2]| [x.x, x.y, x.z, y[0], y[1], z[0], z[1]];
    Some(Node {
        value: join(point, [q[0], q[1]], [q[2], q[3]]),
        first: join(tangent, da, db),
        second: join(curvature, ea, eb),
        sine,
    })
}

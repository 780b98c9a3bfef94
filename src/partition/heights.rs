//! Sheets that are heights over the plan: x is linear in u, and y in v.
//!
//! Where two of them cross is the zero set of one scalar function over the plan, `d(x, y) = z_a − z_b`. Points of it, and
//! its tangent and curvature, follow from d and its derivatives alone, so nothing is lost however small the angle is at
//! which the sheets cross in space: only the size of `∇d` against the rounding of heights counts.

use glam::{DVec2, DVec3, Vec3Swizzles};
use smallvec::SmallVec;

use super::bounds::Bounds;
use super::hermite::Node;
use super::pair::{Closing, Tolerances, lies};
use super::scalar::Scalar;
use super::sheet::Sheet;
use super::solve::solve;
use crate::nurbs::Surface;

/// How far control points may be from where x and y are linear, as a fraction of the sheet's size in plan.
const LINEAR: f64 = 1e-12;
/// Rounding of a height that is computed, in units of the last place.
const ULPS: f64 = 8.0;

/// Where parameters are in plan: `(x, y) = origin + rate · (u, v)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plan {
    origin: DVec2,
    rate: DVec2,
}

impl Plan {
    /// The plan of a surface that is a height over it.
    pub(super) fn of(surface: &Surface) -> Option<Self> {
        if surface.is_rational() {
            return None;
        }
        let (u, v) = (surface.knots_u(), surface.knots_v());
        let (net, columns) = (surface.net(), v.count());
        let (first, last) = (net[0].xy(), net[net.len() - 1].xy());
        let low = DVec2::new(u.domain().0, v.domain().0);
        let rate = (last - first) / (DVec2::new(u.domain().1, v.domain().1) - low);
        if !rate.cmpgt(DVec2::ZERO).all() {
            return None;
        }
        let origin = first - rate * low;
        let reach = LINEAR * (last - first)
            + 4.0 * f64::EPSILON * (first.abs().max(last.abs()) + origin.abs());
        let is_linear = |(k, p): (usize, &DVec3)| {
            let at = DVec2::new(u.greville(k / columns), v.greville(k % columns));
            (p.xy() - (origin + rate * at)).abs().cmple(reach).all()
        };
        net.iter()
            .enumerate()
            .all(is_linear)
            .then_some(Self { origin, rate })
    }

    pub(super) fn parameters(&self, at: DVec2) -> DVec2 {
        (at - self.origin) / self.rate
    }

    pub(super) fn place(&self, parameters: DVec2) -> DVec2 {
        self.origin + self.rate * parameters
    }
}

/// A height with its derivatives by x and y.
#[derive(Clone, Copy, Debug)]
struct Height {
    z: f64,
    slope: DVec2,
    /// xx, xy, yy.
    bend: [f64; 3],
}

impl Height {
    fn minus(&self, other: &Self) -> Self {
        Self {
            z: self.z - other.z,
            slope: self.slope - other.slope,
            bend: std::array::from_fn(|i| self.bend[i] - other.bend[i]),
        }
    }

    /// The second derivative along a direction, per its length squared.
    fn bend_along(&self, d: DVec2) -> f64 {
        let [xx, xy, yy] = self.bend;
        xx * d.x * d.x + 2.0 * xy * d.x * d.y + yy * d.y * d.y
    }
}

/// Two heights over one plan.
#[derive(Clone, Copy)]
pub(super) struct Heights<'a> {
    pub(super) sheets: [&'a Sheet; 2],
    plans: [Plan; 2],
}

impl<'a> Heights<'a> {
    /// `None` if either sheet is no height.
    pub(super) fn of(sheets: [&'a Sheet; 2]) -> Option<Self> {
        let plans = [sheets[0].plan?, sheets[1].plan?];
        Some(Self { sheets, plans })
    }

    /// A place in plan, from the first sheet's parameters.
    pub(super) fn place(&self, q: &[f64; 4]) -> DVec2 {
        self.plans[0].place(DVec2::new(q[0], q[1]))
    }

    /// A place in plan, from the second sheet's parameters.
    pub(super) fn place_on_second(&self, parameters: DVec2) -> DVec2 {
        self.plans[1].place(parameters)
    }

    /// The parameters on both sheets.
    pub(super) fn parameters(&self, at: DVec2) -> [f64; 4] {
        let [a, b] = [0, 1].map(|side| self.plans[side].parameters(at));
        [a.x, a.y, b.x, b.y]
    }

    fn height(&self, side: usize, at: DVec2) -> Height {
        let plan = &self.plans[side];
        let q = plan.parameters(at);
        let jet = self.sheets[side].jet(q.x, q.y);
        let rate = plan.rate;
        Height {
            z: jet.p.z,
            slope: DVec2::new(jet.u.z, jet.v.z) / rate,
            bend: [
                jet.uu.z / (rate.x * rate.x),
                jet.uv.z / (rate.x * rate.y),
                jet.vv.z / (rate.y * rate.y),
            ],
        }
    }

    /// Height and slope of one of them.
    pub(super) fn first(&self, side: usize, at: DVec2) -> (f64, DVec2) {
        let plan = &self.plans[side];
        let q = plan.parameters(at);
        let (p, u, v) = self.sheets[side].first_jet(q.x, q.y);
        (p.z, DVec2::new(u.z, v.z) / plan.rate)
    }

    /// How much higher the first one is, and the gradient of that.
    pub(super) fn difference(&self, at: DVec2) -> (f64, DVec2) {
        let [(a, slope_a), (b, slope_b)] = [0, 1].map(|side| self.first(side, at));
        (a - b, slope_a - slope_b)
    }

    /// The height of one of them over a part of a patch in plan, or beyond it.
    pub(super) fn part(&self, side: usize, patch: usize, range: [[f64; 2]; 2]) -> Scalar {
        let own = self.sheets[side].patch(patch);
        let (orders, elevations) = own.elevations();
        Scalar::new(orders, elevations, self.range(side, patch)).over(range)
    }

    /// What a patch covers in plan.
    fn range(&self, side: usize, patch: usize) -> [[f64; 2]; 2] {
        let corners = self.sheets[side].range_of(patch);
        let [low, high] = corners.map(|corner| self.plans[side].place(corner));
        [[low.x, high.x], [low.y, high.y]]
    }

    /// The difference where patches of both lie over each other and within a box in plan.
    pub(super) fn cell(&self, patches: [usize; 2], clip: &Bounds) -> Option<Scalar> {
        let own = [0, 1].map(|side| self.range(side, patches[side]));
        let range: [[f64; 2]; 2] = std::array::from_fn(|axis| {
            let [a, b] = [own[0][axis], own[1][axis]];
            [
                a[0].max(b[0]).max(clip.low[axis]),
                a[1].min(b[1]).min(clip.high[axis]),
            ]
        });
        let is_wide = |axis: usize| {
            let whole = own[0][axis][1] - own[0][axis][0];
            range[axis][1] - range[axis][0] > LINEAR * whole
        };
        (is_wide(0) && is_wide(1)).then(|| {
            let [a, b] = [0, 1].map(|side| self.part(side, patches[side], range));
            a.minus(b)
        })
    }

    /// The patches of both that lie over each other within a rectangle in plan, if they are few.
    pub(super) fn patches_over(
        &self,
        range: [[f64; 2]; 2],
        most: usize,
    ) -> Option<SmallVec<[[usize; 2]; 4]>> {
        let [low, high] = [0, 1].map(|at| DVec2::new(range[0][at], range[1][at]));
        let own = [0, 1].map(|side| {
            let plan = &self.plans[side];
            self.sheets[side].patches_between(plan.parameters(low), plan.parameters(high))
        });
        let count = |spans: &[std::ops::RangeInclusive<usize>; 2]| {
            spans
                .iter()
                .map(|span| span.end() + 1 - span.start())
                .product::<usize>()
        };
        if own.iter().any(|spans| count(spans) > most) {
            return None;
        }
        let [a, b] = [0, 1].map(|side| self.sheets[side].patches_of(&own[side]));
        let pairs = a.iter().flat_map(|p| b.iter().map(move |q| [*p, *q]));
        Some(pairs.collect())
    }

    /// What rounding leaves of a difference of heights.
    pub(super) fn noise(&self) -> f64 {
        self.sheets
            .iter()
            .map(|sheet| {
                ULPS * f64::EPSILON * sheet.bounds().low.z.abs().max(sheet.bounds().high.z.abs())
            })
            .sum()
    }

    /// How far from the curve a place near it is, in plan, beyond rounding.
    pub(super) fn off(&self, at: DVec2) -> f64 {
        let (d, slope) = self.difference(at);
        (d.abs() - self.noise()).max(0.0) / slope.length()
    }

    /// As [`super::pair::Pair::newton`].
    pub(super) fn newton(
        &self,
        q: &mut [f64; 4],
        closing: Closing,
        most: usize,
        ranges: &[[f64; 2]; 4],
        tolerances: &Tolerances,
    ) -> bool {
        let mut at = self.place(q);
        let fixed = match closing {
            Closing::Fixed(k, value) => {
                let axis = k % 2;
                let mut own = DVec2::ZERO;
                own[axis] = value;
                at[axis] = self.plans[k / 2].place(own)[axis];
                Some((k, value))
            }
            Closing::Plane(..) => None,
        };
        let noise = self.noise();
        for _ in 0..most {
            let [(a, slope_a), (b, slope_b)] = [0, 1].map(|side| self.first(side, at));
            let (d, slope) = (a - b, slope_a - slope_b);
            let size = slope.length();
            let step = match closing {
                Closing::Fixed(k, _) => {
                    let running = 1 - k % 2;
                    let mut step = DVec2::ZERO;
                    step[running] = -d / slope[running];
                    Some(step)
                }
                Closing::Plane(normal, point) => {
                    let middle = at.extend(0.5 * (a + b));
                    let along = normal.xy() + normal.z * 0.5 * (slope_a + slope_b);
                    let right = [-d / size, -normal.dot(middle - point)];
                    let slope = slope / size;
                    solve([slope.to_array(), along.to_array()], right).map(DVec2::from_array)
                }
            };
            let Some(step) = step.filter(|step| step.is_finite()) else {
                return false;
            };
            at += step;
            *q = self.parameters(at);
            if let Some((k, value)) = fixed {
                q[k] = value;
            }
            if !lies(q, ranges) {
                return false;
            }
            // Along the curve nothing but the plane counts; across it, rounding of heights over their slope.
            if step.length() < tolerances.step.max(4.0 * noise / size) {
                return true;
            }
        }
        false
    }

    /// As [`super::pair::Pair::node`]: `None` where rounding hides the curve.
    pub(super) fn node(
        &self,
        q: [f64; 4],
        towards: Option<DVec3>,
        tolerances: &Tolerances,
    ) -> Option<Node> {
        let at = self.place(&q);
        let [a, b] = [0, 1].map(|side| self.height(side, at));
        let d = a.minus(&b);
        let size = d.slope.length();
        // Written so that NaN fails too.
        if !(self.noise() / size < tolerances.hidden()) {
            return None;
        }
        let across = d.slope / size;
        let along = across.perp();
        let middle = Height {
            z: 0.5 * (a.z + b.z),
            slope: 0.5 * (a.slope + b.slope),
            bend: std::array::from_fn(|i| 0.5 * (a.bend[i] + b.bend[i])),
        };
        // By the length of the curve in plan.
        let first = along.extend(middle.slope.dot(along));
        let turn = -d.bend_along(along) / size * across;
        let second = turn.extend(middle.bend_along(along) + middle.slope.dot(turn));
        // By its length in space.
        let speed = first.length();
        let mut tangent = first / speed;
        let curvature = (second - tangent * tangent.dot(second)) / (speed * speed);
        if towards.is_some_and(|d| d.dot(tangent) < 0.0) {
            tangent = -tangent;
        }
        let rates = self.plans.map(|plan| plan.rate);
        let join = |w: DVec3, q: [f64; 4]| [w.x, w.y, w.z, q[0], q[1], q[2], q[3]];
        let per = |w: DVec3| {
            let [a, b] = rates.map(|rate| w.xy() / rate);
            [a.x, a.y, b.x, b.y]
        };
        let normal = |slope: DVec2| DVec3::new(-slope.x, -slope.y, 1.0);
        let (na, nb) = (normal(a.slope), normal(b.slope));
        Some(Node {
            value: join(at.extend(middle.z), q),
            first: join(tangent, per(tangent)),
            second: join(curvature, per(curvature)),
            sine: na.cross(nb).length() / (na.length() * nb.length()),
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;
    use crate::nurbs::KnotVector;

    /// A bowl and a level that cuts it in a circle of radius 30, of which the heights differ by no more than `depth`.
    fn circle(depth: f64) -> [Sheet; 2] {
        let knots = KnotVector::uniform(2, 3).unwrap();
        let blossom = |i: usize| [2500.0, -2500.0, 2500.0][i];
        let at = |i: usize| -50.0 + 50.0 * i as f64;
        let net = (0..9)
            .map(|k| {
                let (i, j) = (k / 3, k % 3);
                let z = depth * (blossom(i) + blossom(j) - 900.0) / 900.0;
                DVec3::new(at(i), at(j), z)
            })
            .collect();
        let bowl = Surface::new(knots.clone(), knots, net).unwrap();
        let knots = KnotVector::uniform(1, 2).unwrap();
        let corners = [(-60.0, -60.0), (-60.0, 70.0), (60.0, -60.0), (60.0, 70.0)];
        let corners = corners.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
        let level = Surface::new(knots.clone(), knots, corners).unwrap();
        [bowl, level].map(|surface| Sheet::new(surface, 0).unwrap())
    }

    #[test]
    fn a_node_has_the_tangent_and_the_curvature_of_a_circle_however_flat_the_bowl() {
        for depth in [10.0, 1e-3, 1e-7] {
            let [bowl, level] = circle(depth);
            let heights = Heights::of([&bowl, &level]).unwrap();
            let tolerances = Tolerances::new(140.0, 1.0);
            let angle = 0.7_f64;
            let mut q = heights.parameters(31.0 * DVec2::from_angle(angle));
            let along = DVec3::new(-angle.sin(), angle.cos(), 0.0);
            let ranges = [[-1.0, 2.0]; 4];
            assert!(heights.newton(
                &mut q,
                Closing::Plane(along, DVec3::ZERO),
                20,
                &ranges,
                &tolerances
            ));
            let place = heights.place(&q);
            assert!((place.length() - 30.0).abs() < 1e-9, "{depth}: {place}");
            let node = heights.node(q, Some(along), &tolerances).unwrap();
            assert!(node.tangent().distance(along) < 1e-9);
            let inwards = -DVec2::from_angle(angle).extend(0.0) / 30.0;
            assert!(node.curvature().distance(inwards) < 1e-9);
        }
    }

    #[test]
    fn only_sheets_with_x_linear_in_u_and_y_in_v_are_heights() {
        let [bowl, level] = circle(1.0);
        assert!(bowl.plan.is_some() && level.plan.is_some());
        let mut net = bowl.surface.net().to_vec();
        net[4].x += 1e-6;
        let (u, v) = (
            bowl.surface.knots_u().clone(),
            bowl.surface.knots_v().clone(),
        );
        let bent = Surface::new(u, v, net).unwrap();
        assert!(Plan::of(&bent).is_none());
    }
}

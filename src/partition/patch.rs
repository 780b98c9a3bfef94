//! Bézier patches: halving, and bounds of where a patch is and where its normals point.
//!
//! Degrees up to 7 each way, rational or not. The net is homogeneous, (w x, w y, w z, w), u-major. A
//! patch may be evaluated outside of its own parameters: its polynomial goes on.

mod evaluate;

use glam::{DVec3, DVec4, Vec4Swizzles};
use smallvec::SmallVec;

use super::bounds::Bounds;
use super::cone::cone;

pub(super) use evaluate::{Jet, Slice};

/// Most control points each way.
pub(super) const ORDER: usize = 8;

/// Most legs along v of patches whose normals' slopes are asked for: of 4 × 4 control points there are 12.
const LANES: usize = 12;

/// One of the two parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Along {
    U,
    V,
}

/// Homogeneous control points.
type Net = SmallVec<[DVec4; 16]>;

/// A Bézier patch over a rectangle of its surface's parameters.
#[derive(Clone, Debug)]
pub(super) struct Patch {
    rows: usize,
    columns: usize,
    rational: bool,
    net: Net,
    pub(super) u: [f64; 2],
    pub(super) v: [f64; 2],
    pub(super) bounds: Bounds,
    /// The direction across which it is likely to be thin, and its range along it.
    thin: DVec3,
    slab: [f64; 2],
}

impl Patch {
    /// A patch from its net and weights, both u-major.
    pub(super) fn new(
        rows: usize,
        net: &[DVec3],
        weights: &[f64],
        u: [f64; 2],
        v: [f64; 2],
    ) -> Self {
        let rational = weights.iter().any(|w| *w != 1.0);
        let net: Net = net
            .iter()
            .zip(weights)
            .map(|(p, w)| (*p * *w).extend(*w))
            .collect();
        let mut patch = Self {
            rows,
            columns: net.len() / rows,
            rational,
            bounds: Bounds::of(points(&net, rational)),
            net,
            u,
            v,
            thin: DVec3::ZERO,
            slab: [0.0; 2],
        };
        patch.measure();
        patch
    }

    /// Finds what it is thin across.
    fn measure(&mut self) {
        self.thin = self.thin_direction();
        self.slab = self.range_along(self.thin);
    }

    /// Whether a plane across its thin direction separates it from another patch, by more than a distance.
    pub(super) fn is_beside(&self, other: &Self, distance: f64) -> bool {
        let range = other.range_along(self.thin);
        let slack = distance * self.thin.length();
        self.slab[0] > range[1] + slack || range[0] > self.slab[1] + slack
    }

    /// Its thin direction, and its range along it.
    pub(super) fn slab(&self) -> (DVec3, [f64; 2]) {
        (self.thin, self.slab)
    }

    fn control(&self, i: usize, j: usize) -> DVec3 {
        let h = self.net[i * self.columns + j];
        if self.rational {
            h.xyz() / h.w
        } else {
            h.xyz()
        }
    }

    /// The parameters of its middle.
    pub(super) fn middle(&self) -> [f64; 2] {
        [0.5 * (self.u[0] + self.u[1]), 0.5 * (self.v[0] + self.v[1])]
    }

    /// The direction in which its net is longer.
    pub(super) fn longer(&self) -> Along {
        let corner = |i: usize, j: usize| self.control(i * (self.rows - 1), j * (self.columns - 1));
        let along_u = (corner(1, 0) - corner(0, 0)) + (corner(1, 1) - corner(0, 1));
        let along_v = (corner(0, 1) - corner(0, 0)) + (corner(1, 1) - corner(1, 0));
        if along_u.length_squared() > along_v.length_squared() {
            Along::U
        } else {
            Along::V
        }
    }

    /// Those of its two halves (de Casteljau) whose boxes are wanted.
    pub(super) fn halves(
        &self,
        along: Along,
        wanted: impl Fn(&Bounds) -> bool,
    ) -> [Option<Self>; 2] {
        let [u, v] = self.middle();
        let (u, v) = match along {
            Along::U => ([[self.u[0], u], [u, self.u[1]]], [self.v; 2]),
            Along::V => ([self.u; 2], [[self.v[0], v], [v, self.v[1]]]),
        };
        let half = |net: Net, u: [f64; 2], v: [f64; 2]| {
            let bounds = Bounds::of(points(&net, self.rational));
            wanted(&bounds).then(|| {
                let mut patch = Self {
                    net,
                    u,
                    v,
                    bounds,
                    ..*self
                };
                patch.measure();
                patch
            })
        };
        let [low, high] = self.half_nets(along);
        [half(low, u[0], v[0]), half(high, u[1], v[1])]
    }

    fn half_nets(&self, along: Along) -> [Net; 2] {
        let (lines, degree, line_step, step) = match along {
            Along::U => (self.columns, self.rows - 1, 1, self.columns),
            Along::V => (self.rows, self.columns - 1, self.columns, 1),
        };
        let mut low = Net::from_slice(&self.net);
        let mut high = Net::from_slice(&self.net);
        for line in 0..lines {
            let at = |k: usize| line * line_step + k * step;
            let mut work = [DVec4::ZERO; ORDER];
            for (k, h) in work.iter_mut().take(degree + 1).enumerate() {
                *h = self.net[at(k)];
            }
            for round in 1..=degree {
                for k in 0..=degree - round {
                    work[k] = 0.5 * (work[k] + work[k + 1]);
                }
                low[at(round)] = work[0];
                high[at(degree - round)] = work[degree - round];
            }
        }
        [low, high]
    }

    /// The range of the slopes of its normals: how far they lean along a direction, against upright. `None` if some
    /// may be level, and for rational patches.
    ///
    /// Tangents along u are sums of legs along u, those along v of legs along v, with positive factors; so normals
    /// are such sums of the products of legs.
    pub(super) fn slopes(&self, along: DVec3, upright: DVec3) -> Option<[f64; 2]> {
        if self.rational {
            return None;
        }
        let [legs_u, legs_v] = self.legs();
        if legs_v.len() > LANES {
            return None;
        }
        // By coordinate, so that the compiler takes several at once; the last one as often as it fills up.
        let lanes: [[f64; LANES]; 3] = std::array::from_fn(|axis| {
            std::array::from_fn(|k| legs_v[k.min(legs_v.len() - 1)][axis])
        });
        let used = legs_v.len().next_multiple_of(4).min(LANES);
        let sign = legs_u[0].cross(legs_v[0]).dot(upright).signum();
        let mut least = [f64::INFINITY; LANES];
        let mut range = [[f64::INFINITY; LANES], [f64::NEG_INFINITY; LANES]];
        let smaller = |a: f64, b: f64| if a < b { a } else { b };
        for a in legs_u {
            let (lean, rise) = (along.cross(a) * sign, upright.cross(a) * sign);
            for k in 0..used {
                let [x, y, z] = [lanes[0][k], lanes[1][k], lanes[2][k]];
                let height = x * rise.x + y * rise.y + z * rise.z;
                let slope = (x * lean.x + y * lean.y + z * lean.z) / height;
                least[k] = smaller(height, least[k]);
                range[0][k] = smaller(slope, range[0][k]);
                range[1][k] = -smaller(-slope, -range[1][k]);
            }
        }
        let all = |lanes: &[f64; LANES]| lanes.iter().copied().fold(f64::INFINITY, f64::min);
        let high = range[1].iter().copied().fold(f64::NEG_INFINITY, f64::max);
        (all(&least) > 0.0).then(|| [all(&range[0]), high])
    }

    /// Steps between neighbouring control points, along u and along v.
    fn legs(&self) -> [SmallVec<[DVec3; 16]>; 2] {
        let points: SmallVec<[DVec3; 16]> = points(&self.net, self.rational).collect();
        let leg = |(from, to): (&DVec3, &DVec3)| *to - *from;
        [
            points
                .iter()
                .zip(&points[self.columns..])
                .map(leg)
                .collect(),
            points
                .chunks_exact(self.columns)
                .flat_map(|row| row.iter().zip(&row[1..]).map(leg))
                .collect(),
        ]
    }

    fn thin_direction(&self) -> DVec3 {
        let corner = |i: usize, j: usize| self.control(i * (self.rows - 1), j * (self.columns - 1));
        let along_u = (corner(1, 0) - corner(0, 0)) + (corner(1, 1) - corner(0, 1));
        let along_v = (corner(0, 1) - corner(0, 0)) + (corner(1, 1) - corner(1, 0));
        along_u.cross(along_v)
    }

    /// The range of its control points along a direction.
    fn range_along(&self, direction: DVec3) -> [f64; 2] {
        points(&self.net, self.rational).fold(
            [f64::INFINITY, f64::NEG_INFINITY],
            |[low, high], p| {
                let d = p.dot(direction);
                [low.min(d), high.max(d)]
            },
        )
    }

    /// A cone that holds all normals: its unit axis and the sine of its half-angle, if they fit a half-space.
    ///
    /// Legs of the net hold all tangents in cones about their means (hodographs lie in the hull of their
    /// control vectors), and a product of vectors of two cones leans from the product of the axes by at
    /// most `(sin α + sin β) / sin γ`-like amounts, γ the angle between the axes. Rational patches scale
    /// hodographs by positive functions, and their legs still bound the directions well enough here:
    /// cones only decide how deep to look.
    pub(super) fn normals(&self) -> Option<(DVec3, f64)> {
        let [legs_u, legs_v] = self.legs();
        let (a, alpha) = cone(&legs_u)?;
        let (b, beta) = cone(&legs_v)?;
        let cross = a.cross(b);
        let gamma = cross.length();
        let lean = (alpha + beta + alpha * beta) / gamma;
        (gamma > 1e-6 && lean < 1.0).then(|| (cross / gamma, lean))
    }
}

fn points(net: &[DVec4], rational: bool) -> impl Iterator<Item = DVec3> + Clone {
    net.iter()
        .map(move |h| if rational { h.xyz() / h.w } else { h.xyz() })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;

    #[test]
    fn slopes_of_sampled_normals_lie_within_the_bounds_from_legs() {
        // A bowl that is twisted, and rougher along u.
        let net: Vec<DVec3> = (0..16)
            .map(|k| (f64::from(k / 4) - 1.5, f64::from(k % 4) - 1.5))
            .map(|(x, y)| DVec3::new(x, y, 0.2 * x * x + 0.05 * y * y + 0.03 * x * y))
            .collect();
        let patch = Patch::new(4, &net, &[1.0; 16], [0.0, 1.0], [0.0, 1.0]);
        for along in [DVec3::X, DVec3::Y, DVec3::new(-1.0, 0.4, 0.1)] {
            let [low, high] = patch.slopes(along, DVec3::Z).unwrap();
            let mut sampled = [f64::INFINITY, f64::NEG_INFINITY];
            for k in 0..=100 {
                let (_, u, v) = patch.first_jet(f64::from(k / 10) / 10.0, f64::from(k % 11) / 10.0);
                let normal = u.cross(v);
                let slope = normal.dot(along) / normal.z;
                assert!(low <= slope && slope <= high);
                sampled = [sampled[0].min(slope), sampled[1].max(slope)];
            }
            // Bounds that say nothing would hold them too.
            assert!(high - low < 2.0 * (sampled[1] - sampled[0]));
        }
    }

    #[test]
    fn a_patch_that_stands_upright_somewhere_has_no_slopes() {
        let net =
            [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]].map(|[x, z]| DVec3::new(x, 0.0, z));
        let patch = Patch::new(2, &net, &[1.0; 4], [0.0, 1.0], [0.0, 1.0]);
        assert!(patch.slopes(DVec3::X, DVec3::Z).is_none());
    }
}

//! Where the normals of patches point, from the legs of their nets.
//!
//! Tangents along u are sums of legs along u, those along v of legs along v, with positive factors; so normals are
//! such sums of the products of legs. Rational patches scale hodographs by positive functions.

use glam::{DVec3, Vec4Swizzles};
use smallvec::SmallVec;

use super::Patch;
use crate::partition::cone::cone;

/// Most legs along v of patches whose normals are compared one by one: of 4 × 4 control points there are 12.
const LANES: usize = 12;

/// Steps between neighbouring control points, along u and along v.
#[derive(Default)]
struct Legs {
    u: SmallVec<[DVec3; LANES]>,
    v: SmallVec<[DVec3; LANES]>,
}

impl Patch {
    /// A cone that holds all normals: its unit axis and the sine of its half-angle, if they fit a half-space.
    ///
    /// Legs of the net hold all tangents in cones about their means (hodographs lie in the hull of their
    /// control vectors), and a product of vectors of two cones leans from the product of the axes by at
    /// most `(sin α + sin β) / sin γ`-like amounts, γ the angle between the axes. The legs of rational patches
    /// still bound the directions well enough here: cones only decide how deep to look.
    pub(in crate::partition) fn normals(&self) -> Option<(DVec3, f64)> {
        let mut legs = Legs::default();
        self.legs(&mut legs);
        let (a, alpha) = cone(&legs.u)?;
        let (b, beta) = cone(&legs.v)?;
        let cross = a.cross(b);
        let gamma = cross.length();
        let lean = (alpha + beta + alpha * beta) / gamma;
        (gamma > 1e-6 && lean < 1.0).then(|| (cross / gamma, lean))
    }

    /// Cones that hold its tangents along u and along v, as far as they fit half-spaces.
    pub(in crate::partition) fn tangents(&self) -> [Option<(DVec3, f64)>; 2] {
        let mut legs = Legs::default();
        self.legs(&mut legs);
        [cone(&legs.u), cone(&legs.v)]
    }

    /// The range of the slopes of the normals at its corners: how far they lean along a direction, against upright.
    /// `None` if one of them is level.
    pub(in crate::partition) fn corner_slopes(
        &self,
        along: DVec3,
        upright: DVec3,
    ) -> Option<[f64; 2]> {
        let (last_u, last_v) = (self.rows - 1, self.columns - 1);
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        let mut sign = 0.0;
        for (i, near_u) in [(0, 1), (last_u, last_u - 1)] {
            for (j, near_v) in [(0, 1), (last_v, last_v - 1)] {
                let corner = self.control(i, j);
                let legs = [self.control(near_u, j), self.control(i, near_v)].map(|p| p - corner);
                let turned = if (i == 0) == (j == 0) { 1.0 } else { -1.0 };
                let normal = turned * legs[0].cross(legs[1]);
                let height = normal.dot(upright);
                if sign == 0.0 {
                    sign = height.signum();
                }
                // Written so that NaN fails too.
                if !(sign * height > 0.0) {
                    return None;
                }
                let slope = normal.dot(along) / height;
                range = [range[0].min(slope), range[1].max(slope)];
            }
        }
        Some(range)
    }

    /// Whether all its normals, turned to where they point up, point along a direction too, as far as the products of
    /// its legs tell. `false` for rational patches.
    pub(in crate::partition) fn all_lean(&self, along: DVec3, upright: DVec3) -> bool {
        if self.rational {
            return false;
        }
        let mut legs = Legs::default();
        self.legs(&mut legs);
        if legs.v.len() > LANES {
            return false;
        }
        // By coordinate, so that the compiler takes several at once; the last one as often as it fills up.
        let last = legs.v.len() - 1;
        let lanes: [[f64; LANES]; 3] =
            std::array::from_fn(|axis| std::array::from_fn(|k| legs.v[k.min(last)][axis]));
        let used = legs.v.len().next_multiple_of(4).min(LANES);
        let sign = legs.u[0].cross(legs.v[0]).dot(upright).signum();
        let mut least = [f64::INFINITY; LANES];
        let smaller = |a: f64, b: f64| if a < b { a } else { b };
        for leg in &legs.u {
            let (lean, rise) = (along.cross(*leg) * sign, upright.cross(*leg) * sign);
            for (k, least) in least.iter_mut().take(used).enumerate() {
                let [x, y, z] = [lanes[0][k], lanes[1][k], lanes[2][k]];
                let height = x * rise.x + y * rise.y + z * rise.z;
                let reach = x * lean.x + y * lean.y + z * lean.z;
                *least = smaller(smaller(height, reach), *least);
            }
        }
        least.iter().all(|least| *least > 0.0)
    }

    fn legs(&self, legs: &mut Legs) {
        let leg = |from: usize, to: usize| {
            let [from, to] = [from, to].map(|at| {
                let h = self.net[at];
                if self.rational {
                    h.xyz() / h.w
                } else {
                    h.xyz()
                }
            });
            to - from
        };
        let columns = self.columns;
        legs.u
            .extend((0..self.net.len() - columns).map(|at| leg(at, at + columns)));
        for row in 0..self.rows {
            let first = row * columns;
            legs.v
                .extend((first..first + columns - 1).map(|at| leg(at, at + 1)));
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;

    /// A bowl that is twisted, and rougher along u.
    fn bowl() -> Patch {
        let net: Vec<DVec3> = (0..16)
            .map(|k| (f64::from(k / 4) - 1.5, f64::from(k % 4) - 1.5))
            .map(|(x, y)| DVec3::new(x, y, 0.2 * x * x + 0.05 * y * y + 0.03 * x * y))
            .collect();
        Patch::new(4, &net, &[1.0; 16], [0.0, 1.0], [0.0, 1.0])
    }

    /// The range of the slopes of sampled normals.
    fn sampled(patch: &Patch, along: DVec3) -> [f64; 2] {
        let slopes = (0..=120).map(|k| {
            let (_, u, v) = patch.first_jet(f64::from(k / 11) / 10.0, f64::from(k % 11) / 10.0);
            let normal = u.cross(v);
            normal.dot(along) / normal.z
        });
        slopes.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], slope| {
            [low.min(slope), high.max(slope)]
        })
    }

    #[test]
    fn all_normals_lean_only_where_the_sampled_ones_do_and_a_little_beyond_they_are_known_to() {
        let patch = bowl();
        for along in [DVec3::X, DVec3::Y, DVec3::new(-1.0, 0.4, 0.1)] {
            let [low, high] = sampled(&patch, along);
            let width = high - low;
            let beyond = |slope: f64| patch.all_lean(along - slope * DVec3::Z, DVec3::Z);
            assert!(beyond(low - 0.5 * width));
            assert!(!beyond(low + 1e-9));
            let below = |slope: f64| patch.all_lean(slope * DVec3::Z - along, DVec3::Z);
            assert!(below(high + 0.5 * width));
            assert!(!below(high - 1e-9));
        }
    }

    #[test]
    fn a_patch_seen_from_below_leans_as_far() {
        let patch = bowl();
        let up = patch.corner_slopes(DVec3::X, DVec3::Z).unwrap();
        let down = patch.corner_slopes(DVec3::X, -DVec3::Z).unwrap();
        assert_eq!(up, [-down[1], -down[0]]);
    }

    #[test]
    fn corner_slopes_are_those_of_the_normals_there() {
        let patch = bowl();
        let range = patch.corner_slopes(DVec3::X, DVec3::Z).unwrap();
        let corners = [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0)];
        let slopes = corners.map(|(u, v)| {
            let (_, u, v) = patch.first_jet(u, v);
            let normal = u.cross(v);
            normal.x / normal.z
        });
        let low = slopes.iter().copied().fold(f64::INFINITY, f64::min);
        let high = slopes.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        assert!((range[0] - low).abs() < 1e-12 && (range[1] - high).abs() < 1e-12);
    }

    #[test]
    fn a_patch_that_stands_upright_somewhere_has_no_slopes() {
        let net =
            [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]].map(|[x, z]| DVec3::new(x, 0.0, z));
        let patch = Patch::new(2, &net, &[1.0; 4], [0.0, 1.0], [0.0, 1.0]);
        assert!(patch.corner_slopes(DVec3::X, DVec3::Z).is_none());
        assert!(!patch.all_lean(DVec3::X, DVec3::Z));
    }
}

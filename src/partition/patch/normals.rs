//! Where tangents and normals of patches point, from the legs of their nets.
//!
//! Tangents along u are sums of legs along u with positive factors, those along v of legs along v; so normals are such sums of the
//! products of legs. For a rational patch that is so up to a positive function where weights are products, one factor for
//! each row and one for each column: then a curve in it has the weights of a row, and its tangents are sums of the steps from
//! any of its control points to later ones, which are sums of legs. Where weights are no products, steps between all rows
//! (columns) take the place of legs.

use glam::DVec3;
use smallvec::SmallVec;

use super::{ORDER, Patch, place};
use crate::partition::cone::{cone, product};

/// The usual number of legs each way: of 4 × 4 control points there are 12.
const LEGS: usize = 12;

/// Steps between control points, along u and along v.
pub(in crate::partition) type Legs = [SmallVec<[DVec3; LEGS]>; 2];

/// Cones that hold the directions of a patch, as far as they fit half-spaces: unit axes and sines of half-angles.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::partition) struct Cones {
    /// Of its tangents along u and along v.
    pub(in crate::partition) tangents: [Option<(DVec3, f64)>; 2],
    /// Of all products of a tangent along u and one along v, not of one place only: so of its normals, too.
    pub(in crate::partition) normals: Option<(DVec3, f64)>,
}

impl Cones {
    fn of(legs: &Legs) -> Self {
        Self::with(legs.each_ref().map(|legs| cone(legs.iter().copied())))
    }

    fn with(tangents: [Option<(DVec3, f64)>; 2]) -> Self {
        let normals = match tangents {
            [Some(u), Some(v)] => product(u, v),
            _ => None,
        };
        Self { tangents, normals }
    }
}

impl Patch {
    /// The cones that hold its tangents and its normals.
    pub(in crate::partition) fn cones(&self) -> Cones {
        if self.rational && !self.has_product_weights {
            return Cones::of(&self.legs());
        }
        match [self.rows, self.columns] {
            [2, 2] => self.cones_of::<2, 2>(),
            [2, 4] => self.cones_of::<2, 4>(),
            [4, 2] => self.cones_of::<4, 2>(),
            [4, 4] => self.cones_of::<4, 4>(),
            _ => self.cones_of::<ORDER, ORDER>(),
        }
    }

    /// The same from the legs of its net, without a place for them; its orders are constants unless they are only the most.
    fn cones_of<const R: usize, const C: usize>(&self) -> Cones {
        let [rows, columns] = if R == ORDER {
            [self.rows, self.columns]
        } else {
            [R, C]
        };
        let mut net = [[DVec3::ZERO; C]; R];
        for (row, own) in net.iter_mut().zip(self.net.chunks_exact(columns)) {
            for (p, h) in row.iter_mut().zip(own) {
                *p = place(h, self.rational);
            }
        }
        let net = &net;
        let along_u =
            (0..rows - 1).flat_map(|i| (0..columns).map(move |j| net[i + 1][j] - net[i][j]));
        let along_v =
            (0..rows).flat_map(|i| (0..columns - 1).map(move |j| net[i][j + 1] - net[i][j]));
        Cones::with([cone(along_u), cone(along_v)])
    }

    /// The cones that hold those of it and of another patch of its sheet.
    pub(in crate::partition) fn cones_with(&self, other: &Self) -> Cones {
        let [mut u, mut v] = self.legs();
        let [more_u, more_v] = other.legs();
        u.extend_from_slice(&more_u);
        v.extend_from_slice(&more_v);
        Cones::of(&[u, v])
    }

    /// A cone that holds all normals: its unit axis and the sine of its half-angle, if they fit a half-space.
    pub(in crate::partition) fn normals(&self) -> Option<(DVec3, f64)> {
        self.cones().normals
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

    /// Steps of which all tangents along u, and along v, are sums with positive factors.
    pub(in crate::partition) fn legs(&self) -> Legs {
        let mut legs = Legs::default();
        let columns = self.columns;
        if self.rational && !self.has_product_weights {
            self.steps(&mut legs);
            return legs;
        }
        let leg = |from: usize, to: usize| {
            let [from, to] = [from, to].map(|at| place(&self.net[at], self.rational));
            to - from
        };
        for at in 0..self.net.len() - columns {
            legs[0].push(leg(at, at + columns));
        }
        for row in 0..self.rows {
            let first = row * columns;
            for at in first..first + columns - 1 {
                legs[1].push(leg(at, at + 1));
            }
        }
        legs
    }

    /// From each control point to all of later rows, and of later columns.
    fn steps(&self, legs: &mut Legs) {
        let all = || (0..self.rows).flat_map(|i| (0..self.columns).map(move |j| [i, j]));
        for from in all() {
            for to in all() {
                let step = || self.control(to[0], to[1]) - self.control(from[0], from[1]);
                if to[0] > from[0] {
                    legs[0].push(step());
                }
                if to[1] > from[1] {
                    legs[1].push(step());
                }
            }
        }
    }
}

/// How all products of legs slope along a direction, if they all point up or all down.
pub(in crate::partition) fn slopes(legs: &Legs, along: DVec3, upright: DVec3) -> Option<[f64; 2]> {
    // Vanishing legs say nothing.
    let [legs_u, legs_v] = legs.each_ref().map(|legs| {
        let legs = legs.iter().filter(|leg| **leg != DVec3::ZERO).copied();
        legs.collect::<SmallVec<[DVec3; LEGS]>>()
    });
    let sign = legs_u
        .first()?
        .cross(*legs_v.first()?)
        .dot(upright)
        .signum();
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    let smaller = |a: f64, b: f64| if a < b { a } else { b };
    for some in legs_v.chunks(LEGS) {
        // By coordinate, so that the compiler takes several at once; the last one as often as it fills up.
        let last = some.len() - 1;
        let lanes: [[f64; LEGS]; 3] =
            std::array::from_fn(|axis| std::array::from_fn(|k| some[k.min(last)][axis]));
        let mut least = [f64::INFINITY; LEGS];
        let (mut low, mut high) = ([f64::INFINITY; LEGS], [f64::INFINITY; LEGS]);
        for u in &legs_u {
            let [rise, reach] = [upright, along].map(|d| sign * d.cross(*u));
            for k in 0..LEGS {
                let [x, y, z] = [lanes[0][k], lanes[1][k], lanes[2][k]];
                let height = x * rise.x + y * rise.y + z * rise.z;
                let slope = (x * reach.x + y * reach.y + z * reach.z) / height;
                least[k] = smaller(height, least[k]);
                low[k] = smaller(slope, low[k]);
                high[k] = smaller(-slope, high[k]);
            }
        }
        // Written so that NaN fails too.
        if !least.iter().all(|height| *height > 0.0) {
            return None;
        }
        for (low, high) in low.into_iter().zip(high) {
            range = [smaller(low, range[0]), -smaller(high, -range[1])];
        }
    }
    Some(range)
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
    fn slopes_hold_those_of_all_sampled_normals_and_not_much_more() {
        let patch = bowl();
        let directions = [DVec3::X, DVec3::new(-1.0, 0.4, 0.1)];
        for upright in [DVec3::Z, -DVec3::Z] {
            for along in directions {
                let range = slopes(&patch.legs(), along, upright).unwrap();
                let sign = upright.z;
                let mut sampled = sampled(&patch, along).map(|slope| sign * slope);
                sampled.sort_by(f64::total_cmp);
                let width = sampled[1] - sampled[0];
                assert!(range[0] <= sampled[0] && sampled[1] <= range[1]);
                assert!(range[0] > sampled[0] - width && range[1] < sampled[1] + width);
            }
        }
    }

    /// Directions of sampled tangents along u and v, and of products of tangents of different places.
    fn sampled_directions_of(patch: &Patch) -> ([Vec<DVec3>; 2], Vec<DVec3>) {
        let within = |[low, high]: [f64; 2], k: u32| low + (high - low) * f64::from(k) / 8.0;
        let at = |k: u32| patch.first_jet(within(patch.u, k / 9), within(patch.v, k % 9));
        let jets: Vec<_> = (0..81).map(at).collect();
        let products = jets
            .iter()
            .flat_map(|a| jets.iter().map(|b| a.1.cross(b.2)));
        let products = products.collect();
        let tangents = [
            jets.iter().map(|j| j.1).collect(),
            jets.iter().map(|j| j.2).collect(),
        ];
        (tangents, products)
    }

    #[test]
    fn cones_hold_all_tangents_and_products_of_rational_patches_too() {
        let net: Vec<DVec3> = (0..9)
            .map(|k| (f64::from(k / 3), f64::from(k % 3)))
            .map(|(x, y)| DVec3::new(x + 0.1 * y * y, y - 0.2 * x, 0.1 * x * x - 0.07 * y * y))
            .collect();
        let products: Vec<f64> = (0..9)
            .map(|k| [1.0, 0.4, 2.0][k / 3] * [1.0, 3.0, 0.7][k % 3])
            .collect();
        let any = vec![1.0, 5.0, 0.3, 0.2, 1.0, 4.0, 3.0, 0.5, 1.0];
        for weights in [vec![1.0; 9], products, any] {
            let patch = Patch::new(3, &net, &weights, [0.0, 1.0], [0.0, 1.0]);
            let mut parts = vec![patch];
            for along in [
                crate::partition::patch::Along::U,
                crate::partition::patch::Along::V,
            ] {
                let whole = parts.clone();
                for part in whole {
                    part.halve(along, |_| true, |half| parts.push(half));
                }
            }
            let mut given = 0;
            for part in &parts {
                let cones = part.cones();
                let (tangents, products) = sampled_directions_of(part);
                let all = [cones.tangents[0], cones.tangents[1], cones.normals];
                for (cone, sampled) in all.into_iter().zip([&tangents[0], &tangents[1], &products])
                {
                    let Some((axis, sine)) = cone else { continue };
                    given += 1;
                    for direction in sampled {
                        let direction = direction.normalize();
                        assert!(direction.dot(axis) > 0.0);
                        assert!(direction.cross(axis).length() <= sine + 1e-12);
                    }
                }
            }
            assert!(given > 8, "{given}");
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
        assert!(slopes(&patch.legs(), DVec3::X, DVec3::Z).is_none());
    }
}

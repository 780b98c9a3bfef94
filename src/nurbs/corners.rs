//! Corners: where a curve's direction jumps, and where a surface has a crease along v.

use std::ops::Range;

use glam::DVec3;

use super::{Curve, KnotVector, Surface};

/// Legs of a control polygon that turn by less (rad) have no corner: what is left of a straight line by rounding.
const STRAIGHT: f64 = 1e-7;

impl KnotVector {
    /// Interior knots at which neighbouring pieces have but a control point in common, with its index.
    fn joints(&self) -> Vec<(f64, usize)> {
        let distinct = self.distinct();
        let mut before = self.degree() + 1;
        let mut found = Vec::new();
        for &(value, times) in &distinct[1..distinct.len() - 1] {
            if times >= self.degree() {
                found.push((value, before - 1));
            }
            before += times;
        }
        found
    }
}

/// Whether a control polygon turns at the second of three points.
fn turns([a, b, c]: [DVec3; 3]) -> bool {
    let (one, other) = (b - a, c - b);
    one.cross(other).length() > STRAIGHT * one.length() * other.length() || one.dot(other) < 0.0
}

impl Curve {
    /// The parameters of its corners.
    pub fn corners(&self) -> Vec<f64> {
        let at = |k: usize| [k - 1, k, k + 1].map(|i| self.points()[i]);
        let joints = self.knots().joints().into_iter();
        let corners = joints.filter(|(_, k)| turns(at(*k)));
        corners.map(|corner| corner.0).collect()
    }
}

impl Surface {
    /// The parts between its creases along v, which keep their parameters; the surface itself if it has none.
    pub fn smooth_parts_u(&self) -> Vec<Self> {
        let columns = self.knots_v().count();
        let at = |k: usize, j: usize| [k - 1, k, k + 1].map(|i| self.net()[i * columns + j]);
        let has_crease = |k: usize| (0..columns).any(|j| turns(at(k, j)));
        let joints = self.knots_u().joints().into_iter();
        let creases: Vec<(f64, usize)> = joints.filter(|joint| has_crease(joint.1)).collect();
        let (degree, knots) = (self.knots_u().degree(), self.knots_u().as_slice());
        let (start, end) = self.knots_u().domain();
        let mut parts = Vec::with_capacity(creases.len() + 1);
        let (mut from, mut first) = (start, 0);
        let last = (end, self.knots_u().count() - 1);
        for (to, shared) in creases.into_iter().chain([last]) {
            let inner = knots.iter().copied().filter(|u| *u > from && *u < to);
            let mut own = vec![from; degree + 1];
            own.extend(inner);
            own.extend(std::iter::repeat_n(to, degree + 1));
            parts.push(self.rows(KnotVector::trusted(degree, own), first..shared + 1));
            (from, first) = (to, shared);
        }
        parts
    }

    /// The surface of some rows of the net, with the knots that belong to them.
    fn rows(&self, u: KnotVector, own: Range<usize>) -> Self {
        let columns = self.knots_v().count();
        let own = own.start * columns..own.end * columns;
        Self::trusted(
            u,
            self.knots_v().clone(),
            self.net()[own.clone()].to_vec(),
            self.weights()[own].to_vec(),
            self.is_rational(),
        )
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;

    fn curve(degree: usize, knots: &[f64], points: &[(f64, f64)]) -> Curve {
        let knots = KnotVector::new(degree, knots.to_vec()).unwrap();
        let points = points.iter().map(|(x, y)| DVec3::new(*x, *y, 0.0));
        Curve::new(knots, points.collect()).unwrap()
    }

    #[test]
    fn corners_are_where_directions_jump_and_nowhere_else() {
        let polygon = [
            (-0.5, 0.0),
            (-0.25, -1.0),
            (0.0, -1.0),
            (0.25, -1.0),
            (0.5, 0.0),
        ];
        let knots = [0.0, 0.0, 0.25, 0.5, 0.75, 1.0, 1.0];
        // The middle one of three points on a line is none.
        assert_eq!(curve(1, &knots, &polygon).corners(), [0.25, 0.75]);
        let double = [0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0];
        assert!(curve(2, &double, &polygon).corners().is_empty());
        let sharp = [
            (-0.5, 0.0),
            (-0.25, -0.5),
            (0.0, -1.0),
            (0.25, -0.5),
            (0.5, 0.0),
        ];
        assert_eq!(curve(2, &double, &sharp).corners(), [0.5]);
        let back = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (1.0, 0.0), (0.0, 0.0)];
        assert_eq!(curve(1, &knots, &back).corners(), [0.5]);
    }

    #[test]
    fn parts_between_creases_are_the_surface() {
        let sharp = [
            (-0.5, 0.0),
            (-0.25, -0.5),
            (0.0, -1.0),
            (0.25, -0.2),
            (0.5, 0.0),
        ];
        let double = [0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0];
        let one = curve(2, &double, &sharp);
        let sheet = Surface::ruled(&one, &one.moved(DVec3::new(0.1, 0.2, 7.0)))
            .unwrap()
            .transposed();
        let parts = sheet.smooth_parts_u();
        assert_eq!(parts.len(), 2);
        for (part, [from, to]) in parts.iter().zip([[0.0, 0.5], [0.5, 1.0]]) {
            assert_eq!(part.knots_u().domain(), (from, to));
            for i in 0..=10 {
                let (u, v) = (from + (to - from) * f64::from(i) / 10.0, 0.3);
                assert!(part.point(u, v).distance(sheet.point(u, v)) < 1e-15);
            }
        }
        assert_eq!(parts[0].smooth_parts_u(), [parts[0].clone()]);
    }
}

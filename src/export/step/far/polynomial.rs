//! Rational curves as polynomial ones of degree 5: pieces that have the curve's place and its first two derivatives at both ends,
//! halved until they are near enough. The error of a piece falls with the sixth power of its length.

use glam::DVec3;

use crate::nurbs::{Curve, KnotVector};

/// Degree of the pieces.
const DEGREE: usize = 5;
/// Halvings of a piece: far more than any arc needs.
const MOST_HALVINGS: u32 = 12;
/// Where a piece is compared with its curve, as fractions.
const COMPARED: [f64; 5] = [0.15, 0.35, 0.5, 0.65, 0.85];
/// First derivatives that differ by less than this share are the same.
const SAME: f64 = 1e-9;

/// A piece: its parameters and its control points.
struct Piece {
    range: [f64; 2],
    points: [DVec3; DEGREE + 1],
}

/// A polynomial curve of the same parameter within a distance of a rational one; the curve itself if none was found.
pub(super) fn polynomial(curve: &Curve, distance: f64) -> Curve {
    let mut pieces = Vec::new();
    for segment in curve.bezier_segments() {
        let (start, end) = segment.domain();
        fit(&segment, [start, end], distance, MOST_HALVINGS, &mut pieces);
    }
    joined(&pieces).unwrap_or_else(|| curve.clone())
}

fn fit(curve: &Curve, range: [f64; 2], distance: f64, halvings: u32, pieces: &mut Vec<Piece>) {
    let piece = Piece {
        range,
        points: control(curve, range),
    };
    let off = |s: &f64| {
        let u = range[0] + s * (range[1] - range[0]);
        piece.at(*s).distance(curve.point(u)) > distance
    };
    if halvings == 0 || !COMPARED.iter().any(off) {
        pieces.push(piece);
        return;
    }
    let middle = 0.5 * (range[0] + range[1]);
    fit(curve, [range[0], middle], distance, halvings - 1, pieces);
    fit(curve, [middle, range[1]], distance, halvings - 1, pieces);
}

/// Control points of the quintic that agrees with a curve to second order at both ends.
fn control(curve: &Curve, range: [f64; 2]) -> [DVec3; DEGREE + 1] {
    let length = range[1] - range[0];
    let [a, b] = range.map(|u| curve.derivatives(u, 2));
    let (h, k) = (length / 5.0, length * length / 20.0);
    [
        a[0],
        a[0] + h * a[1],
        a[0] + 2.0 * h * a[1] + k * a[2],
        b[0] - 2.0 * h * b[1] + k * b[2],
        b[0] - h * b[1],
        b[0],
    ]
}

impl Piece {
    /// The place at a fraction of its range (de Casteljau).
    fn at(&self, s: f64) -> DVec3 {
        let mut points = self.points;
        for left in (1..points.len()).rev() {
            for i in 0..left {
                points[i] = points[i].lerp(points[i + 1], s);
            }
        }
        points[0]
    }

    /// The first derivative at its first and its last place.
    fn slopes(&self) -> [DVec3; 2] {
        let length = self.range[1] - self.range[0];
        let p = &self.points;
        [p[1] - p[0], p[DEGREE] - p[DEGREE - 1]].map(|leg| leg * DEGREE as f64 / length)
    }
}

/// The pieces as one spline. Where slopes agree the point between two pieces follows from its neighbours, and is left out.
fn joined(pieces: &[Piece]) -> Option<Curve> {
    let (first, last) = (pieces.first()?, pieces.last()?);
    let mut knots = vec![first.range[0]; DEGREE + 1];
    let mut points = first.points.to_vec();
    for pair in pieces.windows(2) {
        let [before, after] = [pair[0].slopes()[1], pair[1].slopes()[0]];
        let smooth = before.distance(after) <= SAME * before.length();
        if smooth {
            points.pop();
        }
        let times = if smooth { DEGREE - 1 } else { DEGREE };
        knots.extend(std::iter::repeat_n(pair[1].range[0], times));
        points.extend(&pair[1].points[1..]);
    }
    knots.extend([last.range[1]; DEGREE + 1]);
    Curve::new(KnotVector::new(DEGREE, knots).ok()?, points).ok()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;

    /// The upper half of an ellipse about a place, as two rational quarters.
    fn half_ellipse(center: DVec3) -> Curve {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let knots = vec![0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0];
        let plan = [
            (40.0, 0.0),
            (40.0, 5.0),
            (0.0, 5.0),
            (-40.0, 5.0),
            (-40.0, 0.0),
        ];
        let points = plan.map(|(x, z)| center + DVec3::new(x, 0.0, z));
        let weights = vec![1.0, half, 1.0, half, 1.0];
        Curve::rational(KnotVector::new(2, knots).unwrap(), points.to_vec(), weights).unwrap()
    }

    #[test]
    fn a_half_ellipse_becomes_a_smooth_polynomial_at_equal_parameters() {
        let center = DVec3::new(3.0, -2.0, 1.0);
        let curve = half_ellipse(center);
        let found = polynomial(&curve, 1e-7);
        assert!(!found.is_rational());
        for i in 0..=1000 {
            let u = f64::from(i) / 1000.0;
            let point = found.point(u);
            assert!(point.distance(curve.point(u)) < 1.2e-7, "{u}");
            let on = (point - center) / DVec3::new(40.0, 1.0, 5.0);
            assert!((on.length() - 1.0).abs() < 1e-7, "{u}");
        }
        let inner = found.knots().distinct();
        assert!(inner.len() > 4 && inner.len() < 64);
        assert!(
            inner[1..inner.len() - 1]
                .iter()
                .all(|(_, times)| *times == 4)
        );
    }

    #[test]
    fn a_corner_stays_a_corner() {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let knots = vec![0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0];
        let points = [(0.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, 3.0), (3.0, 3.0)];
        let points = points.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
        let weights = vec![1.0, half, 1.0, half, 1.0];
        let curve = Curve::rational(KnotVector::new(2, knots).unwrap(), points, weights).unwrap();
        let found = polynomial(&curve, 1e-9);
        assert!((0..=1000).all(|i| {
            let u = f64::from(i) / 1000.0;
            found.point(u).distance(curve.point(u)) < 1.2e-9
        }));
        let corner = found
            .knots()
            .distinct()
            .into_iter()
            .find(|knot| knot.0 == 0.5);
        assert_eq!(corner.unwrap().1, 5);
    }
}

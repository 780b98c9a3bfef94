//! Sigmoidal slopes: one cubic Bézier curve from a height to a distance, steepest in its middle.

use glam::DVec2;

/// Why numbers make no sigmoidal slope.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SigmoidError {
    /// A length that is none.
    #[error("height {height} m and length {length} m must both be above 0")]
    Size {
        /// Height (m).
        height: f64,
        /// Length (m).
        length: f64,
    },
    /// The steepest dip is gentler than the straight line.
    #[error("the steepest gradient is {steepest:.4}, but the straight line's is {mean:.4} already")]
    TooGentle {
        /// The gradient that was asked for.
        steepest: f64,
        /// The straight line's.
        mean: f64,
    },
    /// The toe is no fraction.
    #[error("the toe is {0}: keep it at 0 or more and below 1")]
    Toe(f64),
}

/// Control points of the slope from (0, `height`) to (`length`, 0). Its gradient is `steepest` in the middle, and `toe` times
/// that of the straight line at both ends.
///
/// ```text
/// (0, H), (ℓ, H − τ H ℓ/L), (L − ℓ, τ H ℓ/L), (L, 0),   ℓ = (L g − H)/(g − τ H/L)
/// ```
pub fn sigmoid(
    height: f64,
    length: f64,
    steepest: f64,
    toe: f64,
) -> Result<[DVec2; 4], SigmoidError> {
    // Written so that numbers that are none fail too.
    if !(height > 0.0 && length > 0.0 && (height + length).is_finite()) {
        return Err(SigmoidError::Size { height, length });
    }
    let mean = height / length;
    if !(steepest >= mean && steepest.is_finite()) {
        return Err(SigmoidError::TooGentle { steepest, mean });
    }
    let is_straight = steepest == mean;
    if !(0.0..=1.0).contains(&toe) || (toe == 1.0 && !is_straight) {
        return Err(SigmoidError::Toe(toe));
    }
    let (run, drop) = if is_straight {
        (length / 3.0, height / 3.0)
    } else {
        let run = (length * steepest - height) / (steepest - toe * mean);
        (run, toe * mean * run)
    };
    Ok([
        DVec2::new(0.0, height),
        DVec2::new(run, height - drop),
        DVec2::new(length - run, drop),
        DVec2::new(length, 0.0),
    ])
}

/// The parameter at which a cubic Bézier curve whose y falls comes to a y; clamped to its ends.
pub(super) fn parameter_at(points: &[DVec2; 4], y: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    // To the last bit.
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if split(points, middle).0[3].y > y {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::midpoint(low, high)
}

/// The two parts of a cubic Bézier curve (de Casteljau).
pub(super) fn split([a, b, c, d]: &[DVec2; 4], u: f64) -> ([DVec2; 4], [DVec2; 4]) {
    let (ab, bc, cd) = (a.lerp(*b, u), b.lerp(*c, u), c.lerp(*d, u));
    let (abc, bcd) = (ab.lerp(bc, u), bc.lerp(cd, u));
    let middle = abc.lerp(bcd, u);
    ([*a, ab, abc, middle], [middle, bcd, cd, *d])
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

    use super::*;
    use crate::nurbs::{Curve, KnotVector};

    #[test]
    fn a_slope_is_steepest_in_its_middle_and_falls_as_steeply_as_asked() {
        let (height, length) = (20.0, 600.0);
        for (toe, steepest) in [
            (0.0, 0.05),
            (0.3, 0.1),
            (0.6, 0.2),
            (0.9, 0.04),
            (0.3, 1.0 / 30.0),
        ] {
            let points = sigmoid(height, length, steepest, toe).unwrap();
            let lifted = points.map(|p| p.extend(0.0)).to_vec();
            let curve = Curve::new(KnotVector::uniform(3, 4).unwrap(), lifted).unwrap();
            let gradient = |u: f64| {
                let d = curve.derivatives(u, 1)[1];
                -d.y / d.x
            };
            assert!((gradient(0.5) - steepest).abs() < 1e-12);
            let mut area = 0.0;
            for k in 0..1000 {
                let (a, b) = (f64::from(k) / 1000.0, f64::from(k + 1) / 1000.0);
                let (p, q) = (curve.point(a), curve.point(b));
                assert!(q.x > p.x && gradient(a) <= steepest * (1.0 + 1e-9));
                area += 0.5 * (p.y + q.y) * (q.x - p.x);
            }
            // Antisymmetric: half of the box.
            assert!((area - 0.5 * height * length).abs() < 1e-9 * area);
            if steepest > 1.01 * height / length {
                assert!((gradient(0.0) - toe * height / length).abs() < 1e-12);
            }
            let u = parameter_at(&points, 0.3 * height);
            assert!((curve.point(u).y - 0.3 * height).abs() < 1e-12);
            let (before, after) = split(&points, u);
            assert_eq!(before[3], after[0]);
            assert!((before[3] - curve.point(u).truncate()).length() < 1e-12);
        }
    }

    #[test]
    fn slopes_that_cannot_be_are_refused() {
        assert!(sigmoid(20.0, 600.0, 0.03, 0.3).is_err());
        assert!(sigmoid(0.0, 600.0, 0.1, 0.3).is_err());
        assert!(sigmoid(20.0, 600.0, f64::NAN, 0.3).is_err());
        assert!(sigmoid(20.0, 600.0, 0.1, -0.1).is_err());
        // As steep at its ends as in the mean, and steeper between: it would have to turn back.
        assert!(sigmoid(20.0, 600.0, 0.04, 1.0).is_err());
        assert!(sigmoid(20.0, 600.0, 20.0 / 600.0, 1.0).is_ok());
    }
}

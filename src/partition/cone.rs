//! Cones that hold directions.

use glam::DVec3;

/// A cone that holds some vectors: unit axis and sine of the half-angle. Vanishing vectors say nothing.
#[inline]
pub(super) fn cone(vectors: impl Iterator<Item = DVec3> + Clone) -> Option<(DVec3, f64)> {
    let sum = vectors.clone().fold(DVec3::ZERO, |sum, v| sum + v);
    let axis = sum.try_normalize()?;
    let mut square: f64 = 0.0;
    for v in vectors {
        let length_squared = v.length_squared();
        if length_squared == 0.0 {
            continue;
        }
        let along = v.dot(axis);
        if along <= 0.0 {
            return None;
        }
        square = square.max((v - along * axis).length_squared() / length_squared);
    }
    Some((axis, square.sqrt()))
}

/// A cone that holds the products of all vectors of two cones, if it fits a half-space.
///
/// Unit vectors of the cones are no farther from the axes than chords c and d are long; so their product is within
/// `c + d + c d` of the axes' product.
pub(super) fn product((a, alpha): (DVec3, f64), (b, beta): (DVec3, f64)) -> Option<(DVec3, f64)> {
    let cross = a.cross(b);
    let gamma = cross.length();
    let (c, d) = (chord(alpha), chord(beta));
    let lean = (c + d + c * d) / gamma;
    (gamma > 1e-6 && lean < 1.0).then(|| (cross / gamma, lean))
}

/// The distance of unit vectors that have an angle with this sine between them.
fn chord(sine: f64) -> f64 {
    let cosine = (1.0 - sine * sine).max(0.0).sqrt();
    sine * (2.0 / (1.0 + cosine)).sqrt()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;

    /// Unit vectors that make an angle with an axis, all around it.
    fn around(axis: DVec3, angle: f64) -> impl Iterator<Item = DVec3> {
        let (e, f) = axis.any_orthonormal_pair();
        (0..24).map(move |k| {
            let (sin, cos) = (f64::from(k) * 15f64.to_radians()).sin_cos();
            angle.cos() * axis + angle.sin() * (cos * e + sin * f)
        })
    }

    #[test]
    fn products_of_vectors_of_two_cones_lie_in_the_cone_of_their_products() {
        for turn in [0.4f64, 0.9, 1.5] {
            let (a, b) = (DVec3::X, DVec3::new(turn.cos(), turn.sin(), 0.0));
            let mut is_wide: f64 = 0.0;
            for (alpha, beta) in [(0.1f64, 0.05f64), (0.2, 0.2), (0.4, 0.0), (0.45, 0.35)] {
                let Some((axis, lean)) = product((a, alpha.sin()), (b, beta.sin())) else {
                    continue;
                };
                let pairs = around(a, alpha).flat_map(|u| around(b, beta).map(move |v| (u, v)));
                let most = pairs
                    .map(|(u, v)| u.cross(v).normalize())
                    .map(|n| {
                        assert!(n.dot(axis) > 0.0);
                        n.cross(axis).length()
                    })
                    .fold(0.0, f64::max);
                assert!(most <= lean, "{turn} {alpha} {beta}: {most} > {lean}");
                is_wide = is_wide.max(most / lean);
            }
            assert!(is_wide > 0.5, "{turn}: {is_wide}");
        }
    }
}

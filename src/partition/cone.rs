//! Cones that hold directions.

use glam::DVec3;

/// A cone that holds some vectors: unit axis and sine of the half-angle. Vanishing vectors say nothing.
pub(super) fn cone(vectors: &[DVec3]) -> Option<(DVec3, f64)> {
    let sum = vectors.iter().fold(DVec3::ZERO, |sum, v| sum + *v);
    let axis = sum.try_normalize()?;
    let mut square: f64 = 0.0;
    for &v in vectors {
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

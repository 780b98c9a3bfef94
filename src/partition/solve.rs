//! Small linear systems.

/// Solves a dense system by elimination with partial pivoting; `None` if a pivot vanishes against its row's scale.
pub(super) fn solve<const N: usize>(
    mut matrix: [[f64; N]; N],
    mut right: [f64; N],
) -> Option<[f64; N]> {
    const SINGULAR: f64 = 1e-14;
    let scale = matrix
        .as_flattened()
        .iter()
        .fold(0.0_f64, |most, x| most.max(x.abs()));
    for i in 0..N {
        let pivot = (i..N).fold(i, |best, r| {
            if matrix[r][i].abs() > matrix[best][i].abs() {
                r
            } else {
                best
            }
        });
        // NaN must fail too.
        if !(matrix[pivot][i].abs() > SINGULAR * scale) {
            return None;
        }
        matrix.swap(i, pivot);
        right.swap(i, pivot);
        for r in i + 1..N {
            let factor = matrix[r][i] / matrix[i][i];
            if factor != 0.0 {
                let pivot_row = matrix[i];
                for (entry, above) in matrix[r][i..].iter_mut().zip(&pivot_row[i..]) {
                    *entry -= factor * above;
                }
                right[r] -= factor * right[i];
            }
        }
    }
    for i in (0..N).rev() {
        let known: f64 = (i + 1..N).map(|k| matrix[i][k] * right[k]).sum();
        right[i] = (right[i] - known) / matrix[i][i];
    }
    Some(right)
}

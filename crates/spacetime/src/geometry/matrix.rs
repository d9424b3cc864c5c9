//! Small symmetric matrices.

use crate::scalar::Scalar;

/// The inverse of a matrix, by Gauss and Jordan's elimination with the largest pivot of each column. A singular matrix
/// gives numbers that are not finite. Of a bundle of numbers, the first lane chooses the pivots.
pub fn invert<S: Scalar, const N: usize>(matrix: &[[S; N]; N]) -> [[S; N]; N] {
    let (mut left, mut right) = (*matrix, *matrix);
    for (i, row) in right.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            *entry = matrix[0][0].constant(if i == j { 1.0 } else { 0.0 });
        }
    }
    for column in 0..N {
        let mut pivot = column;
        for row in column + 1..N {
            if left[row][column].lane(0).abs() > left[pivot][column].lane(0).abs() {
                pivot = row;
            }
        }
        left.swap(column, pivot);
        right.swap(column, pivot);
        let scale = left[column][column].recip();
        for j in 0..N {
            left[column][j] *= scale;
            right[column][j] *= scale;
        }
        for row in 0..N {
            // A factor that is exactly zero, with no derivative, would only bring NaN from infinite entries.
            if row == column || is_nothing(left[row][column]) {
                continue;
            }
            let factor = left[row][column];
            for j in 0..N {
                let (down, across) = (left[column][j] * factor, right[column][j] * factor);
                left[row][j] -= down;
                right[row][j] -= across;
            }
        }
    }
    right
}

/// Whether a number without derivatives is zero; one with derivatives never counts as nothing.
fn is_nothing<S: Scalar>(number: S) -> bool {
    S::ORDER == 0 && S::LANES == 1 && number.lane(0) == 0.0
}

/// The eigenvalues of a symmetric matrix, in no order, by Jacobi's rotations.
pub fn eigenvalues<const N: usize>(matrix: &[[f64; N]; N]) -> [f64; N] {
    let mut a = *matrix;
    for _ in 0..50 {
        let mut rest = 0.0;
        for p in 0..N {
            for q in p + 1..N {
                rest += a[p][q] * a[p][q];
                if a[p][q] == 0.0 {
                    continue;
                }
                // The angle that takes a[p][q] away: tan 2φ = 2a_pq/(a_qq − a_pp).
                let cot = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
                let tan = cot.signum() / (cot.abs() + cot.hypot(1.0));
                let cos = 1.0 / tan.hypot(1.0);
                let sin = tan * cos;
                for k in 0..N {
                    let (x, y) = (a[k][p], a[k][q]);
                    (a[k][p], a[k][q]) = (cos * x - sin * y, sin * x + cos * y);
                }
                for k in 0..N {
                    let (x, y) = (a[p][k], a[q][k]);
                    (a[p][k], a[q][k]) = (cos * x - sin * y, sin * x + cos * y);
                }
            }
        }
        if !(rest > 0.0) {
            break;
        }
    }
    std::array::from_fn(|i| a[i][i])
}

/// The solution x of A x = b.
pub(super) fn solve<const N: usize>(a: &[[f64; N]; N], b: &[f64; N]) -> [f64; N] {
    let inverse = invert(a);
    std::array::from_fn(|i| (0..N).map(|j| inverse[i][j] * b[j]).sum())
}

/// T_{μν} aᵘ bᵛ.
pub(super) fn product<const N: usize>(t: &[[f64; N]; N], a: &[f64; N], b: &[f64; N]) -> f64 {
    (0..N).map(|i| a[i] * (0..N).map(|j| t[i][j] * b[j]).sum::<f64>()).sum()
}

/// T_{μν} vᵛ.
pub(super) fn apply<S: Scalar, const N: usize>(t: &[[S; N]; N], v: &[S; N]) -> [S; N] {
    let mut result = *v;
    for i in 0..N {
        let mut sum = t[i][0] * v[0];
        for j in 1..N {
            sum += t[i][j] * v[j];
        }
        result[i] = sum;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Dual;

    const M: [[f64; 4]; 4] =
        [[0.0, 2.0, 0.5, 0.0], [2.0, 3.0, -1.0, 0.2], [0.5, -1.0, 4.0, 1.0], [0.0, 0.2, 1.0, -2.0]];

    #[test]
    fn an_inverse_needs_its_pivots() {
        let inverse = invert(&M);
        for i in 0..4 {
            for j in 0..4 {
                let sum: f64 = (0..4).map(|k| M[i][k] * inverse[k][j]).sum();
                assert!((sum - f64::from(u8::from(i == j))).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn an_inverse_has_derivatives() {
        // d(M⁻¹) = −M⁻¹ dM M⁻¹, with dM one at (2, 3) and (3, 2).
        let mut m = M.map(|row| row.map(Dual::<f64, 1>::fixed));
        (m[2][3].gradient, m[3][2].gradient) = ([1.0], [1.0]);
        let (inverse, plain) = (invert(&m), invert(&M));
        for i in 0..4 {
            for j in 0..4 {
                let expected = -(plain[i][2] * plain[3][j] + plain[i][3] * plain[2][j]);
                assert!((inverse[i][j].gradient[0] - expected).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn eigenvalues_have_the_trace_and_the_square() {
        let e = eigenvalues(&M);
        let (sum, square): (f64, f64) = (e.iter().sum(), e.iter().map(|x| x * x).sum());
        let (trace, norm): (f64, f64) =
            ((0..4).map(|i| M[i][i]).sum(), M.iter().flatten().map(|x| x * x).sum());
        assert!((sum - trace).abs() < 1e-13 && (square - norm).abs() < 1e-12);
        assert_eq!(e.iter().filter(|x| **x < 0.0).count(), 2);
    }
}

//! Connection coefficients (Christoffel symbols).

use super::{Geometry, matrix};
use crate::dual::Dual;
use crate::scalar::Scalar;

/// Γ^μ_{στ} = ½ g^{μα}(∂_σ g_{τα} + ∂_τ g_{ασ} − ∂_α g_{στ}) at x, as `[μ][σ][τ]`.
///
/// The derivatives are exact: what errs is rounding, and the inverse by rounding times the metric's condition number.
pub fn connection<G: Geometry<N>, S: Scalar, const N: usize>(geometry: &G, x: &[S; N]) -> [[[S; N]; N]; N] {
    let g = geometry.metric(&Dual::variables(*x));
    let inverse = matrix::invert(&g.map(|row| row.map(|c| c.value)));
    let lowered = first_kind(&g);
    let mut gamma = lowered;
    for s in 0..N {
        for t in 0..N {
            for m in 0..N {
                let mut sum = inverse[m][0] * lowered[0][s][t];
                for a in 1..N {
                    sum += inverse[m][a] * lowered[a][s][t];
                }
                gamma[m][s][t] = sum;
            }
        }
    }
    gamma
}

/// Γ_{αστ} = ½(∂_σ g_{τα} + ∂_τ g_{ασ} − ∂_α g_{στ}), as `[α][σ][τ]`.
pub(super) fn first_kind<S: Scalar, const N: usize>(g: &[[Dual<S, N>; N]; N]) -> [[[S; N]; N]; N] {
    let mut gamma = [[[g[0][0].value; N]; N]; N];
    for a in 0..N {
        for s in 0..N {
            for t in 0..N {
                gamma[a][s][t] = (g[t][a].gradient[s] + g[a][s].gradient[t] - g[s][t].gradient[a]) * 0.5;
            }
        }
    }
    gamma
}

/// The geodesic equations at a place and a velocity: ẍ^μ = −Γ^μ_{στ} ẋ^σ ẋ^τ.
pub fn acceleration<G: Geometry<N>, const N: usize>(geometry: &G, x: &[f64; N], v: &[f64; N]) -> [f64; N] {
    connection(geometry, x).map(|gamma| -matrix::product(&gamma, v, v))
}

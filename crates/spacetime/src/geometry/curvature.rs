//! Curvature tensors.

use super::connection::first_kind;
use super::{Geometry, matrix};
use crate::dual::Dual;

/// The curvature at a point. Indices are down unless said otherwise; units are M⁻² and M⁻⁴ for squares.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curvature<const N: usize> {
    /// R_{ρσμν}, antisymmetric in ρσ and in μν.
    pub riemann: [[[[f64; N]; N]; N]; N],
    /// R_{σν} = g^{ρμ} R_{ρσμν}.
    pub ricci: [[f64; N]; N],
    /// R = g^{σν} R_{σν}.
    pub scalar: f64,
    /// G_{σν} = R_{σν} − ½ R g_{σν}: 8π times the energy and momentum that such a geometry needs.
    pub einstein: [[f64; N]; N],
    /// R_{ρσμν} R^{ρσμν}.
    pub kretschmann: f64,
    /// g^{μν}.
    pub inverse: [[f64; N]; N],
}

impl<const N: usize> Curvature<N> {
    /// The curvature at x, from first and second derivatives of the metric, both exact:
    ///   R_{ρσμν} = ½(∂_σ∂_μ g_{ρν} + ∂_ρ∂_ν g_{σμ} − ∂_ρ∂_μ g_{σν} − ∂_σ∂_ν g_{ρμ})
    ///            + g_{αβ}(Γ^α_{σμ} Γ^β_{ρν} − Γ^α_{σν} Γ^β_{ρμ})
    /// (Misner, Thorne & Wheeler 1973, exercise 14.17 and eq. 14.18; no derivative of the inverse is needed).
    pub fn of<G: Geometry<N>>(geometry: &G, x: &[f64; N]) -> Self {
        let twice = geometry.metric(&Dual::variables(Dual::variables(*x)));
        let once = twice.map(|row| row.map(|c| c.value));
        let g = once.map(|row| row.map(|c| c.value));
        let inverse = matrix::invert(&g);
        // ∂_i ∂_j g_{mn}
        let second = |m: usize, n: usize, i: usize, j: usize| twice[m][n].gradient[i].gradient[j];
        let lowered = first_kind(&once);
        // g_{αβ} Γ^α_{ab} Γ^β_{cd} = g^{αβ} Γ_{αab} Γ_{βcd}
        let mut raised = lowered;
        for s in 0..N {
            for t in 0..N {
                for m in 0..N {
                    raised[m][s][t] = (0..N).map(|a| inverse[m][a] * lowered[a][s][t]).sum();
                }
            }
        }
        let square = |a: usize, b: usize, c: usize, d: usize| -> f64 {
            (0..N).map(|m| raised[m][a][b] * lowered[m][c][d]).sum()
        };
        let mut riemann = [[[[0.0; N]; N]; N]; N];
        for r in 0..N {
            for s in 0..N {
                for m in 0..N {
                    for n in 0..N {
                        let bent =
                            second(r, n, s, m) + second(s, m, r, n) - second(s, n, r, m) - second(r, m, s, n);
                        riemann[r][s][m][n] = 0.5 * bent + square(s, m, r, n) - square(s, n, r, m);
                    }
                }
            }
        }
        Self::from_riemann(riemann, &g, inverse)
    }

    fn from_riemann(riemann: [[[[f64; N]; N]; N]; N], g: &[[f64; N]; N], inverse: [[f64; N]; N]) -> Self {
        let mut ricci = [[0.0; N]; N];
        for s in 0..N {
            for n in 0..N {
                for r in 0..N {
                    ricci[s][n] += (0..N).map(|m| inverse[r][m] * riemann[r][s][m][n]).sum::<f64>();
                }
            }
        }
        let scalar: f64 =
            (0..N).flat_map(|s| (0..N).map(move |n| (s, n))).map(|(s, n)| inverse[s][n] * ricci[s][n]).sum();
        let mut einstein = ricci;
        for s in 0..N {
            for n in 0..N {
                einstein[s][n] -= 0.5 * scalar * g[s][n];
            }
        }
        // R^{ab}_{mn} = g^{ar} g^{bs} R_{rsmn}, an index at a time.
        let mut half = [[[[0.0; N]; N]; N]; N];
        let mut mixed = half;
        for a in 0..N {
            for b in 0..N {
                for m in 0..N {
                    for n in 0..N {
                        half[a][b][m][n] = (0..N).map(|r| inverse[a][r] * riemann[r][b][m][n]).sum();
                    }
                }
            }
        }
        for a in 0..N {
            for b in 0..N {
                for m in 0..N {
                    for n in 0..N {
                        mixed[a][b][m][n] = (0..N).map(|s| inverse[b][s] * half[a][s][m][n]).sum();
                    }
                }
            }
        }
        let mut kretschmann = 0.0;
        for a in 0..N {
            for b in 0..N {
                for m in 0..N {
                    for n in 0..N {
                        kretschmann += mixed[a][b][m][n] * mixed[m][n][a][b];
                    }
                }
            }
        }
        Self { riemann, ricci, scalar, einstein, kretschmann, inverse }
    }

    /// R^ρ_{σμν}.
    pub fn riemann_up(&self) -> [[[[f64; N]; N]; N]; N] {
        let mut up = self.riemann;
        for r in 0..N {
            for s in 0..N {
                for m in 0..N {
                    for n in 0..N {
                        up[r][s][m][n] = (0..N).map(|a| self.inverse[r][a] * self.riemann[a][s][m][n]).sum();
                    }
                }
            }
        }
        up
    }

    /// The largest |R^μ_ν|, by which a vacuum is judged; M⁻².
    pub fn matter(&self) -> f64 {
        let mut largest = 0.0_f64;
        for m in 0..N {
            for n in 0..N {
                let mixed: f64 = (0..N).map(|a| self.inverse[m][a] * self.ricci[a][n]).sum();
                largest = largest.max(mixed.abs());
            }
        }
        largest
    }
}

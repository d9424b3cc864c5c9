//! What is conserved along light's geodesics in Kerr.

use crate::metric::{Inverted, scaled_radius};
use crate::scalar::Scalar;

/// What is conserved along a photon's geodesic in Kerr, per unit energy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conserved {
    /// λ = L/E of the physical photon, about +z.
    pub lambda: f64,
    /// η = Q/E², Q Carter's constant.
    pub eta: f64,
}

/// Carter's constant of a photon in a hole of spin s, without singularities on the axis:
///   Q = J_x² + J_y² + s²[cos²θ (p_x² + p_y² − E²) − sin²θ p_z²],   cos θ = n_z/r̂.
///
/// From Q = p_θ² + cos²θ (L²/sin²θ − s²E²) with p_θ = (x p_x + y p_y) cot θ − r sin θ p_z.
#[inline(always)]
pub(crate) fn carter<S: Scalar>(spin: S, energy: S, state: &Inverted<S>) -> S {
    let p = state.momentum();
    let s2 = spin * spin;
    let cos = state.n[2] / scaled_radius(spin, state);
    let cos2 = cos * cos;
    let [jx, jy, _] = state.j;
    let flat = p[0].mul_add(p[0], p[1] * p[1]) - energy * energy;
    jx * jx + jy * jy + s2 * (cos2 * flat - (-cos2 + 1.0) * p[2] * p[2])
}

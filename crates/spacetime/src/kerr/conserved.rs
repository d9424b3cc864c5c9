//! What is conserved along light's geodesics in Kerr.

use crate::metric::{Inverted, Kerr, Metric};

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
pub(crate) fn carter(spin: f64, energy: f64, state: &Inverted<f64>) -> f64 {
    let p = state.momentum();
    let s2 = spin * spin;
    let cos = state.n[2] * inverse_scaled_radius(spin, state);
    let cos2 = cos * cos;
    let [jx, jy, _] = state.j;
    jx * jx
        + jy * jy
        + s2 * (cos2 * (p[0] * p[0] + p[1] * p[1] - energy * energy) - (1.0 - cos2) * p[2] * p[2])
}

/// 1/(w r), finite at infinity.
fn inverse_scaled_radius(spin: f64, state: &Inverted<f64>) -> f64 {
    Kerr::new(state.w * spin).inverse_radius(1.0, &state.n)
}

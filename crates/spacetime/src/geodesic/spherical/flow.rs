//! Hamilton's equations in spherical coordinates.
//!
//! H = ½ g^{μν} p_μ p_ν with p_t = −E and p_φ = L constant: ẋ^μ = g^{μν} p_ν, ṗ_i = ½ ∂_i g_{μν} ẋ^μ ẋ^ν for i = r, θ.
//! With error control the state holds u = 1/r and the parameter is σ, dσ = u² dλ, in which the equations are regular
//! at u = 0; with constant steps, as the thesis has them, it holds r and the parameter is the affine λ.

use super::super::flow::Flow;
use crate::dual::Dual;
use crate::geometry::{Geometry, invert};
use crate::tensor::Tensor;

/// The components of a state: u or r, θ, φ, p_r, p_θ, t.
pub const WIDTH: usize = 6;

/// Photons of given constants, in a geometry with coordinates (t, r, θ, φ) on whose t and φ nothing depends.
#[derive(Clone, Copy, Debug)]
pub struct SphericalFlow<G> {
    /// The spacetime.
    pub geometry: G,
    /// E = −p_t.
    pub energy: f64,
    /// L = p_φ.
    pub momentum: f64,
    /// Whether the state holds 1/r.
    pub inverted: bool,
    /// Whether errors of time count.
    pub timed: bool,
}

/// 1/r below which the equations, regular at infinity, are extrapolated: rounding in them grows as r².
const NEAR_INFINITY: f64 = 1e-4;

impl<G: Geometry<4>> SphericalFlow<G> {
    /// r of a state.
    pub fn radius(&self, y: &[f64; WIDTH]) -> f64 {
        if self.inverted { y[0].recip() } else { y[0] }
    }

    /// g^{μν}p_μp_ν at a state.
    pub fn norm(&self, y: &[f64; WIDTH]) -> f64 {
        let inverse = invert(&self.geometry.metric(&[0.0, self.radius(y), y[1], 0.0]));
        let p = [-self.energy, y[3], y[4], self.momentum];
        (0..4).map(|m| p[m] * (0..4).map(|n| inverse[m][n] * p[n]).sum::<f64>()).sum()
    }

    /// √(p_θ² + L²/sin²θ): the turning of a free photon in σ.
    pub fn turning(&self, y: &[f64; WIDTH]) -> f64 {
        let sin = y[1].sin();
        let round = if self.momentum == 0.0 { 0.0 } else { self.momentum / sin };
        y[4].hypot(round)
    }

    /// The slope at r, in the affine parameter if `square` is 1 and in σ if it is r².
    fn rate(&self, y: &[f64; WIDTH], r: f64, square: f64) -> [f64; WIDTH] {
        let fixed = |value| Dual::<f64, 2>::fixed(value);
        let place = [r, y[1]];
        let x = [fixed(0.0), Dual::variable(place, 0), Dual::variable(place, 1), fixed(0.0)];
        let g: Tensor<Dual<f64, 2>> = self.geometry.metric(&x);
        let inverse = invert(&g.map(|row| row.map(|c| c.value)));
        let p = [-self.energy, y[3], y[4], self.momentum];
        let mut v = [0.0; 4];
        for m in 0..4 {
            v[m] = inverse[m][0] * p[0] + inverse[m][1] * p[1] + inverse[m][2] * p[2] + inverse[m][3] * p[3];
        }
        let mut force = [0.0; 2];
        for m in 0..4 {
            for n in m..4 {
                let weight = v[m] * v[n] * if m == n { 0.5 } else { 1.0 };
                force[0] += weight * g[m][n].gradient[0];
                force[1] += weight * g[m][n].gradient[1];
            }
        }
        // u′ = −u² r′
        let outwards = if self.inverted { -v[1] } else { v[1] };
        [outwards, square * v[2], square * v[3], square * force[0], square * force[1], square * v[0]]
    }
}

impl<G: Geometry<4>> Flow<f64, WIDTH> for SphericalFlow<G> {
    #[inline(never)]
    fn derivative(&self, y: &[f64; WIDTH]) -> [f64; WIDTH] {
        if !self.inverted {
            return self.rate(y, y[0], 1.0);
        }
        let at = |u: f64| self.rate(y, u.recip(), (u * u).recip());
        let u = y[0];
        if u >= NEAR_INFINITY {
            return at(u);
        }
        let (near, far) = (at(NEAR_INFINITY), at(2.0 * NEAR_INFINITY));
        let share = u / NEAR_INFINITY - 1.0;
        let mut slope: [f64; WIDTH] = std::array::from_fn(|i| near[i] + share * (far[i] - near[i]));
        // ṫ = E(1 + 2/r + 4/r² + …), which σ makes infinite at infinity: no time has meaning from there.
        let r = if u > 0.0 { u.recip() } else { 0.0 };
        slope[5] = self.energy * (r * r + 2.0 * r + 4.0);
        slope
    }

    /// Angles count by themselves; u against itself and 1/b, the inverse distance of closest approach in flat space;
    /// p_r against itself and the energy; p_θ against the whole angular momentum; t, if at all, against itself and 1.
    fn inverse_scale(&self, y: &[f64; WIDTH]) -> [f64; WIDTH] {
        let energy = self.energy.abs();
        let whole = self.turning(y) + energy;
        let of_t = if self.timed { (1.0 + y[5].abs()).recip() } else { 0.0 };
        [(y[0].abs() + energy / whole).recip(), 1.0, 1.0, (y[3].abs() + energy).recip(), whole.recip(), of_t]
    }
}

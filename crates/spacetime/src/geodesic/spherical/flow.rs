//! Hamilton's equations in spherical coordinates.
//!
//! H = ½ g^{μν} p_μ p_ν with p_t = −E and p_φ = L constant: ẋ^μ = g^{μν} p_ν, ṗ_i = ½ ∂_i g_{μν} ẋ^μ ẋ^ν for i = r, θ.
//! With error control the state holds u = 1/r and the parameter is σ, dσ = u² dλ, in which the equations are regular
//! at u = 0; with constant steps, as the thesis has them, it holds r and the parameter is the affine λ.
//!
//! Elapsed time t is kept as T = E t − r p_r + 2p_r(1 − 2u) ln u, which is regular at infinity both ways: there
//! t = ∓(r + 2 ln r) and p_r = ∓E(1 + 2u + …). Since E ṫ = ṙp_r + θ̇p_θ + φ̇L for light,
//!   T′ = θ′p_θ + φ′L − r p_r′ + 2(p_r′(1 − 2u) − 2p_r u′) ln u + 2p_r(1 − 2u) u′/u.

use super::super::flow::Flow;
use crate::dual::Dual;
use crate::geometry::{Geometry, invert};
use crate::tensor::Tensor;

/// The components of a state: u or r, θ, φ, p_r, p_θ, T.
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

    /// r p_r − 2p_r(1 − 2u) ln u = E t − T; at infinity, where r + 2 ln(r/2) is taken off an incoming photon's time,
    /// −2E(1 + ln 2).
    fn lag(&self, y: &[f64; WIDTH]) -> f64 {
        let u = self.radius(y).recip();
        if u > 0.0 {
            y[3] / u - 2.0 * y[3] * (1.0 - 2.0 * u) * u.ln()
        } else {
            -2.0 * self.energy * (1.0 + 2f64.ln())
        }
    }

    /// T at the start of a ray.
    pub fn start_time(&self, y: &[f64; WIDTH]) -> f64 {
        -self.lag(y)
    }

    /// t since the start of the ray.
    pub fn elapsed(&self, y: &[f64; WIDTH]) -> f64 {
        (y[5] + self.lag(y)) / self.energy
    }

    /// g^{μν}p_μp_ν at a state.
    pub fn norm(&self, y: &[f64; WIDTH]) -> f64 {
        let inverse = invert(&self.geometry.metric(&[0.0, self.radius(y), y[1], 0.0]));
        let p = [-self.energy, y[3], y[4], self.momentum];
        (0..4).map(|m| p[m] * (0..4).map(|n| inverse[m][n] * p[n]).sum::<f64>()).sum()
    }

    /// The p_r, of the sign that it has, that makes light of a state at u.
    fn radial_momentum(&self, y: &[f64; WIDTH], u: f64) -> f64 {
        let inverse = invert(&self.geometry.metric(&[0.0, u.recip(), y[1], 0.0]));
        let p = [-self.energy, 0.0, y[4], self.momentum];
        let rest: f64 = (0..4).map(|m| p[m] * (0..4).map(|n| inverse[m][n] * p[n]).sum::<f64>()).sum();
        (-rest / inverse[1][1]).max(0.0).sqrt().copysign(y[3])
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
        let (u, du) = (r.recip(), -square * v[1] / (r * r));
        let [turn, round, pull] = [square * v[2], square * v[3], square * force[0]];
        let time = turn * y[4] + round * self.momentum - r * pull
            + 2.0 * (pull * (1.0 - 2.0 * u) - 2.0 * y[3] * du) * u.ln()
            + 2.0 * y[3] * (1.0 - 2.0 * u) * du / u;
        [outwards, turn, round, pull, square * force[1], time]
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
        // T′ is regular for light only, whose p_r belongs to its u.
        let edge = |u: f64| {
            let mut light = *y;
            light[3] = self.radial_momentum(y, u);
            let time = self.rate(&light, u.recip(), (u * u).recip())[5];
            let mut slope = at(u);
            slope[5] = time;
            slope
        };
        let (near, far) = (edge(NEAR_INFINITY), edge(2.0 * NEAR_INFINITY));
        let share = u / NEAR_INFINITY - 1.0;
        std::array::from_fn(|i| near[i] + share * (far[i] - near[i]))
    }

    /// Angles count by themselves; u against itself and 1/b, the inverse distance of closest approach in flat space;
    /// p_r against itself and the energy; p_θ against the whole angular momentum; T, if at all, against itself and 1.
    fn inverse_scale(&self, y: &[f64; WIDTH]) -> [f64; WIDTH] {
        let energy = self.energy.abs();
        let whole = self.turning(y) + energy;
        let of_t = if self.timed { (1.0 + y[5].abs()).recip() } else { 0.0 };
        [(y[0].abs() + energy / whole).recip(), 1.0, 1.0, (y[3].abs() + energy).recip(), whole.recip(), of_t]
    }
}

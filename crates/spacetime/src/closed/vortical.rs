//! The motion of a photon in θ that never meets the equatorial plane (η < 0).
//!
//! w± are the bounds of μ² (Kapec & Lupsasca 2020, arXiv:1905.11406):
//!   w₊ = (B + √(B² + 4s²η))/(2s²),   w₋ = −η/(s²w₊),   μ = ±√w₊ dn(x₀ + |s|√w₊ τ | 1 − w₋/w₊).
//! The same oscillation about the mean of μ² is a pendulum's: with
//!   μ² = w₊ − (w₊ − w₋) sin²χ,   χ′ = |s| |μ|,
//! χ grows for ever. Since s²(1 − w₊)(1 − w₋) = λ² the azimuth is the sum of a part known in closed form, safe at
//! the pole, and of the quadrature of a smooth periodic function:
//!   λ∫dτ/(1 − μ²) = sgn λ [𝒜(χ) − 𝒜(χ₀)] + (λ/|s|) ∫dχ/(|μ|(1 + |μ|)),
//!   𝒜(χ) = nπ + atan2(|s|(1 − w₋) sin(χ − nπ), |λ| cos(χ − nπ)),   n = round(χ/π).

use std::f64::consts::PI;

use super::photon::{Photon, Potential};
use super::quadrature::Nodes;
use crate::scalar::Scalar;

/// The motion of a vortical photon.
#[derive(Clone, Copy, Debug)]
pub struct Vortex<S> {
    /// |s|.
    spin: S,
    /// |λ|, and λ's sign.
    lambda: [S; 2],
    /// w₊ and w₊ − w₋.
    upper: S,
    range: S,
    /// 1 − w₋.
    wide: S,
    /// μ's sign.
    hemisphere: S,
    /// χ₀ and 𝒜(χ₀).
    start: [S; 2],
}

/// −1 where x is negative, else 1.
#[inline(always)]
fn sign<S: Scalar>(x: S) -> S {
    S::select(x.less(x.constant(0.0)), x.constant(-1.0), x.constant(1.0))
}

impl<S: Scalar> Vortex<S> {
    /// The motion of a photon with η < 0 that sets out along `heading`: λ and μ′ but for a positive factor.
    pub fn new(photon: &Photon<S>, heading: [S; 2]) -> Self {
        let Photon { lambda, eta, mu, mu_rate, .. } = *photon;
        let zero = mu.constant(0.0);
        let b = Potential::new(photon).b;
        let spin = photon.spin.abs();
        let s2 = spin * spin;
        let (hemisphere, turn) = (sign(mu), sign(heading[0]));
        // (w₊ − w₋) sin 2χ = −2μ′ sgn μ/|s|, since d(μ²)/dτ = −(w₊ − w₋) sin 2χ χ′; (w₊ − w₋) cos 2χ = 2μ² − B/s².
        let rise = hemisphere * mu_rate * spin * -2.0;
        let level = mu * mu * s2 * 2.0 - b;
        let chi = rise.atan2(level) * 0.5;
        // √(B² + 4s²η) without cancellation.
        let root = (rise * rise + level * level).sqrt();
        let per_s2 = s2.recip();
        let upper = (b + root) * per_s2 * 0.5;
        let lower = -eta * per_s2 / upper;
        // Light straight along the axis has none.
        let wide = (-lower + 1.0).max(zero.constant(f64::MIN_POSITIVE));
        // 𝒜(χ₀) without digits lost next to the pole, or away from it.
        let steep = -(hemisphere * heading[1] * wide);
        let flat = heading[0] * turn * (mu * mu - lower);
        let (sin, cos) = chi.sin_cos();
        let near = zero.less(level);
        let steep = S::select(near, steep, spin * wide * sin);
        let flat = S::select(near, flat, lambda * turn * cos);
        Self {
            spin,
            lambda: [lambda * turn, turn],
            upper,
            range: root * per_s2,
            wide,
            hemisphere,
            start: [chi, steep.atan2(flat)],
        }
    }

    /// |μ|.
    #[inline(always)]
    fn height(&self, chi: S) -> S {
        let sin = chi.sin_cos().0;
        (self.upper - self.range * sin * sin).sqrt()
    }

    /// ∫dχ/(|s||μ|) and |λ/s| ∫dχ/(|μ|(1 + |μ|)) from the start.
    fn integrals(&self, to: S, nodes: &Nodes) -> [S; 2] {
        let [from, _] = self.start;
        // Panels of a quarter of a period.
        let panels = (0..S::LANES).map(|lane| ((to - from).lane(lane).abs() / (0.25 * PI)).ceil());
        let panels = panels.fold(1.0, f64::max).min(1e4);
        let half = (to - from) * (0.5 / panels);
        let zero = to.constant(0.0);
        let mut sums = [zero; 2];
        for panel in 0..panels as usize {
            let middle = from + half * (2 * panel + 1) as f64;
            for &(x, w) in nodes.half() {
                for x in [x, -x] {
                    let height = self.height(middle + half * x);
                    let share = (height * (height + 1.0)).recip() * w;
                    sums[0] += share * (height + 1.0);
                    sums[1] += share;
                }
            }
        }
        let scale = half / self.spin;
        [sums[0] * scale, sums[1] * scale * self.lambda[0]]
    }

    /// θ and azimuth after Mino time τ.
    pub fn at(&self, tau: S, nodes: &Nodes) -> [S; 2] {
        let still = self.still();
        let goal = tau.still();
        let mut chi = still.start[0] + goal * still.spin * still.upper.sqrt();
        for _ in 0..40 {
            let step = (still.integrals(chi, nodes)[0] - goal) * still.spin * still.height(chi);
            chi -= step;
            if S::LANES == 1 && !S::any(chi.abs().max(chi.constant(1.0)).less(step.abs() * 1e14)) {
                break;
            }
        }
        // The last step, which gives derivatives.
        let [reached, smooth] = self.integrals(chi, nodes);
        let rest = tau - reached;
        let height = self.height(chi);
        let chi = chi + rest * self.spin * height;
        let smooth = smooth + rest * self.lambda[0] / (height + 1.0);
        let height = self.height(chi);
        let ([lambda, turn], half_turns) = (self.lambda, (chi * (1.0 / PI)).round());
        let (sin, cos) = (half_turns.mul_add(chi.constant(-PI), chi)).sin_cos();
        let passed = (self.spin * self.wide * sin).atan2(lambda * cos);
        let swept = half_turns.mul_add(chi.constant(PI), passed) - self.start[1];
        // 1 − μ² = (1 − w₊)cos²χ + (1 − w₋)sin²χ, exact next to the poles.
        let narrow = lambda / self.spin;
        let sin_theta = (narrow * narrow * cos * cos / self.wide + self.wide * sin * sin).sqrt();
        [sin_theta.atan2(self.hemisphere * height), turn * (swept + smooth)]
    }

    /// The same without derivatives.
    fn still(&self) -> Self {
        Self {
            spin: self.spin.still(),
            lambda: [self.lambda[0].still(), self.lambda[1]],
            upper: self.upper.still(),
            range: self.range.still(),
            wide: self.wide.still(),
            hemisphere: self.hemisphere,
            start: [self.start[0].still(), self.start[1].still()],
        }
    }
}

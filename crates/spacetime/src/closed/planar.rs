//! The motion in θ of a photon with η = 0: in the equatorial plane, or asymptotic to it.
//!
//! In the plane μ = 0, and next to it the motion is a small oscillation, μ″ = Bμ, which gives derivatives.
//! Off the plane μ′² = Bμ² − s²μ⁴, so that y = 1/μ obeys y″ = By (and y = const. without spin, where light of
//! λ = η = 0 moves along a radius), and since y′² = By² − s² and B = s² − λ²
//!   λ∫dτ/(1 − μ²) = λτ + sgn λ Δatan2(y′/y, |λ|).

use super::photon::{Photon, Potential};
use crate::scalar::Scalar;

/// Below this |μ| light is in the plane.
const IN_PLANE: f64 = 1e-12;

/// cos ωτ and sin(ωτ)/ω with ω² = −B; cosh and sinh where B > 0.
#[inline(always)]
fn waves<S: Scalar>(b: S, tau: S) -> [S; 2] {
    let zero = tau.constant(0.0);
    let size = b.abs();
    let tiny = (size * tau * tau).less(zero.constant(1e-8));
    let rate = S::select(tiny, zero.constant(1.0), size).sqrt();
    let (sin, cos) = (rate * tau).sin_cos();
    let grow = (rate * tau).exp();
    let shrink = grow.recip();
    let falls = b.less(zero);
    let even = S::select(falls, cos, (grow + shrink) * 0.5);
    let odd = S::select(falls, sin, (grow - shrink) * 0.5) / rate;
    let square = b * tau * tau;
    let even = S::select(tiny, square * 0.5 + 1.0, even);
    [even, S::select(tiny, tau * (square * (1.0 / 6.0) + 1.0), odd)]
}

/// θ, and the azimuth that the motion in θ adds, after Mino time τ, for light that sets out along `heading`: λ and
/// μ′ but for a positive factor.
#[inline(always)]
pub fn after<S: Scalar>(photon: &Photon<S>, heading: [S; 2], tau: S) -> [S; 2] {
    let Photon { lambda, mu, mu_rate, .. } = *photon;
    let (zero, one) = (tau.constant(0.0), tau.constant(1.0));
    let b = Potential::new(photon).b;
    let [even, odd] = waves(b, tau);
    let near = mu.abs().less(zero.constant(IN_PLANE));
    let per_mu = S::select(near, one, mu).recip();
    let slope = -(mu_rate * per_mu);
    // y/y₀ and y′/y₀.
    let (scale, change) = (even + slope * odd, b * odd + slope * even);
    let end = S::select(near, mu * even + mu_rate * odd, mu / scale);
    let sign = S::select(heading[0].less(zero), -one, one);
    let begun = (-(heading[1] * per_mu)).atan2(heading[0] * sign + 0.0);
    let turned = (change / scale).atan2(lambda * sign) - begun;
    let turned = lambda * tau + S::select(near, zero, turned * sign);
    let sin = (-(end * end) + 1.0).max(zero).sqrt();
    [sin.atan2(end), turned]
}

//! The radial motion of light that escapes far from the critical curve.
//!
//! It swings between the zeros u₄ < 0 < u₁ of U, of which u > 0 is outside. With
//!   u = c + d cos χ,   c = (u₁ + u₄)/2,   d = (u₁ − u₄)/2,   χ′ = √p,   U = −((u − c)² − d²) p(u),
//! χ grows along the ray and vanishes at the turning point. Mino time and azimuth are integrals over χ of
//!   1/√p   and   (2u − sλu²)s/(Δ̂√p),   Δ̂ = 1 − 2u + s²u²,
//! smooth even functions with period 2π whose nearest singularity is the zero u₂ of p: their Fourier
//! coefficients fall as e^(−kρ), cosh ρ = (u₂ − c)/d, which is e^(−1.9k) at b = 8 M and e^(−2.5k) at 13 M. So an
//! integral once transformed is known all along the ray.

use super::factors::Factors;
use super::kernel::{Place, Radial, Start};
use super::photon::{Photon, Potential};
use super::series::{Cosines, Integral, sines};
use crate::scalar::Scalar;

/// Terms of the Fourier series that are enough for [`Kind::Distant`](super::course::Kind).
pub const TERMS: usize = 16;

/// Terms that are enough for [`Kind::Remote`](super::course::Kind).
pub const REMOTE_TERMS: usize = 12;

/// Terms that a first approximation of χ takes.
const ROUGH: usize = 8;

/// The motion of a photon from its start to infinity.
pub struct Distant<'a, S, const N: usize> {
    start: &'a Start<S>,
    factors: Factors<S>,
    mino: Integral<S, N>,
    azimuth: Integral<S, N>,
    /// Both integrals at the start.
    begun: [S; 2],
    total: S,
    swept: S,
}

impl<'a, S: Scalar, const N: usize> Distant<'a, S, N> {
    /// The motion from a start.
    #[inline(always)]
    pub fn new(start: &'a Start<S>, cosines: &Cosines<N>) -> Self {
        let Photon { spin, lambda, u, u_rate, .. } = start.photon;
        let zero = u.constant(0.0);
        let factors = Factors::around_flight(&Potential::new(&start.photon));
        let (mut slow, mut turn) = ([zero; N], [zero; N]);
        let mut last = [zero; 2];
        for j in 0..=N {
            let here = factors.width.mul_add(zero.constant(cosines.of(j)), factors.middle);
            let root = (-factors.quotient_at(here)).sqrt();
            let delta = here.mul_add(spin * spin * here - 2.0, zero.constant(1.0));
            let inverse = (root * delta).recip();
            let pair = [inverse * delta, numerator(spin, lambda, here) * inverse];
            if j < N { [slow[j], turn[j]] = pair } else { last = pair }
        }
        let mino = Integral::through(&slow, last[0], cosines);
        let azimuth = Integral::through(&turn, last[1], cosines);
        let mut distant = Self { start, factors, mino, azimuth, begun: [zero; 2], total: zero, swept: zero };
        distant.begun = distant.integrals(u, u_rate);
        let ended = distant.integrals(zero, zero.constant(-1.0));
        distant.total = ended[0] - distant.begun[0];
        distant.swept = ended[1] - distant.begun[1];
        distant
    }

    /// Mino time and azimuth from the turning point to u, where u′ is `rate`: u′ = −d sin χ √p.
    #[inline(always)]
    fn integrals(&self, u: S, rate: S) -> [S; 2] {
        let along = (u - self.factors.middle) * (-self.factors.quotient_at(u)).sqrt();
        let angle = (-rate).atan2(along);
        let inverse = rate.mul_add(rate, along * along).sqrt().recip();
        let at = (-rate * inverse, along * inverse);
        [self.mino.at(angle, at), self.azimuth.at(angle, at)]
    }
}

/// s(2u − sλu²).
#[inline(always)]
fn numerator<S: Scalar>(spin: S, lambda: S, u: S) -> S {
    spin * u * (-(spin * lambda * u) + 2.0)
}

impl<S: Scalar, const N: usize> Radial<S> for Distant<'_, S, N> {
    fn total(&self) -> S {
        self.total
    }

    fn azimuth_to_infinity(&self) -> S {
        self.swept
    }

    #[inline(always)]
    fn at(&self, tau: S) -> Place<S> {
        let Photon { spin, lambda, .. } = self.start.photon;
        let Factors { middle, width, .. } = self.factors;
        let goal = tau + self.begun[0];
        let per_mean = self.mino.mean.recip();
        let uniform = goal * per_mean;
        let (sin, cos) = uniform.sin_cos();
        let mut angle = (-per_mean).mul_add(sines(&self.mino.waves[..2], sin, cos), uniform);
        // Newton's method, χ′ = √p being known exactly.
        let (sin, cos) = angle.sin_cos();
        let rest = goal - self.mino.mean.mul_add(angle, sines(&self.mino.waves[..ROUGH], sin, cos));
        let u = width.mul_add(cos, middle);
        angle += rest * (-self.factors.quotient_at(u)).sqrt();
        let (sin, cos) = angle.sin_cos();
        let rest = goal - self.mino.at(angle, (sin, cos));
        let (along, across) = (width * cos, width * sin);
        let u = along + middle;
        // To second order: χ″ = p′(u)(du/dχ)/2.
        let speed = (-self.factors.quotient_at(u)).sqrt();
        let bend = self.factors.quotient_slope(u) * across * 0.25;
        let step = rest * bend.mul_add(rest, speed);
        let change = -(step * (along * 0.5).mul_add(step, across));
        let between = change.mul_add(u.constant(0.5), u);
        let delta = between.mul_add(spin * spin * between - 2.0, u.constant(1.0));
        let azimuth = self.azimuth.at(angle, (sin, cos)) - self.begun[1]
            + rest * numerator(spin, lambda, between) / delta;
        // χ grows, and vanishes at the turning point.
        Place { u: u + change, azimuth, time: tau.constant(f64::NAN), inwards: -angle }
    }
}

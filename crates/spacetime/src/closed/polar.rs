//! The motion of a photon in θ: oscillation about the equatorial plane (η > 0).
//!
//! M(μ) = (w₊ − μ²)(m + s²μ²) with D = √(B² + 4s²η), m = (D − B)/2 and w₊ = η/m. So μ = √w₊ sin ψ with
//! ψ′ = √A, A = m + s²μ², which is a pendulum's motion: ψ = am(√m τ | −k), k = s²w₊/m ≥ 0. In terms of its mean
//! phase X = X₀ + ωτ and of the nome q < 0 (Whittaker & Watson 1927, 22.6)
//!   ψ = X + Σ 2qⁿ/(n(1 + q²ⁿ)) sin 2nX,   √A/ω = 1 + Σ 4qⁿ/(1 + q²ⁿ) cos 2nX,
//!   ω = √m agm(1, √(1 + k)).
//! The plane is crossed wherever X is a multiple of π.
//!
//! With b = m + s² the azimuth is the sum of a part known in closed form, safe at the poles, and
//! of one that is a short Fourier series in X:
//!   λ∫dτ/(1 − μ²) = sgn λ [𝒜(ψ) − 𝒜(ψ₀)] + λs² ∫dτ/(√b(√A + √b)),
//!   𝒜(ψ) = nπ + atan2(|λ| sin(ψ − nπ), √b cos(ψ − nπ)),   n = round(ψ/π).

use std::f64::consts::PI;

use super::photon::{Photon, Potential};
use super::series::{Cosines, Integral, cosines, sines};
use crate::scalar::Scalar;

/// Terms of the Fourier series that are enough up to ℓ = [`FEW_REACH`].
pub const FEW: usize = 6;

/// The largest ℓ for [`FEW`] terms, ℓ being the first term of the nome q = ℓ + 2ℓ⁵ + 15ℓ⁹ + …
pub const FEW_REACH: f64 = 0.02;

/// Terms that are enough up to ℓ = [`SOME_REACH`]: light that plunges with b ≲ 2 M.
pub const SOME: usize = 16;

/// The largest ℓ for [`SOME`] terms.
pub const SOME_REACH: f64 = 0.15;

/// Terms that are enough up to ℓ = [`LARGE_REACH`]: light that plunges with b ≲ 1 M.
pub const LARGE: usize = 48;

/// The largest ℓ for [`LARGE`] terms; |q| is 0.51 there.
pub const LARGE_REACH: f64 = 0.45;

/// Terms that are enough for any photon: |q| nears 1 only for light that all but falls straight in.
pub const MANY: usize = 160;

/// Phases closer than this to the plane are in it.
const NEAR: f64 = 1e-12;

/// The oscillation of a photon.
#[derive(Clone, Copy, Debug)]
pub struct Oscillation<S, const N: usize> {
    /// w₊ = μ² at the turning points.
    pub reach: S,
    /// ω and 1/ω.
    pub rate: [S; 2],
    /// X₀, between −π and π.
    pub phase: S,
    /// |λ|, and λ's sign.
    lambda: [S; 2],
    /// √b.
    root_b: S,
    /// 2qⁿ/(n(1 + q²ⁿ)).
    series: [S; N],
    /// Integrals over 2X of λs²/(√b(√A + √b)), and of s²μ².
    azimuth: Integral<S, N>,
    height: Integral<S, N>,
    /// 𝒜(ψ₀), and both integrals at X₀.
    start: [S; 3],
}

/// m and k of a photon with η > 0.
#[inline(always)]
fn modulus<S: Scalar>(photon: &Photon<S>) -> [S; 2] {
    let b = Potential::new(photon).b;
    let s2 = photon.spin * photon.spin;
    let twice = s2 * photon.eta * 2.0;
    let d = b.mul_add(b, twice * 2.0).sqrt();
    // Of two equal forms, the one without cancellation.
    let m = S::select(b.less(b.constant(0.0)), (d - b) * 0.5, twice / (d + b));
    [m, s2 * photon.eta / (m * m)]
}

/// ℓ = ½(1 − √k′)/(1 + √k′), k′ = √(1 + k); q = ℓ + 2ℓ⁵ + 15ℓ⁹ + … (Abramowitz & Stegun 1964, 17.3.21).
#[inline(always)]
fn first_nome<S: Scalar>(complement: S) -> S {
    let root = complement.sqrt();
    (-root + 1.0) * 0.5 / (root + 1.0)
}

/// ℓ of a photon with η > 0, about its |q|: beyond [`FEW_REACH`] it needs [`MANY`] terms.
#[inline(always)]
pub fn size_of_nome<S: Scalar>(photon: &Photon<S>) -> S {
    first_nome((modulus(photon)[1] + 1.0).sqrt()).abs()
}

/// The arithmetic-geometric mean of 1 and x > 0.
#[inline(always)]
fn mean_with_one<S: Scalar>(x: S, iterations: usize) -> S {
    let (mut a, mut g) = (x.constant(1.0), x);
    for _ in 1..iterations + S::ORDER {
        (a, g) = ((a + g) * 0.5, (a * g).sqrt());
    }
    (a + g) * 0.5
}

/// The mean frequency ω of a photon with η ≥ 0.
pub fn frequency(photon: &Photon<f64>) -> f64 {
    let [m, k] = modulus(photon);
    m.sqrt() * mean_with_one((1.0 + k).sqrt(), 40)
}

impl<S: Scalar, const N: usize> Oscillation<S, N> {
    /// The oscillation of a photon with η > 0, w₊ > 0 and |q| within the reach of N terms; with the integral of
    /// s²μ² if `TIMED`.
    #[inline(always)]
    pub fn new<const TIMED: bool>(photon: &Photon<S>, heading: [S; 2], table: &Cosines<N>) -> Self {
        let Photon { spin, lambda, mu, mu_rate, .. } = *photon;
        let s2 = spin * spin;
        let [m, k] = modulus(photon);
        let complement = (k + 1.0).sqrt();
        let (mean, q);
        if N == FEW {
            mean = mean_with_one(complement, 4);
            let l = first_nome(complement);
            let l4 = (l * l).squared();
            q = l * (l4 * (l4 * 15.0 + 2.0) + 1.0);
        } else if N == SOME {
            // As far as 1707ℓ¹⁷; it has derivatives at k = 0 too.
            mean = mean_with_one(complement, 7);
            let l = first_nome(complement);
            let l4 = (l * l).squared();
            q = l * (l4 * (l4 * (l4 * (l4 * 1707.0 + 150.0) + 15.0) + 2.0) + 1.0);
        } else {
            // −q is the nome of the parameter k/(1 + k).
            let iterations = match N {
                LARGE => 9,
                _ => 40,
            };
            mean = mean_with_one(complement, iterations);
            let other = (k / (k + 1.0)).sqrt();
            let ratio = mean_with_one(complement.recip(), iterations) / mean_with_one(other, iterations);
            q = -((ratio * -PI).exp());
        }
        let rate = m.sqrt() * mean;
        let per_rate = rate.recip();
        let zero = lambda.constant(0.0);
        // 2qⁿ/(n(1 + q²ⁿ)), and twice n times it.
        let (mut series, mut speeds) = ([zero; N], [zero; N]);
        let mut power = q;
        for n in 0..N {
            let term = power * (power.mul_add(power, zero.constant(1.0))).recip();
            series[n] = term * (2.0 / (n + 1) as f64);
            speeds[n] = term * 4.0;
            power *= q;
        }
        let root_b = (m + s2).sqrt();
        let push = lambda * s2;
        let (mut smooth, mut rise) = ([zero; N], [zero; N]);
        let mut last = [zero; 2];
        for j in 0..=N {
            // √A at X = jπ/(2N).
            let mut sum = zero.constant(1.0);
            for n in 0..N {
                sum = speeds[n].mul_add(zero.constant(table.of((n + 1) * j)), sum);
            }
            let root_a = rate * sum;
            let pair = [push / (root_b * (root_a + root_b)), if TIMED { root_a * root_a - m } else { zero }];
            if j < N { [smooth[j], rise[j]] = pair } else { last = pair }
        }
        let azimuth = Integral::through(&smooth, last[0], table);
        let height = if TIMED { Integral::through(&rise, last[1], table) } else { azimuth };

        let sin = mu * (s2 * mu).mul_add(mu, m).sqrt();
        let psi = sin.atan2(mu_rate);
        let sign = S::select(heading[0].less(zero), zero.constant(-1.0), zero.constant(1.0));
        let mut phase = psi;
        if N == FEW {
            // X ≈ ψ − c₁ sin 2ψ is off by less than 2c₁², c₁ = 2q/(1 + q²).
            let size = sin.mul_add(sin, mu_rate * mu_rate);
            phase -= series[0] * sin * mu_rate * 2.0 / size.max(zero.constant(f64::MIN_POSITIVE));
        }
        for _ in 0..Self::STEPS {
            let (sin, cos) = (phase * 2.0).sin_cos();
            let angle = phase + sines(&series, sin, cos);
            let slope = cosines(&speeds, cos) + 1.0;
            let step = (angle - psi) / slope;
            // Bounded: near |q| = 1 the slope varies over many orders of magnitude.
            phase -= step.max(zero.constant(-0.5)).min(zero.constant(0.5));
            // Lanes all take the same steps, so that none depends on another.
            if S::LANES == 1 && !S::any(zero.constant(1e-15).less(step.abs())) {
                break;
            }
        }
        let double = phase * 2.0;
        let at = double.sin_cos();
        let start = [
            (heading[0] * sign * sin + 0.0).atan2(root_b * heading[1]),
            azimuth.at(double, at) * 0.5,
            if TIMED { height.at(double, at) * 0.5 } else { zero },
        ];
        let (lambda, rate) = ([lambda * sign, sign], [rate, per_rate]);
        Self { reach: photon.eta / m, rate, phase, lambda, root_b, series, azimuth, height, start }
    }

    /// Steps of Newton's method for X₀.
    const STEPS: usize = match N {
        FEW => 2 + S::ORDER,
        SOME => 5 + S::ORDER,
        LARGE => 12 + S::ORDER,
        _ => 60,
    };

    /// Mino time, azimuth and ∫s²μ²dτ from the start to where X = nπ, in the plane.
    #[inline(always)]
    pub fn crossing(&self, n: S) -> [S; 3] {
        let x = n * PI;
        let ([_, per_rate], [_, sign]) = (self.rate, self.lambda);
        let azimuth = sign * (x - self.start[0]) + self.azimuth.mean.mul_add(x, -self.start[1]) * per_rate;
        [(x - self.phase) * per_rate, azimuth, self.height.mean.mul_add(x, -self.start[2]) * per_rate]
    }

    /// The first n whose crossing lies ahead; that of a camera in the plane lies behind.
    #[inline(always)]
    pub fn first(&self) -> S {
        // ⌊X₀/π⌋ + 1: X₀ lies between −π and π.
        let phase = self.phase;
        let behind = phase.less(phase.constant(PI - NEAR));
        let upper = S::select(behind, phase.constant(1.0), phase.constant(2.0));
        S::select(phase.less(phase.constant(-NEAR)), phase.constant(0.0), upper)
    }

    /// θ and azimuth after Mino time τ.
    #[inline(always)]
    pub fn at(&self, tau: S) -> [S; 2] {
        let [rate, per_rate] = self.rate;
        let x = rate.mul_add(tau, self.phase);
        let double = x * 2.0;
        let (sin, cos) = double.sin_cos();
        let psi = x + sines(&self.series, sin, cos);
        let half_turns = (psi * (1.0 / PI)).round();
        let (sin_f, cos_f) = (half_turns.mul_add(psi.constant(-PI), psi)).sin_cos();
        // (−1)ⁿ.
        let odd = half_turns - (half_turns * 0.5).round() * 2.0;
        let parity = -odd.abs() * 2.0 + 1.0;
        let [lambda, sign] = self.lambda;
        let turned = half_turns.mul_add(psi.constant(PI), (lambda * sin_f).atan2(self.root_b * cos_f));
        let smooth = (self.azimuth.at(double, (sin, cos)) * 0.5 - self.start[1]) * per_rate;
        let mu = self.reach.sqrt() * sin_f * parity;
        // 1 − μ² = w₊ cos²ψ + λ²/b, exact next to the poles.
        let narrow = lambda / self.root_b;
        let sin_theta = (self.reach * cos_f * cos_f + narrow * narrow).sqrt();
        [sin_theta.atan2(mu), sign * (turned - self.start[0]) + smooth]
    }
}

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
use crate::scalar::Scalar;

/// Terms of the Fourier series that are enough up to |q| = [`FEW_REACH`].
pub const FEW: usize = 6;

/// The largest |q| for [`FEW`] terms.
pub const FEW_REACH: f64 = 0.02;

/// Terms that are enough for any photon: |q| nears 1 only for light that all but falls straight in.
pub const MANY: usize = 160;

/// Phases closer than this to the plane are in it.
const NEAR: f64 = 1e-12;

/// cos(πj/N) for j from 0 to 2N − 1.
#[derive(Clone, Debug)]
pub struct Cosines<const N: usize>([[f64; N]; 2]);

impl<const N: usize> Cosines<N> {
    /// The table.
    pub fn new() -> Self {
        let at = |j: usize| (PI * j as f64 / N as f64).cos();
        Self([std::array::from_fn(at), std::array::from_fn(|j| at(j + N))])
    }

    #[inline(always)]
    fn of(&self, j: usize) -> f64 {
        let j = j % (2 * N);
        self.0[j / N][j % N]
    }
}

/// The oscillation of a photon.
#[derive(Clone, Copy, Debug)]
pub struct Oscillation<S, const N: usize> {
    /// w₊ = μ² at the turning points.
    pub reach: S,
    /// ω.
    pub rate: S,
    /// X₀, between −π and π.
    pub phase: S,
    /// |λ|, and λ's sign.
    lambda: [S; 2],
    /// √b.
    root_b: S,
    /// 2qⁿ/(n(1 + q²ⁿ)).
    series: [S; N],
    /// Of λs²/(√b(√A + √b)), and of s²μ².
    azimuth: Cosine<S, N>,
    height: Cosine<S, N>,
    /// 𝒜(ψ₀), and the integrals of both series at X₀.
    start: [S; 3],
}

/// Σ aₖ cos 2kX, by its coefficients.
#[derive(Clone, Copy, Debug)]
struct Cosine<S, const N: usize> {
    mean: S,
    rest: [S; N],
}

impl<S: Scalar, const N: usize> Cosine<S, N> {
    /// The series through values at X = jπ/(2N), j from 0 to N (a discrete cosine transform, DCT-I).
    #[inline(always)]
    fn through(values: &[S; N], last: S, cosines: &Cosines<N>) -> Self {
        let coefficient = |k: usize| {
            let mut sum = (values[0] + last * cosines.of(k * N)) * 0.5;
            for (j, &value) in values.iter().enumerate().skip(1) {
                sum = value.mul_add(value.constant(cosines.of(k * j)), sum);
            }
            sum * (2.0 / N as f64)
        };
        let halved = |k: usize| if k == N { 0.5 } else { 1.0 };
        Self { mean: coefficient(0) * 0.5, rest: std::array::from_fn(|k| coefficient(k + 1) * halved(k + 1)) }
    }

    /// a₀X + Σ aₖ sin(2kX)/(2k), given sin 2X and cos 2X.
    #[inline(always)]
    fn integral(&self, x: S, (sin, cos): (S, S)) -> S {
        let mut sum = self.mean * x;
        multiples::<S, N>(sin, cos, |k, sin_k, _| {
            sum = (self.rest[k] * (0.5 / (k + 1) as f64)).mul_add(sin_k, sum);
        });
        sum
    }
}

/// sin and cos of (k + 1)α for k below N.
#[inline(always)]
fn multiples<S: Scalar, const N: usize>(sin: S, cos: S, mut each: impl FnMut(usize, S, S)) {
    let (mut sin_k, mut cos_k) = (sin, cos);
    for k in 0..N {
        each(k, sin_k, cos_k);
        (sin_k, cos_k) = (sin_k * cos + cos_k * sin, cos_k * cos - sin_k * sin);
    }
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

/// About |q| of a photon with η > 0: beyond [`FEW_REACH`] it needs [`MANY`] terms.
#[inline(always)]
pub fn size_of_nome<S: Scalar>(photon: &Photon<S>) -> S {
    first_nome((modulus(photon)[1] + 1.0).sqrt()).abs()
}

/// The arithmetic-geometric mean of 1 and x > 0.
#[inline(always)]
fn mean_with_one<S: Scalar>(x: S, iterations: usize) -> S {
    let (mut a, mut g) = (x.constant(1.0), x);
    for _ in 0..iterations {
        (a, g) = ((a + g) * 0.5, (a * g).sqrt());
    }
    a
}

/// The mean frequency ω of a photon with η ≥ 0.
pub fn frequency(photon: &Photon<f64>) -> f64 {
    let [m, k] = modulus(photon);
    m.sqrt() * mean_with_one((1.0 + k).sqrt(), 40)
}

impl<S: Scalar, const N: usize> Oscillation<S, N> {
    /// The oscillation of a photon with η > 0, w₊ > 0 and |q| within the reach of N terms.
    #[inline(always)]
    pub fn new(photon: &Photon<S>, cosines: &Cosines<N>) -> Self {
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
        } else {
            // −q is the nome of the parameter k/(1 + k).
            mean = mean_with_one(complement, 40);
            let other = (k / (k + 1.0)).sqrt();
            let ratio = mean_with_one(complement.recip(), 40) / mean_with_one(other, 40);
            q = -((ratio * -PI).exp());
        }
        let rate = m.sqrt() * mean;
        let mut power = q;
        let term = std::array::from_fn::<S, N, _>(|_| {
            let term = power / (power * power + 1.0) * 2.0;
            power *= q;
            term
        });
        let mut n = 0.0;
        let series = term.map(|t| {
            n += 1.0;
            t / n
        });
        let root_b = (m + s2).sqrt();
        let speed = |j: usize| {
            let mut sum = lambda.constant(1.0);
            for (n, &t) in term.iter().enumerate() {
                sum = t.mul_add(t.constant(2.0 * cosines.of((n + 1) * j)), sum);
            }
            rate * sum
        };
        let speeds: [S; N] = std::array::from_fn(speed);
        let last = speed(N);
        let push = lambda * s2;
        let smooth = |root_a: S| push / (root_b * (root_a + root_b));
        let rise = |root_a: S| root_a * root_a - m;
        let azimuth = Cosine::through(&speeds.map(smooth), smooth(last), cosines);
        let height = Cosine::through(&speeds.map(rise), rise(last), cosines);

        let sin = mu * (s2 * mu).mul_add(mu, m).sqrt();
        let psi = sin.atan2(mu_rate);
        let zero = lambda.constant(0.0);
        let sign = S::select(lambda.less(zero), lambda.constant(-1.0), lambda.constant(1.0));
        let mut oscillation = Self {
            reach: photon.eta / m,
            rate,
            phase: psi,
            lambda: [lambda.abs(), sign],
            root_b,
            series,
            azimuth,
            height,
            start: [(lambda.abs() * sin).atan2(root_b * mu_rate), zero, zero],
        };
        for _ in 0..if N == FEW { 3 } else { 60 } {
            let (angle, slope) = oscillation.angle(oscillation.phase);
            // Bounded: near |q| = 1 the slope varies over many orders of magnitude.
            let step = (angle - psi) / slope;
            oscillation.phase -= step.max(zero.constant(-0.5)).min(zero.constant(0.5));
        }
        let double = (oscillation.phase * 2.0).sin_cos();
        oscillation.start[1] = oscillation.azimuth.integral(oscillation.phase, double);
        oscillation.start[2] = oscillation.height.integral(oscillation.phase, double);
        oscillation
    }

    /// ψ and dψ/dX at X.
    #[inline(always)]
    fn angle(&self, x: S) -> (S, S) {
        let (sin, cos) = (x * 2.0).sin_cos();
        let (mut angle, mut slope) = (x, x.constant(1.0));
        multiples::<S, N>(sin, cos, |k, sin_k, cos_k| {
            angle = self.series[k].mul_add(sin_k, angle);
            slope = (self.series[k] * (2.0 * (k + 1) as f64)).mul_add(cos_k, slope);
        });
        (angle, slope)
    }

    /// Mino time, azimuth and ∫s²μ²dτ from the start to where X = nπ, in the plane.
    #[inline(always)]
    pub fn crossing(&self, n: S) -> [S; 3] {
        let x = n * PI;
        let per_rate = self.rate.recip();
        let [_, sign] = self.lambda;
        let azimuth = sign * (x - self.start[0]) + (self.azimuth.mean * x - self.start[1]) * per_rate;
        [(x - self.phase) * per_rate, azimuth, (self.height.mean * x - self.start[2]) * per_rate]
    }

    /// The first n whose crossing lies ahead; that of a camera in the plane lies behind.
    #[inline(always)]
    pub fn first(&self) -> S {
        // ⌊X₀/π⌋ + 1: X₀ lies between −π and π.
        let number = |n: f64| self.phase.constant(n);
        let upper = S::select(self.phase.less(number(PI - NEAR)), number(1.0), number(2.0));
        S::select(self.phase.less(number(-NEAR)), number(0.0), upper)
    }

    /// θ and azimuth after Mino time τ.
    #[inline(always)]
    pub fn at(&self, tau: S) -> [S; 2] {
        let x = self.rate.mul_add(tau, self.phase);
        let (sin, cos) = (x * 2.0).sin_cos();
        let mut psi = x;
        multiples::<S, N>(sin, cos, |k, sin_k, _| psi = self.series[k].mul_add(sin_k, psi));
        let half_turns = (psi * (1.0 / PI)).round();
        let (sin_f, cos_f) = (half_turns.mul_add(psi.constant(-PI), psi)).sin_cos();
        // (−1)ⁿ.
        let odd = half_turns - (half_turns * 0.5).round() * 2.0;
        let parity = -odd.abs() * 2.0 + 1.0;
        let [lambda, sign] = self.lambda;
        let turned = half_turns.mul_add(psi.constant(PI), (lambda * sin_f).atan2(self.root_b * cos_f));
        let smooth = (self.azimuth.integral(x, (sin, cos)) - self.start[1]) / self.rate;
        let mu = self.reach.sqrt() * sin_f * parity;
        // 1 − μ² = w₊ cos²ψ + λ²/b, exact next to the poles.
        let narrow = lambda / self.root_b;
        let sin_theta = (self.reach * cos_f * cos_f + narrow * narrow).sqrt();
        [sin_theta.atan2(mu), sign * (turned - self.start[0]) + smooth]
    }
}

//! An independent way to follow light in Kerr: the separated equations in Boyer–Lindquist
//! coordinates and Mino time τ (Carter 1968; Mino 2003), of second order in u = 1/r and μ = cos θ
//! so that turning points need no signs.
//!
//! E = 1, for the reversed photon with λ, η and spin s:
//!   U(u) = u′² = 1 + Bu² + 2Cu³ − Qu⁴,   M(μ) = μ′² = η + Bμ² − s²μ⁴,
//!   B = s² − λ² − η,   C = (λ − s)² + η,   Q = s²η,
//!   φ′ = λ/(1 − μ²) + s(2u − sλu²)/(1 − 2u + s²u²),
//!   t′ = 1/u² + s²μ² + 2(1/u)(1/u² + s² − sλ)/(1/u² − 2/u + s²).
//! The chart, the variables and the parameter all differ from those of the integrator.

use kerrscope_spacetime::Scalar;
use kerrscope_spacetime::geodesic::{Dop853, Flow, Method};

/// The constants of a reversed photon.
#[derive(Clone, Copy, Debug)]
pub struct Photon {
    pub spin: f64,
    pub lambda: f64,
    pub eta: f64,
    /// Whether to integrate t, which is infinite for a camera at infinity.
    pub timed: bool,
    /// A photon that falls into the hole, not reversed but followed backwards: φ is then that of
    /// ingoing coordinates, regular at the horizon.
    pub falling: bool,
}

impl Photon {
    fn coefficients(&self) -> [f64; 3] {
        let Self { spin: s, lambda, eta, .. } = *self;
        [s * s - lambda * lambda - eta, (lambda - s).powi(2) + eta, s * s * eta]
    }

    /// u′².
    pub fn radial(&self, u: f64) -> f64 {
        let [b, c, q] = self.coefficients();
        1.0 + u * u * (b + u * (2.0 * c - q * u))
    }

    /// μ′².
    pub fn polar(&self, mu: f64) -> f64 {
        let [b, _, _] = self.coefficients();
        self.eta + mu * mu * (b - self.spin * self.spin * mu * mu)
    }
}

/// u, u′, μ, μ′, φ, t.
impl<S: Scalar> Flow<S, 6> for Photon {
    fn derivative(&self, y: &[S; 6]) -> [S; 6] {
        let Self { spin: s, lambda, .. } = *self;
        let [b, c, q] = self.coefficients();
        let [u, du, mu, dmu, _, _] = *y;
        let (u2, mu2) = (u * u, mu * mu);
        let delta = u * -2.0 + u2 * (s * s) + 1.0;
        let around = if self.falling {
            // φ̃′ = λ/(1 − μ²) − s + sCu²/(1 + (s² − sλ)u² + √U), and u′ = −√U backwards.
            let inner = u2 * (s * s - s * lambda) + 1.0 - du;
            -((-mu2 + 1.0).recip() * lambda - s + u2 * (s * c) / inner)
        } else {
            (-mu2 + 1.0).recip() * lambda + (u * 2.0 - u2 * (s * lambda)) * s / delta
        };
        // 2r(r² + s² − sλ)/Δ = 2[1 + (s² − sλ)u²]/(u Δ/r²).
        let time = if self.timed {
            u2.recip() + mu2 * (s * s) + (u2 * (s * s - s * lambda) + 1.0) * 2.0 / (u * delta)
        } else {
            u.constant(0.0)
        };
        [
            du,
            u * b + u2 * (3.0 * c) - u2 * u * (2.0 * q),
            dmu,
            mu * b - mu2 * mu * (2.0 * s * s),
            around,
            time,
        ]
    }

    fn inverse_scale(&self, y: &[S; 6]) -> [S; 6] {
        let one = y[0].constant(1.0);
        // Time counts against r, as far as r = 1000.
        let of_time = S::select(y[0].less(y[0].constant(1e-3)), y[0].constant(0.0), y[0] * 0.1);
        [one, one, one, one, one, if self.timed { of_time } else { y[0].constant(0.0) }]
    }
}

/// Near the level of rounding.
const STEP_ERROR: f64 = 3e-15;

/// What the oracle met.
#[derive(Clone, Debug, Default)]
pub struct Trip {
    /// (r, φ, t) at μ = 0.
    pub crossings: Vec<[f64; 3]>,
    /// (θ, φ) at u = 0, `None` if captured.
    pub direction: Option<[f64; 2]>,
}

/// From r = 1/u at polar angle cosine μ, azimuth 0 and time 0; inwards if `inward`, and with μ′ of
/// the given sign.
pub fn travel(photon: Photon, u: f64, mu: f64, inward: bool, mu_sign: f64) -> Trip {
    let du = photon.radial(u).max(0.0).sqrt();
    let dmu = photon.polar(mu).max(0.0).sqrt().copysign(mu_sign);
    let mut y = [u, if inward { du } else { -du }, mu, dmu, 0.0, 0.0];
    let horizon = 1.0 + (1.0 - photon.spin * photon.spin).sqrt();
    let mut trip = Trip::default();
    let mut h: f64 = 1e-3;
    for _ in 0..20_000 {
        let k = photon.derivative(&y);
        let mut stages = [k; 12];
        let step = <Dop853 as Method<12>>::step(&photon, &y, &mut stages, h);
        if !(step.error < STEP_ERROR) {
            h *= (0.8 * (step.error / STEP_ERROR).powf(-1.0 / 8.0)).clamp(0.1, 0.9);
            if h < 1e-16 {
                return trip;
            }
            continue;
        }
        let end = photon.derivative(&step.end);
        let dense = <Dop853 as Method<12>>::dense(&photon, &y, &stages, &step.end, &end, h);
        // The dense output is of lower order than the step: find the place by it, then step there.
        let exactly = |i: usize| {
            let share = bisect(|share| dense.component(i, share));
            let mut part = share * h;
            let mut there = <Dop853 as Method<12>>::step(&photon, &y, &mut [k; 12], part).end;
            for _ in 0..3 {
                let slope = photon.derivative(&there)[i];
                if slope == 0.0 {
                    break;
                }
                part -= there[i] / slope;
                there = <Dop853 as Method<12>>::step(&photon, &y, &mut [k; 12], part).end;
            }
            (part, there)
        };
        let leaves = step.end[0] <= 0.0;
        let last = if leaves { Some(exactly(0)) } else { None };
        if y[2] != 0.0 && (y[2] > 0.0) != (step.end[2] > 0.0) {
            let (part, there) = exactly(2);
            if last.is_none_or(|(until, _)| part < until) {
                trip.crossings.push([1.0 / there[0], there[4], there[5]]);
            }
        }
        if let Some((_, there)) = last {
            trip.direction = Some([there[2].clamp(-1.0, 1.0).acos(), there[4]]);
            return trip;
        }
        // φ and t of Boyer and Lindquist diverge at the horizon; from within, what turns back
        // has come from elsewhere.
        let over = if photon.falling { step.end[1] >= 0.0 } else { step.end[0] >= (1.0 - 1e-6) / horizon };
        if over {
            return trip;
        }
        y = step.end;
        h *= (0.8 * (step.error.max(1e-22) / STEP_ERROR).powf(-1.0 / 8.0)).clamp(0.5, 2.0);
    }
    trip
}

/// The share of [0, 1] at which `f` changes sign.
fn bisect(f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    let positive = f(low) > 0.0;
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (f(middle) > 0.0) == positive { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

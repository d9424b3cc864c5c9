//! A photon in the separated equations of motion.

use crate::kerr::carter;
use crate::metric::{Inverted, principal_null, scaled_radius};
use crate::scalar::Scalar;
use crate::tensor::dot;

/// A reversed photon of energy 1 at the start of its ray, around a hole of spin s (= −a).
///
/// Its motion in Mino time τ (Carter 1968; Mino 2003) separates in u = 1/r and μ = cos θ of Boyer and
/// Lindquist:
///   u′² = U(u) = 1 + Bu² + 2Cu³ − Qu⁴,   μ′² = M(μ) = η + Bμ² − s²μ⁴,
///   B = s² − λ² − η,   C = (λ − s)² + η,   Q = s²η.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Photon<S> {
    /// s.
    pub spin: S,
    /// λ = L/E.
    pub lambda: S,
    /// η = Carter's constant/E².
    pub eta: S,
    /// 1/r; 0 at infinity.
    pub u: S,
    /// Whose sign is that of u′: positive inwards.
    pub u_rate: S,
    /// cos θ.
    pub mu: S,
    /// μ′.
    pub mu_rate: S,
}

impl<S: Scalar> Photon<S> {
    /// A photon of energy E > 0 around a hole of spin s.
    ///
    /// With p = q n + w k, k = J × n, r̂ = w r:
    ///   μ′ = r̂ k_z − q n_z w s² sin²θ/r̂,   u′ = −[Δ̂ l·p − (2u − sλu²)],   Δ̂ = 1 − 2u + s²u²,
    /// the second because l·p is p_r of Kerr–Schild coordinates; both for E = 1.
    #[inline(always)]
    pub fn new(spin: S, energy: S, state: &Inverted<S>) -> Self {
        let per_energy = energy.recip();
        let [nx, ny, nz] = state.n;
        let [jx, jy, jz] = state.j;
        let (jx, jy, lambda) = (jx * per_energy, jy * per_energy, jz * per_energy);
        let scaled = scaled_radius(spin, state);
        let per_scaled = scaled.recip();
        let mu = nz * per_scaled;
        let u = state.w * per_scaled;
        let s2 = spin * spin;
        let drop = state.w * s2 * (-(mu * mu) + 1.0) * mu;
        let mu_rate = scaled * (jx * ny - jy * nx) - state.q * per_energy * drop;
        let along = dot(&principal_null(spin, state), &state.momentum()) * per_energy;
        let delta = u * (s2 * u - 2.0) + 1.0;
        let u_rate = u * (-(spin * lambda * u) + 2.0) - delta * along;
        let eta = carter(spin, energy, state) * per_energy * per_energy;
        Self { spin, lambda, eta, u, u_rate, mu, mu_rate }
    }
}

impl<S: Scalar> Photon<S> {
    /// The same photon without derivatives.
    #[inline(always)]
    pub fn still(&self) -> Self {
        Self {
            spin: self.spin.still(),
            lambda: self.lambda.still(),
            eta: self.eta.still(),
            u: self.u.still(),
            u_rate: self.u_rate.still(),
            mu: self.mu.still(),
            mu_rate: self.mu_rate.still(),
        }
    }
}

/// The radial potential U.
#[derive(Clone, Copy, Debug)]
pub struct Potential<S> {
    /// B.
    pub b: S,
    /// C.
    pub c: S,
    /// Q.
    pub q: S,
}

impl<S: Scalar> Potential<S> {
    /// That of a photon.
    #[inline(always)]
    pub fn new(photon: &Photon<S>) -> Self {
        let Photon { spin, lambda, eta, .. } = *photon;
        let s2 = spin * spin;
        let offset = lambda - spin;
        Self { b: s2 - lambda * lambda - eta, c: offset.mul_add(offset, eta), q: s2 * eta }
    }

    /// The same without derivatives.
    #[inline(always)]
    pub fn still(&self) -> Self {
        Self { b: self.b.still(), c: self.c.still(), q: self.q.still() }
    }

    /// U(u).
    #[inline(always)]
    pub fn at(&self, u: S) -> S {
        let inner = u.mul_add(self.c * 2.0 - self.q * u, self.b);
        (u * u).mul_add(inner, u.constant(1.0))
    }

    /// U′(u)/2 = u″.
    #[inline(always)]
    pub fn half_slope(&self, u: S) -> S {
        u * u.mul_add(self.c * 3.0 - self.q * u * 2.0, self.b)
    }

    /// 9C² + 8QB: where it is not negative, U′ vanishes at [`least`](Self::least).
    #[inline(always)]
    pub fn discriminant(&self) -> S {
        let c3 = self.c * 3.0;
        c3.mul_add(c3, self.q * self.b * 8.0)
    }

    /// Where U is least, if B < 0 and the discriminant is not negative.
    #[inline(always)]
    pub fn least(&self) -> S {
        let root = self.discriminant().max(self.b.constant(0.0)).sqrt();
        self.b * -2.0 / (self.c * 3.0 + root)
    }
}

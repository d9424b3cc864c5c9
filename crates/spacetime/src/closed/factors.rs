//! The radial potential as a product of two quadratics.

use super::photon::Potential;
use crate::scalar::Scalar;

/// The error of a coefficient, relative to q₀, that is taken for rounding.
const CLOSE: f64 = 1e-13;

/// Iterations beyond those that are enough elsewhere.
const MORE: usize = 40;

/// U = ((u − c)² − e)(q₀ + q₁u + q₂u²).
#[derive(Clone, Copy, Debug)]
pub struct Factors<S> {
    /// c.
    pub middle: S,
    /// √|e|.
    pub width: S,
    /// q₀, q₁, q₂.
    pub quotient: [S; 3],
}

impl<S: Scalar> Factors<S> {
    /// No factors.
    pub fn none(like: S) -> Self {
        let zero = like.constant(0.0);
        Self { middle: zero, width: zero, quotient: [zero; 3] }
    }

    /// Those of the two zeros of U on both sides of where it is least. `SPREAD` starts from the
    /// zeros, else from the parabola at the least value.
    #[inline(always)]
    pub fn around_least<const SPREAD: bool>(potential: &Potential<S>) -> Self {
        let least = potential.least();
        if SPREAD {
            let [u1, u2] = zeros(potential, least);
            Self::refined(potential, [(u1 + u2) * 0.5, u1 * u2], 5)
        } else {
            let Potential { b, c, q } = *potential;
            let second = least.mul_add(c * 12.0 - q * least * 12.0, b * 2.0);
            Self::refined(potential, [least, least * least + potential.at(least) * 2.0 / second], 6)
        }
    }

    /// Those of the zeros between which light moves that escapes far from the critical curve, u₄ < 0 < u₁.
    ///
    /// With x = √(−B) u, ε = C/(−B)^{3/2} and κ = Q/B² they solve x² = 1 + 2εx³ − κx⁴, so that
    ///   x₁,₄ = ±(1 − κ/2) + ε ± (5/2)ε² + 8ε³ + ….
    #[inline(always)]
    pub fn around_flight(potential: &Potential<S>) -> Self {
        let Potential { b, c, q } = *potential;
        let per_b = -b.recip();
        let unit = per_b.sqrt();
        let epsilon = c * per_b * unit;
        let square = epsilon * epsilon;
        let middle = epsilon * (square * 8.0 + 1.0);
        let width = square * 2.5 - q * per_b * per_b * 0.5 + 1.0;
        Self::refined(potential, [middle * unit, (middle * middle - width * width) * per_b], 4)
    }

    /// Newton's method on the coefficients: with q₂ = −Q, q₁ = 2C − 2cQ, q₀ = B + 2cq₁ + gQ and
    /// g = c² − e, the other two coefficients of U demand
    ///   F₁ = g q₀ − 1 = 0,   F₂ = g q₁ − 2c q₀ = 0.
    ///
    /// So many iterations are enough, but where U has another zero close to the pair, as next to the horizon
    /// of a hole of extreme spin: there the error falls by half at a time.
    #[inline(always)]
    fn refined(potential: &Potential<S>, [mut c, mut g]: [S; 2], iterations: usize) -> Self {
        let q = potential.q;
        let mut quotient = Self::quotient(potential, c, g);
        let enough = iterations + S::ORDER;
        for k in 0..enough + MORE {
            let [q0, q1, _] = quotient;
            let f1 = g.mul_add(q0, c.constant(-1.0));
            let f2 = g * q1 - c * q0 * 2.0;
            let error = f1.abs().max(f2.abs());
            let open = q0.abs().max(c.constant(1.0)).less(error * (1.0 / CLOSE));
            if k >= enough && !S::any(open) {
                break;
            }
            let cq = c * q;
            let q0_c = q1 * 2.0 - cq * 4.0;
            let f1_c = g * q0_c;
            let f1_g = g.mul_add(q, q0);
            let f2_c = g * q * -2.0 - c.mul_add(q0_c, q0) * 2.0;
            let f2_g = q1 - cq * 2.0;
            let inverse = (f1_c * f2_g - f1_g * f2_c).recip();
            let (next_c, next_g) =
                (c - (f1 * f2_g - f1_g * f2) * inverse, g - (f1_c * f2 - f1 * f2_c) * inverse);
            // A lane that is done stays, whatever those beside it need.
            (c, g) = if k < enough {
                (next_c, next_g)
            } else {
                (S::select(open, next_c, c), S::select(open, next_g, g))
            };
            quotient = Self::quotient(potential, c, g);
        }
        let e = c.mul_add(c, -g);
        // Exactly on the critical curve light would never arrive.
        let width = e.abs().max(c.constant(1e-300)).sqrt();
        Self { middle: c, width, quotient }
    }

    #[inline(always)]
    fn quotient(potential: &Potential<S>, c: S, g: S) -> [S; 3] {
        let Potential { b, c: cc, q } = *potential;
        let q1 = (cc - c * q) * 2.0;
        [(c * 2.0).mul_add(q1, g.mul_add(q, b)), q1, -q]
    }

    /// q₀ + q₁u + q₂u².
    #[inline(always)]
    pub fn quotient_at(&self, u: S) -> S {
        let [q0, q1, q2] = self.quotient;
        u.mul_add(u.mul_add(q2, q1), q0)
    }

    /// q₁ + 2q₂u.
    #[inline(always)]
    pub fn quotient_slope(&self, u: S) -> S {
        let [_, q1, q2] = self.quotient;
        q2.mul_add(u * 2.0, q1)
    }
}

/// The zeros of U on both sides of where it is least, well apart: Newton's method from 1/√(−B), then on
/// the deflated cubic.
#[inline(always)]
fn zeros<S: Scalar>(potential: &Potential<S>, least: S) -> [S; 2] {
    let Potential { b, c, q } = *potential;
    let mut u1 = (-b).sqrt().recip();
    for _ in 0..5 {
        u1 -= potential.at(u1) / (potential.half_slope(u1) * 2.0);
    }
    let k2 = c * 2.0 - q * u1;
    let k1 = b + k2 * u1;
    let k0 = k1 * u1;
    let mut u2 = least * 1.5;
    for _ in 0..6 {
        let value = u2.mul_add(u2.mul_add(k2 - q * u2, k1), k0);
        let slope = u2.mul_add(k2 * 2.0 - q * u2 * 3.0, k1);
        u2 -= value / slope;
    }
    [u1, u2]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The product is U, to rounding, wherever a motion is factored: everywhere on the screens of holes of any
    /// spin.
    #[test]
    fn product() {
        for spin in [0.0, 1e-8, 0.5, 0.998, 1.0, -0.3, -0.9999, -1.0_f64] {
            for (row, column) in (0..60 * 60).map(|k| (k / 60, k % 60)) {
                let (lambda, height) = (f64::from(row) * 0.4 - 12.0, f64::from(column) * 0.2);
                let eta = height * height;
                let b = spin * spin - lambda * lambda - eta;
                let potential = Potential { b, c: (lambda - spin).powi(2) + eta, q: spin * spin * eta };
                let least = potential.least();
                let value = potential.at(least);
                if b >= 0.0 || !(potential.discriminant() >= 0.0) || value > 0.6 || least > 3.0 {
                    continue;
                }
                let factors = if value < -0.5 {
                    Factors::around_least::<true>(&potential)
                } else {
                    Factors::around_least::<false>(&potential)
                };
                let sign = if value > 0.0 { 1.0 } else { -1.0 };
                for u in [0.0, 0.1, 0.3, 0.5, 1.0] {
                    let x = u - factors.middle;
                    let product = (x * x + sign * factors.width.powi(2)) * factors.quotient_at(u);
                    let error = (product - potential.at(u)).abs() / (1.0 + b.abs() * u * u);
                    assert!(error < 2e-13, "a = {spin}, λ = {lambda}, η = {eta}, u = {u}: {error:e}");
                }
            }
        }
    }
}

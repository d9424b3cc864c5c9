//! The radius at a given Mino time.

use super::photon::Potential;
use crate::scalar::Scalar;

/// Doublings of the argument of ℘.
const DOUBLINGS: i32 = 5;

/// u(τ) for u′² = U(u), from u₀ at τ = 0, with u′ of the sign `inwards` (±1) there.
///
/// Biermann 1865 and Weierstrass (Whittaker & Watson 1927, 20.6 example 2; Reynolds 1989, J. Phys. A 22,
/// L723): with the invariants of the quartic
///   g₂ = B²/12 − Q,   g₃ = −QB/6 − B³/216 − C²/4,   P = ℘(τ) − U″/24,
///   u = u₀ + [½U′P + U U‴/24 ∓ √U ℘′]/[2P² + UQ/2],   U and its derivatives at u₀.
/// ℘ and ℘′ come from their Laurent series at τ/32 and five doublings,
///   S = (6℘² − g₂/2)/℘′,   ℘(2z) = S²/4 − 2℘,   ℘′(2z) = −[℘′ + S(℘(2z) − ℘)].
/// Each of these loses a digit, for ℘ ≈ z⁻². With `CAREFUL` they are multiplied out, which takes twice as long, and none is lost:
///   ℘(2z) = [(℘² + g₂/4)² + 2g₃℘]/℘′²,
///   ℘′(2z) = [4℘⁶ − 5g₂℘⁴ − 20g₃℘³ − (5/4)g₂²℘² − g₂g₃℘ − 2g₃² + g₂³/16]/(2℘′³).
#[inline(always)]
pub fn inverse_radius<S: Scalar, const CAREFUL: bool>(
    potential: &Potential<S>,
    u0: S,
    inwards: S,
    tau: S,
) -> S {
    let Potential { b, c, q } = *potential;
    let g2 = b * b * (1.0 / 12.0) - q;
    let g3 = -(q * b * (1.0 / 6.0) + b * b * b * (1.0 / 216.0) + c * c * 0.25);
    let z = tau * 0.5f64.powi(DOUBLINGS);
    let z2 = z * z;
    // ℘ = z⁻² + Σ c_k z^(2k−2) (Abramowitz & Stegun 1964, 18.5.1 to 18.5.4).
    let c2 = g2 * (1.0 / 20.0);
    let c3 = g3 * (1.0 / 28.0);
    let c4 = c2 * c2 * (1.0 / 3.0);
    let c5 = c2 * c3 * (3.0 / 11.0);
    let c6 = (c2 * c4 * 2.0 + c3 * c3) * (1.0 / 13.0);
    let c7 = (c2 * c5 + c3 * c4) * (2.0 / 20.0);
    let c8 = ((c2 * c6 + c3 * c5) * 2.0 + c4 * c4) * (3.0 / 85.0);
    let series = [c8, c7, c6, c5, c4, c3, c2];
    let inverse = z.recip();
    let inverse2 = inverse * inverse;
    let mut p = series[0];
    let mut slope = series[0] * 14.0;
    for (k, &coefficient) in series.iter().enumerate().skip(1) {
        p = p.mul_add(z2, coefficient);
        slope = slope.mul_add(z2, coefficient * (14.0 - 2.0 * k as f64));
    }
    p = p.mul_add(z2, inverse2);
    slope = slope.mul_add(z, inverse2 * inverse * -2.0);
    for _ in 0..DOUBLINGS {
        if CAREFUL {
            let per_slope = slope.recip();
            let square = p * p;
            let whole = square + g2 * 0.25;
            let double = (whole * whole + g3 * p * 2.0) * (per_slope * per_slope);
            // By powers of ℘.
            let last = g2 * g2 * g2 * (1.0 / 16.0) - g3 * g3 * 2.0;
            let rest = ((g2 * square * -5.0 - g3 * p * 20.0 - g2 * g2 * 1.25) * square - g2 * g3 * p) + last;
            slope = (square * square * square * 4.0 + rest) * 0.5 * (per_slope * per_slope * per_slope);
            p = double;
            continue;
        }
        let s = ((p * p) * 6.0 - g2 * 0.5) / slope;
        let double = (s * s).mul_add(s.constant(0.25), p * -2.0);
        slope = -(s.mul_add(double - p, slope));
        p = double;
    }
    let value = potential.at(u0);
    let half_slope = potential.half_slope(u0);
    let second = u0.mul_add(c * 12.0 - q * u0 * 12.0, b * 2.0);
    let third = c * 12.0 - q * u0 * 24.0;
    let shifted = p - second * (1.0 / 24.0);
    let root = value.max(u0.constant(0.0)).sqrt();
    let numerator = half_slope * shifted + value * third * (1.0 / 24.0) - inwards * root * slope;
    u0 + numerator / ((shifted * shifted).mul_add(u0.constant(2.0), value * q * 0.5))
}

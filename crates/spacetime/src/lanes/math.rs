//! Elementary functions of eight numbers at once, without branches. Their errors, against the exact
//! values, are below 2 units in the last place (sine, cosine: 2⁻⁵² absolute) in the ranges stated;
//! outside them nothing is promised.

use super::Lanes;
use crate::scalar::Scalar;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8, u64x8};
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, LN_2, LOG2_E, PI, SQRT_2};

/// 1.5 · 2⁵²: added to a number of size below 2⁵¹ it leaves the nearest whole number in the low bits.
const SHIFTER: f64 = 6755399441055744.0;

/// ln 2 less its first 32 bits, and those.
const LN_2_HIGH: f64 = 0.693147180369123816490;
const LN_2_LOW: f64 = 1.90821492927058770002e-10;

/// π/2 in three parts of 33, 33 and 53 bits.
const HALF_PI: [f64; 3] = [1.57079632673412561417, 6.07710050630396597660e-11, 2.02226624879595063154e-21];

/// tan(π/8).
const TAN_PI_8: f64 = 0.414213562373095048802;

/// (arctan(√z)/√z − 1)/z on [0, tan²(π/8)]: the best polynomial of degree 10 (Remez), error 5e-18.
const ARCTANGENT: [f64; 11] = [
    -0.019176887119062258989,
    0.039231658295587191303,
    -0.050854497379402598613,
    0.058581489128022098816,
    -0.066645114473819480001,
    0.076921831908260865637,
    -0.090909045781239018905,
    0.11111111015256361727,
    -0.14285714284666542922,
    0.19999999999995520678,
    -0.33333333333333330160,
];

/// 1/k! for k from 13 down to 2.
const EXPONENTIAL: [f64; 12] = [
    1.0 / 6227020800.0,
    1.0 / 479001600.0,
    1.0 / 39916800.0,
    1.0 / 3628800.0,
    1.0 / 362880.0,
    1.0 / 40320.0,
    1.0 / 5040.0,
    1.0 / 720.0,
    1.0 / 120.0,
    1.0 / 24.0,
    1.0 / 6.0,
    0.5,
];

/// 2/(2k + 1) for k from 11 down to 1: ln m = 2 artanh t = 2t + t³ (2/3 + 2t²/5 + …).
const LOGARITHM: [f64; 11] = [
    2.0 / 23.0,
    2.0 / 21.0,
    2.0 / 19.0,
    2.0 / 17.0,
    2.0 / 15.0,
    2.0 / 13.0,
    2.0 / 11.0,
    2.0 / 9.0,
    2.0 / 7.0,
    2.0 / 5.0,
    2.0 / 3.0,
];

/// ∓1/k! of the sine's series after x, from x¹⁷ down to x³, and of the cosine's after 1.
const SINE: [f64; 8] = [
    1.0 / 355687428096000.0,
    -1.0 / 1307674368000.0,
    1.0 / 6227020800.0,
    -1.0 / 39916800.0,
    1.0 / 362880.0,
    -1.0 / 5040.0,
    1.0 / 120.0,
    -1.0 / 6.0,
];
const COSINE: [f64; 8] = [
    1.0 / 20922789888000.0,
    -1.0 / 87178291200.0,
    1.0 / 479001600.0,
    -1.0 / 3628800.0,
    1.0 / 40320.0,
    -1.0 / 720.0,
    1.0 / 24.0,
    -0.5,
];

impl<L: Simd> Lanes<L> {
    /// Σ coefficients, the highest power first.
    #[inline(always)]
    fn polynomial<const N: usize>(self, coefficients: &[f64; N]) -> Self {
        let mut sum = self.constant(coefficients[0]);
        for &c in &coefficients[1..] {
            sum = sum.mul_add(self, self.constant(c));
        }
        sum
    }

    #[inline(always)]
    fn bits(self) -> u64x8<L> {
        self.0.to_bits()
    }

    #[inline(always)]
    fn from_bits(bits: u64x8<L>) -> Self {
        Self(f64x8::from_bits(bits))
    }

    #[inline(always)]
    fn bit_constant(self, bits: u64) -> u64x8<L> {
        u64x8::splat(self.0.token(), bits)
    }

    /// The nearest whole number for |x| below 2⁵¹; without the instruction for it the processor's own way is a
    /// library call a lane.
    #[inline(always)]
    pub(super) fn nearest(self) -> Self {
        (self + SHIFTER) - SHIFTER
    }

    /// eˣ for x from −700 to 700; what is beyond is taken as these.
    #[inline(always)]
    pub(super) fn exponential(self) -> Self {
        let x = self.max(self.constant(-700.0)).min(self.constant(700.0));
        let n = (x * LOG2_E).round();
        let f = n.mul_add(x.constant(-LN_2_LOW), n.mul_add(x.constant(-LN_2_HIGH), x));
        let rest = f.polynomial(&EXPONENTIAL);
        let power = (f * f).mul_add(rest, f) + 1.0;
        // n + 1023 in the low bits of the sum becomes the exponent of 2ⁿ.
        let scale = Self::from_bits((n + (SHIFTER + 1023.0)).bits() << 52);
        power * scale
    }

    /// ln x for normal positive numbers.
    #[inline(always)]
    pub(super) fn logarithm(self) -> Self {
        let bits = self.bits();
        // The exponent as a number: 2⁵² + e is written by its bits.
        let exponent = (bits >> 52) | self.bit_constant(0x4330_0000_0000_0000);
        let n = Self::from_bits(exponent) - (4503599627370496.0 + 1023.0);
        let mantissa =
            (bits & self.bit_constant(0x000f_ffff_ffff_ffff)) | self.bit_constant(0x3ff0_0000_0000_0000);
        let m = Self::from_bits(mantissa);
        let large = self.constant(SQRT_2).less(m);
        let m = Self::select(large, m * 0.5, m);
        let n = Self::select(large, n + 1.0, n);
        let t = (m - 1.0) / (m + 1.0);
        let t2 = t * t;
        // 2t + … = (m − 1) − t (m − 1 − t²…): the first term is exact.
        let f = m - 1.0;
        let series = t2 * t2.polynomial(&LOGARITHM);
        let log = f - t * (f - series);
        n.mul_add(self.constant(LN_2_HIGH), n.mul_add(self.constant(LN_2_LOW), log))
    }

    /// Sine and cosine for |x| up to 10⁵.
    #[inline(always)]
    pub(super) fn sine_cosine(self) -> (Self, Self) {
        let n = (self * FRAC_2_PI).round();
        let mut f = self;
        for part in HALF_PI {
            f = n.mul_add(self.constant(-part), f);
        }
        let f2 = f * f;
        let sin = (f * f2).mul_add(f2.polynomial(&SINE), f);
        let cos = f2.mul_add(f2.polynomial(&COSINE), self.constant(1.0));
        // The quadrant is in the lowest two bits.
        let quadrant = (n + SHIFTER).bits();
        let one = self.bit_constant(1);
        let odd = (quadrant & one).simd_eq(one);
        let (first, second) = (odd.select(cos.0, sin.0), odd.select(sin.0, cos.0));
        let sign = |quadrant: u64x8<L>| (quadrant & self.bit_constant(2)) << 62;
        let flip = |x: f64x8<L>, sign: u64x8<L>| Self::from_bits(x.to_bits() ^ sign);
        (flip(first, sign(quadrant)), flip(second, sign(quadrant + one)))
    }

    /// The angle of (x, y) = (`x`, `self`) in [−π, π]; of the origin, 0 or π as the sign of x is.
    #[inline(always)]
    pub(super) fn angle(self, x: Self) -> Self {
        let (ax, ay) = (x.abs(), self.abs());
        let steep = ax.less(ay);
        let large = Self::select(steep, ay, ax);
        let small = Self::select(steep, ax, ay);
        // arctan t = π/4 + arctan((t − 1)/(t + 1)) keeps the argument below tan π/8.
        let wide = (large * TAN_PI_8).less(small);
        let numerator = Self::select(wide, small - large, small);
        let denominator = Self::select(wide, small + large, large);
        let t = numerator / denominator.max(self.constant(f64::MIN_POSITIVE));
        let t2 = t * t;
        let arc = (t * t2).mul_add(t2.polynomial(&ARCTANGENT), t);
        let arc = Self::select(wide, arc + FRAC_PI_4, arc);
        let arc = Self::select(steep, -arc + FRAC_PI_2, arc);
        let arc = Self(arc.0.copysign(self.constant(1.0).0));
        let negative = (x.bits() >> 63).simd_eq(self.bit_constant(1));
        let arc = Self(negative.select((-arc + PI).0, arc.0));
        Self(arc.0.copysign(self.0))
    }
}

/// The parts of ln 2 are that.
const _: () = assert!(LN_2_HIGH + LN_2_LOW == LN_2);

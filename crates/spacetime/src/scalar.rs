//! The one numeric trait: kernels are written once and run on `f64`, on dual
//! numbers (exact derivatives) and on SIMD lanes (many rays at once).
//!
//! A lane type carries a proof of which instructions the processor has, so a
//! number cannot be made from nothing: constants either enter as the `f64` operand
//! of an operator (`x * 2.0`) or are made beside an existing number
//! (`x.constant(2.0)`).

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// A real number, a bundle of them, or one with derivatives.
///
/// Comparisons look at values, never at derivatives.
///
/// ```
/// use kerrscope_spacetime::Scalar;
/// fn hypotenuse<S: Scalar>(x: S, y: S) -> S {
///     x.mul_add(x, y * y).sqrt()
/// }
/// assert_eq!(hypotenuse(3.0, 4.0), 5.0);
/// ```
pub trait Scalar:
    Copy
    + Debug
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
{
    /// The outcome of a comparison, lane by lane.
    type Mask: Copy + Debug;

    /// How many real numbers one scalar holds.
    const LANES: usize;

    /// How often it is differentiated. Newton's method and the like take as many steps more, since
    /// derivatives lag one step behind the value.
    const ORDER: usize = 0;

    /// `value` in every lane, with no derivatives.
    fn constant(self, value: f64) -> Self;
    /// self·a + b, fused where the processor does that as fast as a product.
    fn mul_add(self, a: Self, b: Self) -> Self;
    /// √self; NaN for a negative number.
    fn sqrt(self) -> Self;
    /// 1/self.
    fn recip(self) -> Self;
    /// |self|.
    fn abs(self) -> Self;
    /// The smaller of two.
    fn min(self, other: Self) -> Self;
    /// The larger of two.
    fn max(self, other: Self) -> Self;
    /// Sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);
    /// e^self.
    fn exp(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// The angle of (x, y) = (`x`, `self`) in (−π, π].
    fn atan2(self, x: Self) -> Self;
    /// self < other, lane by lane.
    fn less(self, other: Self) -> Self::Mask;
    /// Whether the mask is true in any lane.
    fn any(mask: Self::Mask) -> bool;
    /// `a` where the mask is true, else `b`.
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self;
    /// The nearest whole number; halves go to the even one.
    fn round(self) -> Self;
    /// The real number in one lane; `lane` must be below [`Scalar::LANES`].
    fn lane(self, lane: usize) -> f64;

    /// Runs a large part of a kernel as a function of its own, compiled for the same instructions: what
    /// is inlined everywhere takes a compiler minutes.
    #[inline(always)]
    fn outline<R>(self, part: impl FnOnce() -> R) -> R {
        part()
    }

    /// The same value without its derivatives: where an iteration starts or a course is chosen they say nothing.
    #[inline(always)]
    fn still(self) -> Self {
        self
    }

    /// self², exactly as `self * self`.
    #[inline(always)]
    fn squared(self) -> Self {
        self * self
    }
}

impl Scalar for f64 {
    type Mask = bool;
    const LANES: usize = 1;

    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        // Without the instruction a fused product is a library call, some 20 times slower.
        if cfg!(target_feature = "fma") { Self::mul_add(self, a, b) } else { self * a + b }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::sqrt(self)
    }
    #[inline(always)]
    fn recip(self) -> Self {
        1.0 / self
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self::abs(self)
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        Self::sin_cos(self)
    }
    #[inline(always)]
    fn exp(self) -> Self {
        Self::exp(self)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        Self::ln(self)
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        Self::atan2(self, x)
    }
    #[inline(always)]
    fn less(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn outline<R>(self, part: impl FnOnce() -> R) -> R {
        #[inline(never)]
        fn apart<R>(part: impl FnOnce() -> R) -> R {
            part()
        }
        apart(part)
    }
    #[inline(always)]
    fn any(mask: bool) -> bool {
        mask
    }
    #[inline(always)]
    fn select(mask: bool, a: Self, b: Self) -> Self {
        if mask { a } else { b }
    }
    #[inline(always)]
    fn round(self) -> Self {
        self.round_ties_even()
    }
    #[inline(always)]
    fn lane(self, _lane: usize) -> f64 {
        self
    }
}

//! Dual numbers: a value with its exact first derivatives.
//!
//! x + Σ xᵢ εᵢ with εᵢ εⱼ = 0, so that f(x) carries f′(x) xᵢ along: forward-mode
//! differentiation without truncation error. Nesting gives higher derivatives.

use crate::scalar::Scalar;
use crate::tensor::each;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// A value and its derivatives in `N` directions, over any scalar.
///
/// ```
/// use kerrscope_spacetime::{Dual, Scalar};
/// // d/dx (x² sin x) at x = 2
/// let x = Dual::variable([2.0], 0);
/// let f = x * x * x.sin_cos().0;
/// let exact = 4.0 * 2f64.sin() + 4.0 * 2f64.cos();
/// assert!((f.gradient[0] - exact).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<S, const N: usize> {
    /// The value.
    pub value: S,
    /// ∂value/∂(variable i).
    pub gradient: [S; N],
}

impl<S: Scalar, const N: usize> Dual<S, N> {
    /// Variable number `index` of `point`: its derivative in direction `index` is one.
    #[inline(always)]
    pub fn variable(point: [S; N], index: usize) -> Self {
        let value = point[index];
        let mut gradient = [value.constant(0.0); N];
        gradient[index] = value.constant(1.0);
        Self { value, gradient }
    }

    /// All variables of `point` at once.
    #[inline(always)]
    pub fn variables(point: [S; N]) -> [Self; N] {
        each(
            #[inline(always)]
            |i| Self::variable(point, i),
        )
    }

    /// A number that depends on no variable.
    #[inline(always)]
    pub fn fixed(value: S) -> Self {
        Self { value, gradient: [value.constant(0.0); N] }
    }

    /// f(self) from f and f′ at the value.
    #[inline(always)]
    fn chain(self, value: S, slope: S) -> Self {
        Self {
            value,
            gradient: each(
                #[inline(always)]
                |i| self.gradient[i] * slope,
            ),
        }
    }

    #[inline(always)]
    fn zip(self, other: Self, value: S, f: impl Fn(S, S) -> S) -> Self {
        Self {
            value,
            gradient: each(
                #[inline(always)]
                |i| f(self.gradient[i], other.gradient[i]),
            ),
        }
    }
}

impl<S: Scalar, const N: usize> Neg for Dual<S, N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self {
            value: -self.value,
            gradient: each(
                #[inline(always)]
                |i| -self.gradient[i],
            ),
        }
    }
}

impl<S: Scalar, const N: usize> Add for Dual<S, N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(
            other,
            self.value + other.value,
            #[inline(always)]
            |a, b| a + b,
        )
    }
}

impl<S: Scalar, const N: usize> Sub for Dual<S, N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(
            other,
            self.value - other.value,
            #[inline(always)]
            |a, b| a - b,
        )
    }
}

impl<S: Scalar, const N: usize> Mul for Dual<S, N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(
            other,
            self.value * other.value,
            #[inline(always)]
            |a, b| a.mul_add(other.value, self.value * b),
        )
    }
}

impl<S: Scalar, const N: usize> Div for Dual<S, N> {
    type Output = Self;
    #[inline(always)]
    // The quotient rule: (a/b)′ = (a′ − (a/b) b′)/b.
    #[expect(clippy::suspicious_arithmetic_impl)]
    fn div(self, other: Self) -> Self {
        let inverse = other.value.recip();
        let value = self.value * inverse;
        self.zip(
            other,
            value,
            #[inline(always)]
            |a, b| (a - value * b) * inverse,
        )
    }
}

impl<S: Scalar, const N: usize> Add<f64> for Dual<S, N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: f64) -> Self {
        Self { value: self.value + other, ..self }
    }
}

impl<S: Scalar, const N: usize> Sub<f64> for Dual<S, N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: f64) -> Self {
        Self { value: self.value - other, ..self }
    }
}

impl<S: Scalar, const N: usize> Mul<f64> for Dual<S, N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        Self {
            value: self.value * other,
            gradient: each(
                #[inline(always)]
                |i| self.gradient[i] * other,
            ),
        }
    }
}

impl<S: Scalar, const N: usize> Div<f64> for Dual<S, N> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: f64) -> Self {
        Self {
            value: self.value / other,
            gradient: each(
                #[inline(always)]
                |i| self.gradient[i] / other,
            ),
        }
    }
}

impl<S: Scalar, const N: usize> AddAssign for Dual<S, N> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<S: Scalar, const N: usize> SubAssign for Dual<S, N> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<S: Scalar, const N: usize> MulAssign for Dual<S, N> {
    #[inline(always)]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl<S: Scalar, const N: usize> Scalar for Dual<S, N> {
    type Mask = S::Mask;
    const LANES: usize = S::LANES;
    const ORDER: usize = S::ORDER + 1;

    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self::fixed(self.value.constant(value))
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        self * a + b
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, root.recip() * 0.5)
    }
    #[inline(always)]
    fn recip(self) -> Self {
        let inverse = self.value.recip();
        self.chain(inverse, -(inverse * inverse))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self::select(self.value.less(self.value.constant(0.0)), -self, self)
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self::select(self.less(other), self, other)
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self::select(other.less(self), self, other)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (self.chain(sin, cos), self.chain(cos, -sin))
    }
    #[inline(always)]
    fn exp(self) -> Self {
        let e = self.value.exp();
        self.chain(e, e)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        self.chain(self.value.ln(), self.value.recip())
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        let inverse = (self.value.squared() + x.value.squared()).recip();
        let (along_y, along_x) = (x.value * inverse, self.value * inverse);
        self.zip(
            x,
            self.value.atan2(x.value),
            #[inline(always)]
            |dy, dx| dy * along_y - dx * along_x,
        )
    }
    #[inline(always)]
    fn outline<R>(self, part: impl FnOnce() -> R) -> R {
        self.value.outline(part)
    }
    #[inline(always)]
    fn still(self) -> Self {
        Self::fixed(self.value.still())
    }
    #[inline(always)]
    fn any(mask: Self::Mask) -> bool {
        S::any(mask)
    }
    /// A step function: its derivatives are zero.
    #[inline(always)]
    fn round(self) -> Self {
        Self::fixed(self.value.round())
    }
    #[inline(always)]
    fn less(self, other: Self) -> Self::Mask {
        self.value.less(other.value)
    }
    #[inline(always)]
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self {
        a.zip(
            b,
            S::select(mask, a.value, b.value),
            #[inline(always)]
            |x, y| S::select(mask, x, y),
        )
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        self.value.lane(lane)
    }
}

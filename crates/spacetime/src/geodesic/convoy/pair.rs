//! Two numbers as one, so that the processor has other work while one of them waits for a quotient or a root.

use crate::scalar::Scalar;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// Two scalars on which everything is done side by side.
#[derive(Clone, Copy, Debug)]
pub struct Pair<S>(pub S, pub S);

macro_rules! operator {
    ($trait:ident, $method:ident) => {
        impl<S: Scalar> $trait for Pair<S> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0), self.1.$method(other.1))
            }
        }
        impl<S: Scalar> $trait<f64> for Pair<S> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: f64) -> Self {
                Self(self.0.$method(other), self.1.$method(other))
            }
        }
    };
    ($trait:ident, $method:ident, $assign:ident, $assign_method:ident) => {
        operator!($trait, $method);
        impl<S: Scalar> $assign for Pair<S> {
            #[inline(always)]
            fn $assign_method(&mut self, other: Self) {
                *self = self.$method(other);
            }
        }
    };
}

operator!(Add, add, AddAssign, add_assign);
operator!(Sub, sub, SubAssign, sub_assign);
operator!(Mul, mul, MulAssign, mul_assign);
operator!(Div, div);

impl<S: Scalar> Neg for Pair<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl<S: Scalar> Scalar for Pair<S> {
    type Mask = (S::Mask, S::Mask);
    const LANES: usize = 2 * S::LANES;

    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        let both = self.0.constant(value);
        Self(both, both)
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        Self(self.0.mul_add(a.0, b.0), self.1.mul_add(a.1, b.1))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt(), self.1.sqrt())
    }
    #[inline(always)]
    fn recip(self) -> Self {
        Self(self.0.recip(), self.1.recip())
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs(), self.1.abs())
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0), self.1.min(other.1))
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0), self.1.max(other.1))
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let ((s0, c0), (s1, c1)) = (self.0.sin_cos(), self.1.sin_cos());
        (Self(s0, s1), Self(c0, c1))
    }
    #[inline(always)]
    fn exp(self) -> Self {
        Self(self.0.exp(), self.1.exp())
    }
    #[inline(always)]
    fn ln(self) -> Self {
        Self(self.0.ln(), self.1.ln())
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        Self(self.0.atan2(x.0), self.1.atan2(x.1))
    }
    #[inline(always)]
    fn less(self, other: Self) -> Self::Mask {
        (self.0.less(other.0), self.1.less(other.1))
    }
    #[inline(always)]
    fn any(mask: Self::Mask) -> bool {
        S::any(mask.0) || S::any(mask.1)
    }
    #[inline(always)]
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self {
        Self(S::select(mask.0, a.0, b.0), S::select(mask.1, a.1, b.1))
    }
    #[inline(always)]
    fn round(self) -> Self {
        Self(self.0.round(), self.1.round())
    }
    #[inline(always)]
    fn outline<R>(self, part: impl FnOnce() -> R) -> R {
        self.0.outline(part)
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        if lane < S::LANES { self.0.lane(lane) } else { self.1.lane(lane - S::LANES) }
    }
}

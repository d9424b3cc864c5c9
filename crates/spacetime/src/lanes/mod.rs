//! Eight rays at once: a scalar whose every operation acts on eight numbers.
//!
//! `L` proves which instructions the processor has (AVX-512, AVX2, SSE2, …), found
//! at run time; on lesser levels one operation is several instructions.

mod level;
mod math;

pub use level::{Level, OnLanes};

use crate::scalar::Scalar;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8, mask64x8};
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// Eight `f64` side by side.
///
/// ```
/// use fearless_simd::{Level, dispatch};
/// use kerrscope_spacetime::{Lanes, Scalar};
/// let roots = dispatch!(Level::new(), simd => {
///     Lanes::new(simd, [0.0, 1.0, 4.0, 9.0, 16.0, 25.0, 36.0, 49.0]).sqrt().to_array()
/// });
/// assert_eq!(roots, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Lanes<L: Simd>(f64x8<L>);

impl<L: Simd> Lanes<L> {
    /// Eight numbers, for the instructions that `simd` proves.
    #[inline(always)]
    pub fn new(simd: L, values: [f64; 8]) -> Self {
        Self(values.simd_into(simd))
    }

    /// Which lanes of a mask are true, the first in the lowest bit.
    #[inline(always)]
    pub(crate) fn mask_bits(mask: mask64x8<L>) -> u64 {
        mask.to_bitmask()
    }

    /// The lanes whose bits are set.
    #[inline(always)]
    pub(crate) fn bits_mask(simd: L, bits: u64) -> mask64x8<L> {
        mask64x8::from_bitmask(simd, bits)
    }

    /// The eight numbers.
    #[inline(always)]
    pub fn to_array(self) -> [f64; 8] {
        self.0.into()
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $assign:ident, $assign_method:ident) => {
        impl<L: Simd> $trait for Lanes<L> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0))
            }
        }
        operator!($trait, $method);
        impl<L: Simd> $assign for Lanes<L> {
            #[inline(always)]
            fn $assign_method(&mut self, other: Self) {
                *self = self.$method(other);
            }
        }
    };
    ($trait:ident, $method:ident) => {
        impl<L: Simd> $trait<f64> for Lanes<L> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: f64) -> Self {
                Self(self.0.$method(other))
            }
        }
    };
}

operator!(Add, add, AddAssign, add_assign);
operator!(Sub, sub, SubAssign, sub_assign);
operator!(Mul, mul, MulAssign, mul_assign);
operator!(Div, div);

impl<L: Simd> Div for Lanes<L> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self(self.0 / other.0)
    }
}

impl<L: Simd> Neg for Lanes<L> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<L: Simd> Scalar for Lanes<L> {
    type Mask = mask64x8<L>;
    const LANES: usize = 8;

    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self(value.simd_into(self.0.token()))
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        Self(self.0.mul_add(a.0, b.0))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    #[inline(always)]
    fn recip(self) -> Self {
        self.constant(1.0) / self
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0))
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0))
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        self.sine_cosine()
    }
    #[inline(always)]
    fn exp(self) -> Self {
        self.exponential()
    }
    #[inline(always)]
    fn ln(self) -> Self {
        self.logarithm()
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        self.angle(x)
    }
    #[inline(always)]
    fn less(self, other: Self) -> Self::Mask {
        self.0.simd_lt(other.0)
    }
    #[inline(always)]
    fn outline<R>(self, part: impl FnOnce() -> R) -> R {
        self.0.token().vectorize(part)
    }
    #[inline(always)]
    fn any(mask: Self::Mask) -> bool {
        mask.any_true()
    }
    #[inline(always)]
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self {
        Self(mask.select(a.0, b.0))
    }
    #[inline(always)]
    fn round(self) -> Self {
        self.nearest()
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        self.0[lane]
    }
}

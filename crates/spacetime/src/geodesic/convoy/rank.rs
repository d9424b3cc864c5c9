//! Rays side by side as one number: eight lanes, or twice eight.

use super::pair::Pair;
use crate::lanes::Lanes;
use crate::scalar::Scalar;
use fearless_simd::Simd;

/// A scalar whose `W` lanes are filled from arrays and looked at one by one.
pub trait Rank<L: Simd, const W: usize>: Scalar {
    /// The numbers of an array.
    fn gather(simd: L, values: &[f64; W]) -> Self;
    /// The array of its numbers.
    fn scatter(self) -> [f64; W];
    /// Which lanes of a mask are true, the first in the lowest bit.
    fn bits(mask: Self::Mask) -> u64;
    /// The lanes whose bits are set.
    fn mask(simd: L, bits: u64) -> Self::Mask;
}

impl<L: Simd> Rank<L, 8> for Lanes<L> {
    #[inline(always)]
    fn gather(simd: L, values: &[f64; 8]) -> Self {
        Self::new(simd, *values)
    }
    #[inline(always)]
    fn scatter(self) -> [f64; 8] {
        self.to_array()
    }
    #[inline(always)]
    fn bits(mask: Self::Mask) -> u64 {
        Self::mask_bits(mask)
    }
    #[inline(always)]
    fn mask(simd: L, bits: u64) -> Self::Mask {
        Self::bits_mask(simd, bits)
    }
}

impl<L: Simd> Rank<L, 16> for Pair<Lanes<L>> {
    #[inline(always)]
    fn gather(simd: L, values: &[f64; 16]) -> Self {
        let (mut first, mut second) = ([0.0; 8], [0.0; 8]);
        first.copy_from_slice(&values[..8]);
        second.copy_from_slice(&values[8..]);
        Self(Lanes::new(simd, first), Lanes::new(simd, second))
    }
    #[inline(always)]
    fn scatter(self) -> [f64; 16] {
        let mut values = [0.0; 16];
        values[..8].copy_from_slice(&self.0.to_array());
        values[8..].copy_from_slice(&self.1.to_array());
        values
    }
    #[inline(always)]
    fn bits((first, second): Self::Mask) -> u64 {
        Lanes::mask_bits(first) | Lanes::mask_bits(second) << 8
    }
    #[inline(always)]
    fn mask(simd: L, bits: u64) -> Self::Mask {
        (Lanes::bits_mask(simd, bits & 0xff), Lanes::bits_mask(simd, bits >> 8))
    }
}

/// Many arrays as many numbers.
#[inline(always)]
pub fn gather<L: Simd, S: Rank<L, W>, const D: usize, const W: usize>(
    simd: L,
    columns: &[[f64; W]; D],
) -> [S; D] {
    let mut all = [S::gather(simd, &columns[0]); D];
    for i in 1..D {
        all[i] = S::gather(simd, &columns[i]);
    }
    all
}

/// Many numbers as many arrays.
#[inline(always)]
pub fn scatter<L: Simd, S: Rank<L, W>, const D: usize, const W: usize>(all: &[S; D]) -> [[f64; W]; D] {
    let mut columns = [[0.0; W]; D];
    for i in 0..D {
        columns[i] = all[i].scatter();
    }
    columns
}

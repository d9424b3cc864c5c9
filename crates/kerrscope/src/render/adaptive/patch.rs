//! Interpolation of order 4 over a square.

use fearless_simd::Simd;

use crate::spacetime::{Lanes, Level, OnLanes, Scalar};

/// Knots along an edge.
pub(super) const KNOTS: usize = 5;

/// The polynomial of degree 4 in both x and y that takes given values at 5 × 5 knots, evenly spaced
/// over −1 ≤ x, y ≤ 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patch {
    /// Coefficients of yⁱ xʲ.
    terms: [[f64; KNOTS]; KNOTS],
    /// The least and the largest value that it can take within the square.
    pub(super) range: [f64; 2],
}

/// The sum of the moduli of the five Lagrange polynomials nowhere exceeds this (Lebesgue's constant,
/// 2.2078 for five evenly spaced knots).
const LEBESGUE: f64 = 2.208;

impl Patch {
    /// Through values along rows of growing y.
    pub(super) fn through(values: [[f64; KNOTS]; KNOTS]) -> Self {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values.as_flattened() {
            (low, high) = (low.min(*value), high.max(*value));
        }
        let (middle, reach) = (0.5 * (low + high), 0.5 * (high - low) * LEBESGUE * LEBESGUE);
        let along_x = values.map(coefficients);
        let mut terms = [[0.0; KNOTS]; KNOTS];
        for j in 0..KNOTS {
            let column = coefficients(along_x.map(|row| row[j]));
            for i in 0..KNOTS {
                terms[i][j] = column[i];
            }
        }
        Self { terms, range: [middle - reach, middle + reach] }
    }

    /// The value at a point.
    #[inline(always)]
    pub(super) fn at<S: Scalar>(&self, x: S, y: S) -> S {
        let mut sum = x.constant(0.0);
        for i in (0..KNOTS).rev() {
            let row = &self.terms[i];
            let mut along = x.constant(row[KNOTS - 1]);
            for j in (0..KNOTS - 1).rev() {
                along = along.mul_add(x, x.constant(row[j]));
            }
            sum = sum.mul_add(y, along);
        }
        sum
    }
}

/// Of the polynomial with values v at −1, −½, 0, ½, 1.
fn coefficients(v: [f64; KNOTS]) -> [f64; KNOTS] {
    // The odd part is c₁/2 + c₃/8 at ½ and c₁ + c₃ at 1; the even part c₂/4 + c₄/16 and c₂ + c₄.
    let (odd_half, odd) = (0.5 * (v[3] - v[1]), 0.5 * (v[4] - v[0]));
    let (even_half, even) = (0.5 * (v[3] + v[1]) - v[2], 0.5 * (v[4] + v[0]) - v[2]);
    let (third, fourth) = (4.0 / 3.0 * (odd - 2.0 * odd_half), 4.0 / 3.0 * (even - 4.0 * even_half));
    [v[2], odd - third, even - fourth, third, fourth]
}

/// Evaluates patches at points, eight at a time.
pub(super) struct Evaluate<'a> {
    pub(super) patches: &'a [Patch],
    pub(super) x: &'a [f64],
    pub(super) y: &'a [f64],
    /// Values of the first patch at all points, then those of the next.
    pub(super) values: &'a mut Vec<f64>,
}

impl Evaluate<'_> {
    pub(super) fn at_level(self, level: Level) {
        level.run(self);
    }
}

impl OnLanes for Evaluate<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Simd>(self, simd: L) {
        let Self { patches, x, y, values } = self;
        let count = x.len().min(y.len());
        values.clear();
        values.resize(patches.len() * count, 0.0);
        for first in (0..count).step_by(8) {
            let (px, py) = (take(simd, x, first), take(simd, y, first));
            for (number, patch) in patches.iter().enumerate() {
                put(patch.at(px, py), &mut values[number * count..(number + 1) * count], first);
            }
        }
    }
}

/// Eight numbers from a place on; zeros where there are no more.
#[inline(always)]
pub(super) fn take<L: Simd>(simd: L, numbers: &[f64], first: usize) -> Lanes<L> {
    let mut eight = [0.0; 8];
    let width = (numbers.len() - first).min(8);
    eight[..width].copy_from_slice(&numbers[first..first + width]);
    Lanes::new(simd, eight)
}

/// Puts eight numbers from a place on, as many as there is room for.
#[inline(always)]
pub(super) fn put<L: Simd>(eight: Lanes<L>, numbers: &mut [f64], first: usize) {
    let width = (numbers.len() - first).min(8);
    numbers[first..first + width].copy_from_slice(&eight.to_array()[..width]);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quartic(x: f64, y: f64) -> f64 {
        let f = |t: f64| 1.0 - 2.0 * t + 0.5 * t * t + 3.0 * t.powi(3) - 0.7 * t.powi(4);
        f(x) * f(0.3 - y) + x.powi(4) * y.powi(4)
    }

    fn patch(f: impl Fn(f64, f64) -> f64) -> Patch {
        let at = |i: usize| i as f64 / 2.0 - 1.0;
        Patch::through(std::array::from_fn(|i| std::array::from_fn(|j| f(at(j), at(i)))))
    }

    #[test]
    fn quartics_are_interpolated_exactly() {
        let patch = patch(quartic);
        for k in 0..100 {
            let [x, y] = [0.37, 0.71].map(|step| (f64::from(k) * step).rem_euclid(2.0) - 1.0);
            assert!((patch.at(x, y) - quartic(x, y)).abs() < 1e-13, "{x}, {y}");
        }
    }

    #[test]
    fn values_stay_within_their_range() {
        // The worst case of Lebesgue's constant: values ±1 by turns.
        let patch = Patch::through(std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                if [0, 3].contains(&(i % 4)) == [0, 3].contains(&(j % 4)) { 1.0 } else { -1.0 }
            })
        }));
        let [low, high] = patch.range;
        for k in 0..=100 {
            for l in 0..=100 {
                let value = patch.at(f64::from(k) / 50.0 - 1.0, f64::from(l) / 50.0 - 1.0);
                assert!((low..=high).contains(&value));
            }
        }
    }

    #[test]
    fn lanes_agree_with_one_by_one() {
        let patches = [patch(quartic), patch(|x, y| (x + 2.0 * y).sin())];
        let x: Vec<f64> = (0..21).map(|k| f64::from(k) / 10.0 - 1.0).collect();
        let y: Vec<f64> = x.iter().map(|x| 0.9 * x * x - 0.4).collect();
        for level in Level::ALL {
            let mut values = Vec::new();
            Evaluate { patches: &patches, x: &x, y: &y, values: &mut values }.at_level(level);
            for (number, patch) in patches.iter().enumerate() {
                for k in 0..x.len() {
                    let alone = patch.at(x[k], y[k]);
                    assert!((values[number * x.len() + k] - alone).abs() < 1e-13, "{level:?}");
                }
            }
        }
    }
}

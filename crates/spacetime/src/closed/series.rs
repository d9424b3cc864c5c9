//! Short Fourier series: smooth even periodic functions, and their integrals.

use std::f64::consts::PI;

use crate::scalar::Scalar;

/// cos(πj/N) for j from 0 to 2N − 1.
#[derive(Clone, Debug)]
pub struct Cosines<const N: usize>([[f64; N]; 2]);

impl<const N: usize> Cosines<N> {
    /// The table; N is even.
    pub fn new() -> Self {
        const { assert!(N.is_multiple_of(2), "the transform pairs values across the middle") };
        let at = |j: usize| (PI * j as f64 / N as f64).cos();
        Self([std::array::from_fn(at), std::array::from_fn(|j| at(j + N))])
    }

    /// cos(πj/N) for any j.
    #[inline(always)]
    pub fn of(&self, j: usize) -> f64 {
        let j = j % (2 * N);
        self.0[j / N][j % N]
    }
}

/// The integral over an angle of Σ aₖ cos kα, k from 0 to N: a₀α + Σ (aₖ/k) sin kα.
#[derive(Clone, Copy, Debug)]
pub struct Integral<S, const N: usize> {
    /// a₀: the mean of what is integrated.
    pub mean: S,
    /// aₖ/k.
    pub waves: [S; N],
}

impl<S: Scalar, const N: usize> Integral<S, N> {
    /// Of the series through values at α = πj/N, j from 0 to N − 1, and the `last` at π: a discrete cosine
    /// transform (DCT-I), values on both sides of the middle taken together.
    #[inline(always)]
    pub fn through(values: &[S; N], last: S, cosines: &Cosines<N>) -> Self {
        let half = N / 2;
        let (mut sums, mut differences) = ([last; N], [last; N]);
        for j in 0..half {
            let mirror = if j == 0 { last } else { values[N - j] };
            let ends = if j == 0 { 0.5 } else { 1.0 };
            sums[j] = (values[j] + mirror) * ends;
            differences[j] = (values[j] - mirror) * ends;
        }
        let mut mean = sums[0] + values[half];
        let mut waves = [last; N];
        for j in 1..half {
            mean += sums[j];
        }
        for k in 1..=N {
            let even = k % 2 == 0;
            let pairs = if even { &sums } else { &differences };
            let mut sum = pairs[0];
            for j in 1..half {
                sum = pairs[j].mul_add(last.constant(cosines.of(k * j)), sum);
            }
            if even {
                sum = if k % 4 == 0 { sum + values[half] } else { sum - values[half] };
            }
            // The last wave counts half.
            let whole = if k == N { 1.0 } else { 2.0 };
            waves[k - 1] = sum * (whole / (N * k) as f64);
        }
        Self { mean: mean * (1.0 / N as f64), waves }
    }

    /// At an angle with this sine and cosine.
    #[inline(always)]
    pub fn at(&self, angle: S, (sin, cos): (S, S)) -> S {
        self.mean.mul_add(angle, sines(&self.waves, sin, cos))
    }
}

/// Σ cₖ sin kα, k from 1 on, by Clenshaw's recurrence (1955, MTAC 9, 118).
#[inline(always)]
pub fn sines<S: Scalar>(coefficients: &[S], sin: S, cos: S) -> S {
    let twice = cos * 2.0;
    let (mut sum, mut before) = (sin.constant(0.0), sin.constant(0.0));
    for k in (0..coefficients.len()).rev() {
        (sum, before) = (twice.mul_add(sum, coefficients[k] - before), sum);
    }
    sum * sin
}

/// Σ cₖ cos kα, k from 1 on.
#[inline(always)]
pub fn cosines<S: Scalar>(coefficients: &[S], cos: S) -> S {
    let twice = cos * 2.0;
    let (mut sum, mut before) = (cos.constant(0.0), cos.constant(0.0));
    for k in (0..coefficients.len()).rev() {
        (sum, before) = (twice.mul_add(sum, coefficients[k] - before), sum);
    }
    sum * cos - before
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_series_integrates_what_it_is_made_of() {
        // f = 2 + cos α − 3 cos 4α + 0.5 cos 5α.
        const N: usize = 6;
        let f = |x: f64| 2.0 + x.cos() - 3.0 * (4.0 * x).cos() + 0.5 * (5.0 * x).cos();
        let integral = |x: f64| 2.0 * x + x.sin() - 0.75 * (4.0 * x).sin() + 0.1 * (5.0 * x).sin();
        let values = std::array::from_fn::<f64, N, _>(|j| f(PI * j as f64 / N as f64));
        let series = Integral::through(&values, f(PI), &Cosines::new());
        for x in [-4.0, -0.1, 0.0, 1e-9, 0.7, PI, 9.0] {
            let error = series.at(x, x.sin_cos()) - integral(x);
            assert!(error.abs() < 2e-14, "{x}: {error:e}");
        }
        let twelve: [f64; 12] = std::array::from_fn(|k| 1.0 / (k + 1) as f64);
        for x in [0.3f64, 2.9] {
            let direct: f64 = (1..=12).map(|k| (f64::from(k) * x).cos() / f64::from(k)).sum();
            assert!((cosines(&twelve, x.cos()) - direct).abs() < 1e-14);
        }
    }
}

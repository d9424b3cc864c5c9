//! Gauss–Legendre quadrature.

use std::f64::consts::PI;

/// The nodes and weights of Gauss–Legendre quadrature on [−1, 1] with an even number of nodes: the
/// positive half of them, the other half being their mirror image.
///
/// ```
/// use kerrscope_spacetime::closed::Nodes;
/// let nodes = Nodes::new(12);
/// let integral: f64 = nodes.half().iter().map(|&(x, w)| w * (x.exp() + (-x).exp())).sum();
/// assert!((integral - (1f64.exp() - (-1f64).exp())).abs() < 1e-15);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Nodes(Vec<(f64, f64)>);

impl Nodes {
    /// `count` nodes, even and at least 2; an odd number is rounded up.
    ///
    /// Newton's method on P_n from cos(π (k − ¼)/(n + ½)) (Abramowitz & Stegun 1964, 22.16.6);
    /// w = 2/[(1 − x²) P_n′²] (25.4.29).
    pub fn new(count: usize) -> Self {
        let count = 2 * count.max(1).div_ceil(2);
        let n = count as f64;
        let legendre = |x: f64| {
            let (mut before, mut value) = (1.0, x);
            for k in 2..=count {
                let k = k as f64;
                (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
            }
            (value, n * (x * value - before) / (x * x - 1.0))
        };
        let half = (1..=count / 2).rev().map(|k| {
            let mut x = (PI * (k as f64 - 0.25) / (n + 0.5)).cos();
            for _ in 0..8 {
                let (value, slope) = legendre(x);
                x -= value / slope;
            }
            let (_, slope) = legendre(x);
            (x, 2.0 / ((1.0 - x * x) * slope * slope))
        });
        Self(half.collect())
    }

    /// Positive nodes and their weights.
    pub fn half(&self) -> &[(f64, f64)] {
        &self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_integrated_exactly() {
        for count in [2, 12, 16, 32, 48] {
            let nodes = Nodes::new(count);
            assert_eq!(nodes.half().len(), count / 2);
            for power in (0..2 * count as u16).step_by(2) {
                let sum: f64 = nodes.half().iter().map(|(x, w)| 2.0 * w * x.powi(i32::from(power))).sum();
                assert!((sum - 2.0 / f64::from(power + 1)).abs() < 4e-15, "{count} nodes, x^{power}");
            }
        }
    }
}

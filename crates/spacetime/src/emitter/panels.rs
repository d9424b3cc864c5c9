//! Smooth functions, tabulated piece by piece.

use std::f64::consts::PI;

/// Chebyshev nodes of a piece.
pub const NODES: usize = 16;

/// Pieces are halved at most so often.
const DEEPEST: usize = 14;

/// Functions are taken to have no more noise than this share of their size.
const NOISE: f64 = 1e-8;

/// `N` functions of one variable as Chebyshev series on pieces of its range.
#[derive(Clone, Debug, PartialEq)]
pub struct Panels<const N: usize> {
    /// Where the pieces end, in the order of the variable.
    ends: Vec<f64>,
    /// The coefficients of each piece.
    pieces: Vec<[[f64; N]; NODES]>,
    error: f64,
}

impl<const N: usize> Panels<N> {
    /// Tabulates `functions` from `from` to `to` > `from`, the largest difference found between nodes being `tolerance` times
    /// the function's largest value in that piece, or as near as pieces of 2⁻¹⁴ of the range come to it. The functions are asked
    /// piece by piece, in order but for pieces that have to be halved, and told where the piece begins.
    pub fn new(
        [from, to]: [f64; 2],
        tolerance: f64,
        mut functions: impl FnMut(f64, &[f64; NODES]) -> [[f64; N]; NODES],
    ) -> Self {
        let mut panels = Self { ends: vec![from], pieces: Vec::new(), error: 0.0 };
        let mut stack = vec![(to, 0, f64::INFINITY)];
        while let Some((end, depth, whole)) = stack.pop() {
            let begin = panels.ends[panels.ends.len() - 1];
            let at = |angle: f64| 0.5 * (begin + end) - 0.5 * (end - begin) * angle.cos();
            let nodes = std::array::from_fn(|k| at(PI * (k as f64 + 0.5) / NODES as f64));
            let values = functions(begin, &nodes);
            let series = transform(&values);
            // The last coefficients tell what is left out.
            let mut worst = 0.0_f64;
            for f in 0..N {
                let size = values.iter().map(|v| v[f].abs()).fold(f64::MIN_POSITIVE, f64::max);
                let tail = series[NODES - 3..].iter().map(|c| c[f].abs()).sum::<f64>();
                worst = worst.max(tail / size);
            }
            // What does not shrink with the piece is rounding in the functions themselves.
            let rounding = worst < NOISE && worst > 0.1 * whole;
            if !(worst <= tolerance || rounding) && depth < DEEPEST {
                stack.push((end, depth + 1, worst));
                stack.push((0.5 * (begin + end), depth + 1, worst));
                continue;
            }
            panels.error = panels.error.max(worst);
            panels.ends.push(end);
            panels.pieces.push(series);
        }
        panels
    }

    /// The functions at x, which is taken into the range; clamped to its ends.
    pub fn at(&self, x: f64) -> [f64; N] {
        let last = self.pieces.len() - 1;
        let piece = self.ends[1..=last].partition_point(|end| *end < x);
        let (begin, end) = (self.ends[piece], self.ends[piece + 1]);
        // Chebyshev nodes run from the beginning of a piece on: T_k(−t).
        let t = ((begin + end - 2.0 * x) / (end - begin)).clamp(-1.0, 1.0);
        let series = &self.pieces[piece];
        let (mut next, mut after) = ([0.0; N], [0.0; N]);
        for coefficients in series[1..].iter().rev() {
            for f in 0..N {
                let value = 2.0 * t * next[f] - after[f] + coefficients[f];
                after[f] = next[f];
                next[f] = value;
            }
        }
        std::array::from_fn(|f| t * next[f] - after[f] + series[0][f])
    }

    /// How well the worst piece is met, as a share of the function's largest value there.
    pub fn error(&self) -> f64 {
        self.error
    }
}

/// The Chebyshev coefficients through values at cos(π(k + ½)/n), k = 0 …
fn transform<const N: usize>(values: &[[f64; N]; NODES]) -> [[f64; N]; NODES] {
    std::array::from_fn(|j| {
        std::array::from_fn(|f| {
            let wave = |k: usize| (PI * j as f64 * (k as f64 + 0.5) / NODES as f64).cos();
            let sum: f64 = (0..NODES).map(|k| values[k][f] * wave(k)).sum();
            sum * if j == 0 { 1.0 } else { 2.0 } / NODES as f64
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smooth_functions_are_met() {
        let exact = |x: f64| [x.exp(), 1.0 / (x + 0.01)];
        let panels = Panels::new([0.0, 3.0], 1e-12, |_, nodes| nodes.map(exact));
        assert!(panels.error() <= 1e-12);
        for k in 0..=3000 {
            let x = 1e-3 * f64::from(k);
            let (found, exact) = (panels.at(x), exact(x));
            for f in 0..2 {
                assert!((found[f] / exact[f] - 1.0).abs() < 1e-11, "{x}: {found:?}, {exact:?}");
            }
        }
    }
}

//! Dense output: the state anywhere within a step.

use crate::scalar::Scalar;

/// The polynomial
///   y(θ) = y₀ + θ{f₀ + (1−θ){f₁ + θ{f₂ + (1−θ){f₃ + …}}}},   θ = 0 … 1 across the step.
///
/// f₀ … f₂ make the cubic that meets values and slopes at both ends (Hermite); each further
/// term vanishes at both ends together with its slope (Hairer, Nørsett & Wanner, II.6).
#[derive(Clone, Copy, Debug)]
pub struct Dense<S, const D: usize> {
    start: [S; D],
    terms: [[S; D]; 7],
    used: usize,
}

impl<S: Scalar, const D: usize> Dense<S, D> {
    /// The cubic through both ends.
    #[inline(always)]
    pub(super) fn hermite(start: [S; D], end: [S; D], slope: &[S; D], end_slope: &[S; D], h: S) -> Self {
        let zero = h.constant(0.0);
        let mut terms = [[zero; D]; 7];
        for i in 0..D {
            let rise = end[i] - start[i];
            let bent = slope[i] * h - rise;
            terms[0][i] = rise;
            terms[1][i] = bent;
            terms[2][i] = rise - end_slope[i] * h - bent;
        }
        Self { start, terms, used: 3 }
    }

    /// Higher terms, each h times the given combination of slopes.
    #[inline(always)]
    pub(super) fn add_bubbles<const N: usize>(&mut self, combinations: [[S; D]; N], h: S) {
        for (n, combination) in combinations.iter().enumerate() {
            self.terms[3 + n] = combination.map(|c| c * h);
        }
        self.used = 3 + N;
    }

    /// One component at θ.
    #[inline(always)]
    pub fn component(&self, i: usize, theta: S) -> S {
        let other = -theta + 1.0;
        let mut sum = theta.constant(0.0);
        for n in (0..self.used).rev() {
            sum = (sum + self.terms[n][i]) * if n % 2 == 0 { theta } else { other };
        }
        self.start[i] + sum
    }

    /// The whole state at θ.
    #[inline(always)]
    pub fn at(&self, theta: S) -> [S; D] {
        std::array::from_fn(|i| self.component(i, theta))
    }
}

/// The θ in [0, 1] at which `f` changes sign between `f0 = f(0)` and `f(1)`, to the last bits
/// of θ: Chandrupatla's method (1997), inverse quadratic interpolation guarded by bisection.
///
/// `f0` and `f(1)` must differ in sign.
pub fn root(f: impl Fn(f64) -> f64, f0: f64, f1: f64) -> f64 {
    let (mut a, mut fa) = (1.0, f1);
    let (mut b, mut fb) = (0.0, f0);
    let (mut c, mut fc);
    let mut t = fb / (fb - fa);
    for _ in 0..60 {
        let x = b + t * (a - b);
        let fx = f(x);
        if (fx > 0.0) == (fb > 0.0) {
            (c, fc) = (b, fb);
        } else {
            (c, fc) = (a, fa);
            (a, fa) = (b, fb);
        }
        (b, fb) = (x, fx);
        let (best, fbest) = if fa.abs() < fb.abs() { (a, fa) } else { (b, fb) };
        let width = (a - b).abs();
        // θ is a share of the step: an absolute tolerance is a relative one of the step.
        let tolerance = 2e-16 * (1.0 + best.abs());
        if fbest == 0.0 || width <= tolerance {
            return best;
        }
        let xi = (b - a) / (c - a);
        let phi = (fb - fa) / (fc - fa);
        t = if phi * phi < xi && (1.0 - phi).powi(2) < 1.0 - xi {
            fb / (fa - fb) * fc / (fa - fc) + (c - b) / (a - b) * fb / (fc - fb) * fa / (fc - fa)
        } else {
            0.5
        };
        let least = 0.5 * tolerance / width;
        // From b towards a.
        t = t.clamp(least, 1.0 - least);
    }
    b
}

//! Dense output: the state anywhere within a step.

use crate::scalar::Scalar;
use crate::tensor::each;

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
            for i in 0..D {
                self.terms[3 + n][i] = combination[i] * h;
            }
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
        let mut y = self.start;
        for i in 0..D {
            y[i] = self.component(i, theta);
        }
        y
    }

    /// dy/dθ of the whole state at θ.
    pub(super) fn slope(&self, theta: S) -> [S; D] {
        each(
            #[inline(always)]
            |i| self.component_slope(i, theta),
        )
    }

    /// dy/dθ of one component at θ.
    #[inline(always)]
    pub(super) fn component_slope(&self, i: usize, theta: S) -> S {
        tangent(
            #[inline(always)]
            |n| self.terms[n][i],
            self.used,
            theta,
        )[1]
    }

    /// The coefficients of one component in Bernstein's basis of degree 7, B₀ … B₇ over the step.
    pub(super) fn bernstein(&self, i: usize) -> [S; 8] {
        // The terms that a lower method does without are zero.
        let mut b = [self.start[i]; 8];
        for n in 0..7 {
            for k in 0..8 {
                b[k] += self.terms[n][i] * BERNSTEIN[n][k];
            }
        }
        b
    }

    /// The sum of the first components, each times its weight.
    #[inline(always)]
    pub(super) fn weighted<const N: usize>(&self, weights: &[S; N]) -> Dense<S, 1> {
        let start = [weighted_sum(&self.start, weights)];
        let mut terms = [start; 7];
        for n in 0..self.used {
            terms[n] = [weighted_sum(&self.terms[n], weights)];
        }
        Dense { start, terms, used: self.used }
    }

    /// That of one lane.
    pub(super) fn lane(&self, lane: usize) -> Dense<f64, D> {
        let of = |y: &[S; D]| y.map(|c| c.lane(lane));
        Dense { start: of(&self.start), terms: self.terms.each_ref().map(of), used: self.used }
    }
}

/// The coefficients in Bernstein's basis of degree 7 of what each term of the dense output is multiplied by: θ, θ(1−θ),
/// θ²(1−θ), … By (1−θ)ᵇ θᵃ = Σₖ C(7−a−b, k−a)/C(7, k) Bₖ; none is negative, so that nothing cancels.
const BERNSTEIN: [[f64; 8]; 7] = {
    let pascal = {
        let mut rows = [[0.0; 8]; 8];
        let mut n = 0;
        while n < 8 {
            rows[n][0] = 1.0;
            let mut k = 1;
            while k <= n {
                rows[n][k] = rows[n - 1][k - 1] + rows[n - 1][k];
                k += 1;
            }
            n += 1;
        }
        rows
    };
    let mut table = [[0.0; 8]; 7];
    let mut n = 0;
    while n < 7 {
        let (a, b) = (n / 2 + 1, usize::div_ceil(n, 2));
        let mut k = a;
        while k + b <= 7 {
            table[n][k] = pascal[7 - a - b][k - a] / pascal[7][k];
            k += 1;
        }
        n += 1;
    }
    table
};

/// The sum of the terms at θ, each times what it is multiplied by, and its slope.
#[inline(always)]
fn tangent<S: Scalar>(term: impl Fn(usize) -> S, used: usize, theta: S) -> [S; 2] {
    let other = -theta + 1.0;
    let mut sum = theta.constant(0.0);
    let mut slope = sum;
    for n in (0..used).rev() {
        let inner = sum + term(n);
        if n % 2 == 0 {
            slope = slope.mul_add(theta, inner);
            sum = inner * theta;
        } else {
            slope = slope.mul_add(other, -inner);
            sum = inner * other;
        }
    }
    [sum, slope]
}

#[inline(always)]
fn weighted_sum<S: Scalar, const D: usize, const N: usize>(y: &[S; D], weights: &[S; N]) -> S {
    let mut sum = y[0] * weights[0];
    for i in 1..N {
        sum = y[i].mul_add(weights[i], sum);
    }
    sum
}

impl<S: Scalar> Dense<S, 1> {
    /// The polynomial less a constant.
    #[inline(always)]
    pub(super) fn lowered(mut self, by: S) -> Self {
        self.start[0] -= by;
        self
    }

    /// The value at θ and dy/dθ.
    #[inline(always)]
    fn tangent(&self, theta: S) -> [S; 2] {
        let [sum, slope] = tangent(
            #[inline(always)]
            |n| self.terms[n][0],
            self.used,
            theta,
        );
        [self.start[0] + sum, slope]
    }

    /// The θ in [0, 1] at which the polynomial changes sign, lane by lane, to the last bits of θ: Newton's method
    /// within a bracket, which is halved where a step would leave it. Where the signs at the ends are alike or one
    /// is zero, the result means nothing. A lane that has converged stays as it is whatever the others need.
    #[inline(always)]
    pub(super) fn zero(&self) -> S {
        let start = self.start[0];
        let (zero, one) = (start.constant(0.0), start.constant(1.0));
        let end = self.component(0, one);
        // Signs are turned so that the polynomial falls through zero.
        let sign = S::select(start.less(zero), -one, one);
        let (mut low, mut high) = (zero, one);
        let mut theta = start / (start - end);
        let mut busy = one;
        for _ in 0..60 {
            let [value, slope] = self.tangent(theta);
            let before = zero.less(value * sign);
            low = S::select(before, theta, low);
            high = S::select(before, high, theta);
            let newton = theta - value / slope;
            let outside = S::select(newton.less(low), one, S::select(high.less(newton), one, zero));
            let next = S::select(zero.less(outside), (low + high) * 0.5, newton);
            let moved = (next - theta).abs();
            theta = S::select(zero.less(busy), next, theta);
            // A step this small leaves the square of it as an error.
            busy = S::select(moved.constant(1e-8).less(moved), busy, zero);
            if !S::any(zero.less(busy)) {
                break;
            }
        }
        theta
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
        // A large constant step may end where the function is no number.
        if !t.is_finite() {
            t = 0.5;
        }
        // From b towards a.
        t = t.clamp(least, 1.0 - least);
    }
    b
}

//! What the coordinates of Boyer and Lindquist do at the horizons.
//!
//! All of it is a function of (r₊ − r₋)² = 4(1 − s²), so that it has derivatives at |s| = 1, where √(1 − s²)
//! has none.

use crate::scalar::Scalar;

/// The horizons of a hole, as numbers that may have derivatives.
#[derive(Clone, Copy, Debug)]
pub struct Horizons<S> {
    outer: S,
    inner: S,
    /// 1/(r₊ − r₋), which is not needed where that is zero.
    per_gap: S,
    /// 1 − s².
    square: S,
    spin: S,
}

impl<S: Scalar> Horizons<S> {
    /// Those of a spin in [−1, 1].
    #[inline(always)]
    pub fn new(spin: S) -> Self {
        let one = spin.constant(1.0);
        let zero = spin.constant(0.0);
        let square = (one - spin) * (one + spin);
        let root = S::select(zero.less(square), square.sqrt(), zero);
        Self {
            outer: root + 1.0,
            inner: spin * spin / (root + 1.0),
            per_gap: root.max(spin.constant(1e-300)).recip() * 0.5,
            square,
            spin,
        }
    }

    /// 1/(r₊ − r₋) ln((r − r₊)/(r − r₋)).
    #[inline(always)]
    fn logarithm(&self, u: S) -> S {
        let outside = (-(self.outer * u) + 1.0).max(u.constant(1e-300));
        let inside = -(self.inner * u) + 1.0;
        let sum = (-u + 1.0) * 2.0;
        let inverse = (inside * sum).recip();
        // ln x loses digits near 1, far from the hole or where the horizons meet: there
        // ln x = 2 artanh((x − 1)/(x + 1)).
        let x = u * inside * inverse;
        let x2 = (x * x) * (self.square * 4.0);
        let mut series = x.constant(1.0 / 15.0);
        for k in (0..7).rev() {
            series = series.mul_add(x2, x.constant(1.0 / f64::from(2 * k + 1)));
        }
        let far = (outside * sum * inverse).ln() * self.per_gap;
        S::select(x2.less(x.constant(0.01)), x * series * -2.0, far)
    }

    /// tw = s/(r₊ − r₋) ln((r − r₊)/(r − r₋)), 0 at infinity: the azimuth has its variation beside
    /// the integral.
    #[inline(always)]
    pub fn twist(&self, u: S) -> S {
        self.spin * self.logarithm(u)
    }

    /// r + K, K = ln Δ + 2/(r₊ − r₋) ln((r − r₊)/(r − r₋)), Δ = (r − r₊)(r − r₋): coordinate time has its
    /// variation beside the integral. At infinity it is taken less r + 2 ln r, and so is 0.
    #[inline(always)]
    pub fn delay(&self, u: S) -> S {
        let far = u.less(u.constant(1e-300));
        let safe = S::select(far, u.constant(1.0), u);
        let r = safe.recip();
        let inside = -u + 1.0;
        let delta = (inside * inside - self.square * u * u).max(u.constant(1e-300));
        (delta * r * r).ln() + self.logarithm(u) * 2.0 + S::select(far, u.constant(0.0), r)
    }
}

//! What the coordinates of Boyer and Lindquist do at the horizons.

use crate::scalar::Scalar;

/// The horizons of a hole, as numbers that may have derivatives.
#[derive(Clone, Copy, Debug)]
pub struct Horizons<S> {
    outer: S,
    inner: S,
    /// r₊ − r₋ and its inverse, which is not needed where that is zero.
    gap: [S; 2],
    spin: S,
}

impl<S: Scalar> Horizons<S> {
    /// Those of a spin in [−1, 1].
    #[inline(always)]
    pub fn new(spin: S) -> Self {
        let one = spin.constant(1.0);
        let square = ((one - spin) * (one + spin)).max(spin.constant(0.0));
        let root = square.sqrt();
        Self {
            outer: root + 1.0,
            inner: spin * spin / (root + 1.0),
            gap: [root * 2.0, root.max(spin.constant(1e-300)).recip() * 0.5],
            spin,
        }
    }

    /// 1/(r₊ − r₋) ln((r − r₊)/(r − r₋)).
    #[inline(always)]
    fn logarithm(&self, u: S) -> S {
        let [gap, per_gap] = self.gap;
        let outside = (-(self.outer * u) + 1.0).max(u.constant(1e-300));
        let inside = -(self.inner * u) + 1.0;
        let sum = outside + inside;
        let inverse = (inside * sum).recip();
        // ln x loses digits near 1, far from the hole or where the horizons meet: there
        // ln x = 2 artanh((x − 1)/(x + 1)).
        let x = u * inside * inverse;
        let x2 = (gap * x).squared();
        let mut series = x.constant(1.0 / 15.0);
        for k in (0..7).rev() {
            series = series.mul_add(x2, x.constant(1.0 / f64::from(2 * k + 1)));
        }
        let far = (outside * sum * inverse).ln() * per_gap;
        S::select(x2.less(x.constant(0.01)), x * series * -2.0, far)
    }

    /// tw = s/(r₊ − r₋) ln((r − r₊)/(r − r₋)), 0 at infinity: the azimuth has its variation beside
    /// the integral.
    #[inline(always)]
    pub fn twist(&self, u: S) -> S {
        self.spin * self.logarithm(u)
    }

    /// r + K, K = 2 ln(r − r₋) + 2r₊/(r₊ − r₋) ln((r − r₊)/(r − r₋)): coordinate time has its variation beside
    /// the integral. Taken to be 0 at infinity.
    #[inline(always)]
    pub fn delay(&self, u: S) -> S {
        let far = u.less(u.constant(1e-300));
        let safe = S::select(far, u.constant(1.0), u);
        let inside = (-(self.inner * u) + 1.0) / safe;
        let delay = safe.recip() + inside.ln() * 2.0 + self.outer * self.logarithm(u) * 2.0;
        S::select(far, u.constant(0.0), delay)
    }
}

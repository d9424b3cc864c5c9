//! The chart in which infinity is an ordinary point.
//!
//! A ray at x = n/w, parametrised by σ with dσ = w² dλ: a straight line turns n uniformly, at
//! the rate J, through at most π from infinity to infinity, and w is a sine. Steps are as few
//! as the bending of light demands, and a ray starts or ends at w = 0 without a limit taken.
//!
//! Elapsed time: t = (x·p + T)/E, where dT/dλ = −x·ṗ. (Hamilton's equations give
//! d(x·p)/dλ = ẋ·p + x·ṗ, and ẋ·p = E ṫ on a null geodesic.) T varies slowly where t does
//! not, and does not diverge for an ingoing ray from infinity. On the way out it grows as
//! 4E ln r: the state holds T + κ ln w, with κ = 4E there, which is regular at infinity too.

use super::flow::Flow;
use crate::metric::{Inverted, Metric};
use crate::scalar::Scalar;
use crate::tensor::{cross, dot, each};

/// Photons of one energy in the inverted chart: the state is (w, n, q, J), and if `D` is 10
/// T + κ ln w and κ besides.
#[derive(Clone, Copy, Debug)]
pub struct InvertedFlow<M, S> {
    /// The spacetime.
    pub metric: M,
    /// −p_t.
    pub energy: S,
}

/// The components of a state without T.
pub const PLAIN: usize = 8;
/// The components of a state with T.
pub const TIMED: usize = 10;

/// Splits a state into its named parts.
#[inline(always)]
pub fn unpack<S: Scalar, const D: usize>(y: &[S; D]) -> Inverted<S> {
    Inverted { w: y[0], n: [y[1], y[2], y[3]], q: y[4], j: [y[5], y[6], y[7]] }
}

/// A state from its named parts, T = 0 and κ = 0.
#[inline(always)]
pub fn pack<S: Scalar, const D: usize>(state: &Inverted<S>) -> [S; D] {
    let Inverted { w, n, q, j } = *state;
    let parts = [w, n[0], n[1], n[2], q, j[0], j[1], j[2]];
    each(
        #[inline(always)]
        |i| if i < PLAIN { parts[i] } else { w.constant(0.0) },
    )
}

impl<M: Metric, S: Scalar> InvertedFlow<M, S> {
    #[inline(always)]
    fn slope<const D: usize>(&self, y: &[S; D]) -> [S; D] {
        let state = unpack(y);
        let rate = self.metric.inverted_rate(self.energy, &state);
        let mut slope = pack(&rate);
        if D == TIMED {
            // dT/dσ = −x·ṗ/w² = −(n·P)/w, where n·P = q′ − n′·p = q′ − w n′·k, for n·n′ = 0; not used is what
            // within a step would be off by as much as |n| is, over w. The sum with κ w′/w has the limit κ² at
            // w = 0: zero for light that comes in; for outgoing light t = r + 4 ln r − 8/r and
            // p_r = E(1 + 4/r + 8/r²), so that T + κ ln w = −4E − 16E w, while w′ = −E. The quotient is
            // rounding there.
            let pull = rate.q - state.w * dot(&rate.n, &cross(&state.j, &state.n));
            let at_infinity = state.w.abs().less(state.w.constant(1e-8));
            slope[8] = S::select(at_infinity, y[9] * y[9], (y[9] * rate.w - pull) / state.w);
        }
        slope
    }
}

impl<M: Metric, S: Scalar, const D: usize> Flow<S, D> for InvertedFlow<M, S> {
    #[inline(always)]
    fn derivative(&self, y: &[S; D]) -> [S; D] {
        if M::PASSES_INFINITY {
            return self.slope(y);
        }
        // Equations by dual numbers are long, and a step has a dozen of them.
        y[0].outline(
            #[inline(always)]
            || self.slope(y),
        )
    }

    /// n counts by itself; w against 1/b, the inverse distance of closest approach in flat
    /// space, and itself; q against the energy; J against its own length.
    #[inline(always)]
    fn inverse_scale(&self, y: &[S; D]) -> [S; D] {
        let Inverted { w, q, j, .. } = unpack(y);
        let energy = self.energy.abs();
        let whole = dot(&j, &j).sqrt() + energy;
        let inverse_whole = whole.recip();
        let of_w = (energy.mul_add(inverse_whole, w.abs())).recip();
        let of_q = (q.abs() + energy).recip();
        let one = w.constant(1.0);
        let scales = [of_w, one, one, one, of_q, inverse_whole, inverse_whole, inverse_whole];
        each(
            #[inline(always)]
            |i| if i < PLAIN { scales[i] } else { w.constant(0.0) },
        )
    }
}

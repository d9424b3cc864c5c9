//! The chart of Cartesian position and momentum with affine parameter λ: the thesis's.
//!
//! A constant step in λ is a constant length far away. Infinity is out of reach here.

use super::flow::Flow;
use crate::metric::Metric;
use crate::scalar::Scalar;
use crate::tensor::dot;

/// Photons of one energy, the state being (x, p), and T of [`super::InvertedFlow`] if `D` is 7.
#[derive(Clone, Copy, Debug)]
pub struct AffineFlow<M, S> {
    /// The spacetime.
    pub metric: M,
    /// −p_t.
    pub energy: S,
}

impl<M: Metric, S: Scalar, const D: usize> Flow<S, D> for AffineFlow<M, S> {
    #[inline(always)]
    fn derivative(&self, y: &[S; D]) -> [S; D] {
        let x = [y[0], y[1], y[2]];
        let rate = self.metric.rate(self.energy, &x, &[y[3], y[4], y[5]]);
        let mut slope = [self.energy.constant(0.0); D];
        slope[..3].copy_from_slice(&rate.velocity);
        slope[3..6].copy_from_slice(&rate.force);
        if D == 7 {
            slope[6] = -dot(&x, &rate.force);
        }
        slope
    }

    /// Position counts against the distance from the origin, momentum against its length.
    #[inline(always)]
    fn inverse_scale(&self, y: &[S; D]) -> [S; D] {
        let of_x = dot(&[y[0], y[1], y[2]], &[y[0], y[1], y[2]]).sqrt().recip();
        let p2 = dot(&[y[3], y[4], y[5]], &[y[3], y[4], y[5]]);
        let of_p = (p2 + self.energy.squared()).sqrt().recip();
        std::array::from_fn(|i| match i {
            0..3 => of_x,
            3..6 => of_p,
            _ => self.energy.constant(0.0),
        })
    }
}

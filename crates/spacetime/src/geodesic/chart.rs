//! What the integrator needs to know of a chart besides its equations.

use super::affine::AffineFlow;
use super::flow::Flow;
use super::inverted::{InvertedFlow, TIMED, pack, unpack};
use super::ray::Ray;
use crate::metric::{Inverted, Metric};
use crate::tensor::{Vec3, dot};

/// A chart whose state contains a place in consecutive components.
pub trait Chart<const D: usize>: Flow<f64, D> {
    /// First of the three components that point to the photon.
    const PLACE: usize;

    /// −p_t.
    fn energy(&self) -> f64;
    /// The state at the start of a ray.
    fn start(&self, ray: &Inverted<f64>) -> [f64; D];
    /// Place and momentum.
    fn state(&self, y: &[f64; D]) -> Inverted<f64>;
    /// T of the elapsed time t = (x·p + T)/E, zero if it is not integrated.
    fn virial(&self, y: &[f64; D]) -> f64;
    /// Whether the state had to be rewritten, the photon being the same, to be regular further on.
    fn settle(&self, _y: &mut [f64; D]) -> bool {
        false
    }
    /// Negative once the photon has left the chart's reach.
    fn reach(&self, y: &[f64; D]) -> f64;
    /// 1/radius.
    fn inverse_radius(&self, y: &[f64; D]) -> f64;
    /// A step over which a free photon turns by at most `angle` as seen from the origin.
    fn step_for(&self, y: &[f64; D], angle: f64) -> f64;
}

impl<M: Metric, const D: usize> Chart<D> for InvertedFlow<M, f64> {
    const PLACE: usize = 1;

    fn energy(&self) -> f64 {
        self.energy
    }
    fn start(&self, ray: &Inverted<f64>) -> [f64; D] {
        pack(ray)
    }
    fn state(&self, y: &[f64; D]) -> Inverted<f64> {
        unpack(y)
    }
    fn virial(&self, y: &[f64; D]) -> f64 {
        if D == TIMED { y[8] - if y[9] == 0.0 { 0.0 } else { y[9] * y[0].ln() } } else { 0.0 }
    }
    fn settle(&self, y: &mut [f64; D]) -> bool {
        let due = D == TIMED && y[9] == 0.0 && y[0] > 0.0 && y[4] > 0.0 && self.metric.horizon() > 0.0;
        if due {
            y[9] = 4.0 * self.energy;
            y[8] += y[9] * y[0].ln();
        }
        due
    }
    fn reach(&self, y: &[f64; D]) -> f64 {
        y[0]
    }
    fn inverse_radius(&self, y: &[f64; D]) -> f64 {
        self.metric.inverse_radius(y[0], &[y[1], y[2], y[3]])
    }
    fn step_for(&self, y: &[f64; D], angle: f64) -> f64 {
        let j = [y[5], y[6], y[7]];
        angle / (dot(&j, &j).sqrt() + self.energy.abs() + y[4].abs() * y[0])
    }
}

/// The affine chart, left for the inverted one beyond a distance from the origin.
#[derive(Clone, Copy, Debug)]
pub struct BoundedAffine<M> {
    /// The equations.
    pub flow: AffineFlow<M, f64>,
    /// Where the chart is left, M.
    pub limit: f64,
}

impl<M: Metric, const D: usize> Flow<f64, D> for BoundedAffine<M> {
    fn derivative(&self, y: &[f64; D]) -> [f64; D] {
        self.flow.derivative(y)
    }
    fn inverse_scale(&self, y: &[f64; D]) -> [f64; D] {
        self.flow.inverse_scale(y)
    }
}

impl<M: Metric, const D: usize> Chart<D> for BoundedAffine<M> {
    const PLACE: usize = 0;

    fn energy(&self) -> f64 {
        self.flow.energy
    }
    fn start(&self, ray: &Inverted<f64>) -> [f64; D] {
        let p = ray.momentum();
        let mut y = [0.0; D];
        for i in 0..3 {
            y[i] = ray.n[i] / ray.w;
            y[3 + i] = p[i];
        }
        y
    }
    fn state(&self, y: &[f64; D]) -> Inverted<f64> {
        let (x, p): (Vec3<f64>, Vec3<f64>) = ([y[0], y[1], y[2]], [y[3], y[4], y[5]]);
        Ray::from_cartesian(&x, &p, self.flow.energy, super::Side::Reversed, 0.0).start
    }
    fn virial(&self, y: &[f64; D]) -> f64 {
        if D == 7 { y[6] } else { 0.0 }
    }
    fn reach(&self, y: &[f64; D]) -> f64 {
        self.limit - dot(&[y[0], y[1], y[2]], &[y[0], y[1], y[2]]).sqrt()
    }
    fn inverse_radius(&self, y: &[f64; D]) -> f64 {
        1.0 / self.flow.metric.radius(&[y[0], y[1], y[2]])
    }
    fn step_for(&self, y: &[f64; D], angle: f64) -> f64 {
        angle * dot(&[y[0], y[1], y[2]], &[y[0], y[1], y[2]]).sqrt()
    }
}

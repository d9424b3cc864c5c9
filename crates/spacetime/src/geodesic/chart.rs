//! What the integrator needs to know of a chart besides its equations.

use super::affine::AffineFlow;
use super::flow::Flow;
use super::inverted::{InvertedFlow, TIMED, pack, unpack};
use super::ray::Ray;
use crate::metric::{Inverted, Metric};
use crate::scalar::Scalar;
use crate::tensor::{Vec3, dot};

/// A chart whose state contains a place in consecutive components.
pub trait Chart<S: Scalar, const D: usize>: Flow<S, D> {
    /// First of the three components that point to the photon.
    const PLACE: usize;
    /// The component by which they have to be divided for Cartesian coordinates, if any.
    const DIVISOR: Option<usize>;

    /// −p_t.
    fn energy(&self) -> S;
    /// The state at the start of a ray.
    fn start(&self, ray: &Inverted<S>) -> [S; D];
    /// Place and momentum.
    fn state(&self, y: &[S; D]) -> Inverted<S>;
    /// T of the elapsed time t = (x·p + T)/E, zero if it is not integrated.
    fn virial(&self, y: &[S; D]) -> S;
    /// Rewrites a state and its slope, the photon being the same, where they would not be regular further on.
    #[inline(always)]
    fn settle(&self, _y: &mut [S; D], _slope: &mut [S; D]) {}
    /// The rate of 1/distance from the origin, or something of its sign, from a state and its slope.
    fn approach(y: &[S; D], slope: &[S; D]) -> S;
    /// Negative once the photon has left the chart's reach.
    fn reach(&self, y: &[S; D]) -> S;
    /// What is above 1/horizon where the photon is captured: 1/radius as a rule.
    fn inverse_radius(&self, y: &[S; D]) -> S;
    /// A step over which a free photon turns by at most `angle` as seen from the origin.
    fn step_for(&self, y: &[S; D], angle: f64) -> S;

    /// A step that ends about where the chart's equations do, if they do.
    #[inline(always)]
    fn way_out(&self, y: &[S; D], _slope: &[S; D]) -> S {
        y[0].constant(f64::INFINITY)
    }

    /// The place of a state, or its slope.
    #[inline(always)]
    fn place(y: &[S; D]) -> Vec3<S> {
        [y[Self::PLACE], y[Self::PLACE + 1], y[Self::PLACE + 2]]
    }
}

impl<M: Metric, S: Scalar, const D: usize> Chart<S, D> for InvertedFlow<M, S> {
    const PLACE: usize = 1;
    const DIVISOR: Option<usize> = Some(0);

    #[inline(always)]
    fn energy(&self) -> S {
        self.energy
    }
    #[inline(always)]
    fn start(&self, ray: &Inverted<S>) -> [S; D] {
        pack(ray)
    }
    #[inline(always)]
    fn state(&self, y: &[S; D]) -> Inverted<S> {
        unpack(y)
    }
    #[inline(always)]
    fn virial(&self, y: &[S; D]) -> S {
        let zero = y[0].constant(0.0);
        if D != TIMED {
            return zero;
        }
        let settled = zero.less(y[9].abs());
        y[8] - S::select(settled, y[9] * S::select(settled, y[0], y[0].constant(1.0)).ln(), zero)
    }
    /// κ = 4E once the photon is on its way out: T + κ ln w replaces T, and κ w′/w joins its slope.
    #[inline(always)]
    fn settle(&self, y: &mut [S; D], slope: &mut [S; D]) {
        if D != TIMED || self.metric.horizon() == 0.0 {
            return;
        }
        let (zero, one) = (y[0].constant(0.0), y[0].constant(1.0));
        let outwards = S::select(zero.less(y[9].abs()), zero, y[0].min(y[4]));
        let due = zero.less(outwards);
        if S::any(due) {
            let kappa = S::select(due, self.energy * 4.0, zero);
            let w = S::select(due, y[0], one);
            y[9] += kappa;
            y[8] += kappa * w.ln();
            slope[8] += kappa * (slope[0] / w);
        }
    }
    #[inline(always)]
    fn approach(_y: &[S; D], slope: &[S; D]) -> S {
        slope[0]
    }
    #[inline(always)]
    fn reach(&self, y: &[S; D]) -> S {
        y[0] - self.metric.edge()
    }
    #[inline(always)]
    fn inverse_radius(&self, y: &[S; D]) -> S {
        self.metric.inverse_depth(y[0], &[y[1], y[2], y[3]])
    }
    #[inline(always)]
    fn step_for(&self, y: &[S; D], angle: f64) -> S {
        let j = [y[5], y[6], y[7]];
        y[0].constant(angle) / (dot(&j, &j).sqrt() + self.energy.abs() + y[4].abs() * y[0])
    }
    /// Just beyond w = 0, or the edge, from w′ and what a free photon's w″ and a unit mass's make of it. A photon that has more than
    /// an eighth of a turn to go does not get there in one step.
    #[inline(always)]
    fn way_out(&self, y: &[S; D], slope: &[S; D]) -> S {
        let (zero, never) = (y[0].constant(0.0), y[0].constant(f64::INFINITY));
        if M::PASSES_INFINITY {
            return never;
        }
        let j = [y[5], y[6], y[7]];
        let (approach, across) = (-slope[0], dot(&j, &j) * y[0] * y[0]);
        let turn = across / approach.squared() * 0.5 + y[0] * 2.0 + 1.0;
        let near = across.less(approach * approach.abs());
        let rest = y[0] - self.metric.edge();
        S::select(near, (rest.max(zero) + 1e-4) / (approach * turn), never)
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

impl<M: Metric, const D: usize> Chart<f64, D> for BoundedAffine<M> {
    const PLACE: usize = 0;
    const DIVISOR: Option<usize> = None;

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
    fn approach(y: &[f64; D], slope: &[f64; D]) -> f64 {
        -dot(&[y[0], y[1], y[2]], &[slope[0], slope[1], slope[2]])
    }
    fn reach(&self, y: &[f64; D]) -> f64 {
        self.limit - dot(&[y[0], y[1], y[2]], &[y[0], y[1], y[2]]).sqrt()
    }
    fn inverse_radius(&self, y: &[f64; D]) -> f64 {
        let w = 1.0 / dot(&[y[0], y[1], y[2]], &[y[0], y[1], y[2]]).sqrt();
        self.flow.metric.inverse_depth(w, &[y[0] * w, y[1] * w, y[2] * w])
    }
    fn step_for(&self, y: &[f64; D], angle: f64) -> f64 {
        angle * dot(&[y[0], y[1], y[2]], &[y[0], y[1], y[2]]).sqrt()
    }
}

//! A spacetime by its components alone.

use super::{Inverted, Metric};
use crate::scalar::Scalar;
use crate::tensor::{Tensor, Vec3};

/// Another metric of which nothing but the components is used for the motion of light: the equations follow from
/// them by dual numbers, as for any metric that gives no more.
///
/// It shows what such a metric costs, and tests the equations of one that knows better.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Components<M>(pub M);

impl<M: Metric> Metric for Components<M> {
    #[inline(always)]
    fn components<S: Scalar>(&self, x: &Vec3<S>) -> Tensor<S> {
        self.0.components(x)
    }
    #[inline(always)]
    fn radius<S: Scalar>(&self, x: &Vec3<S>) -> S {
        self.0.radius(x)
    }
    fn horizon(&self) -> f64 {
        self.0.horizon()
    }
    fn reversed(&self) -> Self {
        Self(self.0.reversed())
    }
    fn azimuth_offset(&self, r: f64) -> f64 {
        self.0.azimuth_offset(r)
    }
    fn time_offset(&self, r: f64) -> f64 {
        self.0.time_offset(r)
    }
    fn rises(&self, energy: f64, angular_momentum: f64) -> bool {
        self.0.rises(energy, angular_momentum)
    }
    fn change_sheet(&self, energy: f64, state: &Inverted<f64>) -> Inverted<f64> {
        self.0.change_sheet(energy, state)
    }
}

//! Flat spacetime.

use super::{Metric, Rate};
use crate::scalar::Scalar;
use crate::tensor::{Tensor, Vec3, dot};

/// Flat spacetime in Cartesian coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Minkowski;

impl Metric for Minkowski {
    #[inline(always)]
    fn components<S: Scalar>(&self, x: &Vec3<S>) -> Tensor<S> {
        let (zero, one) = (x[0].constant(0.0), x[0].constant(1.0));
        let mut g = [[zero; 4]; 4];
        g[0][0] = -one;
        for (i, row) in g.iter_mut().enumerate().skip(1) {
            row[i] = one;
        }
        g
    }

    #[inline(always)]
    fn radius<S: Scalar>(&self, x: &Vec3<S>) -> S {
        dot(x, x).sqrt()
    }

    fn horizon(&self) -> f64 {
        0.0
    }

    #[inline(always)]
    fn rate<S: Scalar>(&self, _energy: S, x: &Vec3<S>, p: &Vec3<S>) -> Rate<S> {
        Rate { velocity: *p, force: [x[0].constant(0.0); 3] }
    }
}

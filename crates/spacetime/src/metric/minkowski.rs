//! Flat spacetime.

use super::{Inverted, Metric, Rate};
use crate::scalar::Scalar;
use crate::tensor::{Tensor, Vec3, cross, dot};

/// Flat spacetime in Cartesian coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Minkowski;

impl Metric for Minkowski {
    const PASSES_INFINITY: bool = true;

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

    /// w′ = −q, n′ = J × n, q′ = wJ²; J is conserved.
    #[inline(always)]
    fn inverted_rate<S: Scalar>(&self, _energy: S, state: &Inverted<S>) -> Inverted<S> {
        let Inverted { w, n, q, j } = *state;
        Inverted { w: -q, n: cross(&j, &n), q: w * dot(&j, &j), j: [w.constant(0.0); 3] }
    }

    #[inline(always)]
    fn inverse_radius<S: Scalar>(&self, w: S, n: &Vec3<S>) -> S {
        w / dot(n, n).sqrt()
    }
}

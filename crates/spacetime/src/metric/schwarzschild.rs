//! The Schwarzschild hole in ingoing Kerr–Schild Cartesian coordinates.

use super::{Inverted, Kerr, Metric, Rate};
use crate::scalar::Scalar;
use crate::tensor::{Tensor, Vec3, cross, dot, each};

/// A hole without spin, M = 1: [`Kerr`] at a = 0, with the simpler equations that follow.
///
/// g = η + (2/r) l l, l = (1, x/r), r = |x|.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Schwarzschild;

impl Metric for Schwarzschild {
    const PASSES_INFINITY: bool = true;

    #[inline(always)]
    fn components<S: Scalar>(&self, x: &Vec3<S>) -> Tensor<S> {
        Kerr::new(0.0).components(x)
    }

    #[inline(always)]
    fn inverse_components<S: Scalar>(&self, x: &Vec3<S>) -> Tensor<S> {
        Kerr::new(0.0).inverse_components(x)
    }

    #[inline(always)]
    fn radius<S: Scalar>(&self, x: &Vec3<S>) -> S {
        dot(x, x).sqrt()
    }

    fn horizon(&self) -> f64 {
        2.0
    }

    /// With N = n·p, n = x/r, ℓ = E + N, f = 2/r: ẋ = p − fℓ n and
    /// ṗ = ½∇(fℓ²) = −(ℓ²/r²) n + (2ℓ/r²)(p − N n).
    #[inline(always)]
    fn rate<S: Scalar>(&self, energy: S, x: &Vec3<S>, p: &Vec3<S>) -> Rate<S> {
        let inverse = dot(x, x).sqrt().recip();
        let n: Vec3<S> = each(
            #[inline(always)]
            |i| x[i] * inverse,
        );
        let radial = dot(&n, p);
        let l = energy + radial;
        let drift = l * inverse * 2.0;
        let pull = inverse.squared() * l;
        Rate {
            velocity: each(
                #[inline(always)]
                |i| p[i] - drift * n[i],
            ),
            force: each(
                #[inline(always)]
                |i| pull * ((p[i] - radial * n[i]) * 2.0 - l * n[i]),
            ),
        }
    }

    /// J is conserved; with ℓ = E + q: w′ = 2wℓ − q, n′ = J × n, q′ = wJ² − ℓ².
    #[inline(always)]
    fn inverted_rate<S: Scalar>(&self, energy: S, state: &Inverted<S>) -> Inverted<S> {
        let Inverted { w, n, q, j } = *state;
        let l = energy + q;
        Inverted { w: w * l * 2.0 - q, n: cross(&j, &n), q: w * dot(&j, &j) - l * l, j: [w.constant(0.0); 3] }
    }

    fn time_offset(&self, r: f64) -> f64 {
        Kerr::new(0.0).time_offset(r)
    }

    fn sensitivity(&self, energy: f64, start: &Inverted<f64>) -> f64 {
        Kerr::new(0.0).sensitivity(energy, start)
    }

    fn windings(&self, energy: f64, start: &Inverted<f64>) -> f64 {
        Kerr::new(0.0).windings(energy, start)
    }

    fn norm(&self, energy: f64, state: &Inverted<f64>) -> f64 {
        Kerr::new(0.0).norm(energy, state)
    }

    fn carter(&self, energy: f64, state: &Inverted<f64>) -> Option<f64> {
        Kerr::new(0.0).carter(energy, state)
    }

    #[inline(always)]
    fn inverse_radius<S: Scalar>(&self, w: S, n: &Vec3<S>) -> S {
        w / dot(n, n).sqrt()
    }
}

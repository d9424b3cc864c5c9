//! Flat spaces in various coordinates.

use super::{Coordinate, Geometry, diagonal, from_spherical};
use crate::scalar::Scalar;

/// Flat spacetime in Cartesian coordinates: ds² = −dt² + dx² + dy² + dz².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Minkowski;

impl Geometry<4> for Minkowski {
    fn name(&self) -> &'static str {
        "minkowski"
    }
    fn coordinates(&self) -> [Coordinate; 4] {
        [Coordinate::time("t"), Coordinate::length("x"), Coordinate::length("y"), Coordinate::length("z")]
    }
    fn metric<S: Scalar>(&self, x: &[S; 4]) -> [[S; 4]; 4] {
        let one = x[0].constant(1.0);
        diagonal([-one, one, one, one])
    }
}

/// The plane in polar coordinates: ds² = dr² + r² dφ².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolarPlane;

impl Geometry<2> for PolarPlane {
    fn name(&self) -> &'static str {
        "polar"
    }
    fn coordinates(&self) -> [Coordinate; 2] {
        [Coordinate::radius("r", 0.0), Coordinate::azimuth("phi")]
    }
    fn metric<S: Scalar>(&self, x: &[S; 2]) -> [[S; 2]; 2] {
        diagonal([x[0].constant(1.0), x[0].squared()])
    }
    fn picture(&self, x: &[f64; 2]) -> [f64; 3] {
        [x[0] * x[1].cos(), x[0] * x[1].sin(), 0.0]
    }
}

/// Euclidean space in spherical coordinates: ds² = dr² + r²(dθ² + sin²θ dφ²).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphericalSpace;

impl Geometry<3> for SphericalSpace {
    fn name(&self) -> &'static str {
        "spherical"
    }
    fn coordinates(&self) -> [Coordinate; 3] {
        [Coordinate::radius("r", 0.0), Coordinate::polar("theta"), Coordinate::azimuth("phi")]
    }
    fn metric<S: Scalar>(&self, x: &[S; 3]) -> [[S; 3]; 3] {
        let r2 = x[0].squared();
        diagonal([x[0].constant(1.0), r2, r2 * x[1].sin_cos().0.squared()])
    }
    fn picture(&self, x: &[f64; 3]) -> [f64; 3] {
        from_spherical(x[0], x[1], x[2])
    }
}

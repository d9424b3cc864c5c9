//! The Schwarzschild hole in Schwarzschild's coordinates.

use super::{Coordinate, Geometry, Named, diagonal, from_spherical};
use crate::scalar::Scalar;

/// How close to the horizon geodesics are followed, in shares of its radius: the coordinates are singular there.
pub(super) const BRINK: f64 = 1e-7;

/// A hole of mass M without spin: ds² = −(1 − 2M/r)dt² + dr²/(1 − 2M/r) + r²(dθ² + sin²θ dφ²).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Schwarzschild {
    /// M.
    pub mass: f64,
}

impl Geometry<4> for Schwarzschild {
    fn name(&self) -> &'static str {
        "schwarzschild"
    }
    fn coordinates(&self) -> [Coordinate; 4] {
        [
            Coordinate::time("t"),
            Coordinate::radius("r", (2.0 * self.mass).max(0.0)),
            Coordinate::polar("theta"),
            Coordinate::azimuth("phi"),
        ]
    }
    fn parameters(&self) -> Vec<Named> {
        vec![("mass".to_owned(), self.mass)]
    }
    fn metric<S: Scalar>(&self, x: &[S; 4]) -> [[S; 4]; 4] {
        let r = x[1];
        // 1 − 2M/r, keeping its digits at the horizon.
        let lapse = (r - 2.0 * self.mass) / r;
        let r2 = r.squared();
        diagonal([-lapse, lapse.recip(), r2, r2 * x[2].sin_cos().0.squared()])
    }
    fn margin(&self, x: &[f64; 4]) -> f64 {
        x[1] - 2.0 * self.mass * (1.0 + BRINK)
    }
    /// L² = p_θ² + p_φ²/sin²θ.
    fn invariants(&self, x: &[f64; 4], p: &[f64; 4]) -> Vec<Named> {
        vec![("L^2".to_owned(), p[2] * p[2] + (p[3] / x[2].sin()).powi(2))]
    }
    fn picture(&self, x: &[f64; 4]) -> [f64; 3] {
        from_spherical(x[1], x[2], x[3])
    }
}

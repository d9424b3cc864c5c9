//! The Ellis wormhole.

use super::{Coordinate, Geometry, Named, diagonal, from_spherical};
use crate::scalar::Scalar;

/// A wormhole with a throat of radius b between two flat regions (Ellis 1973, J. Math. Phys. 14, 104; Morris & Thorne
/// 1988): ds² = −dt² + dl² + (l² + b²)(dθ² + sin²θ dφ²), −∞ < l < ∞.
///
/// Its only Ricci component is R_{ll} = −2b²/(l² + b²)², which also is its Ricci scalar; its Kretschmann scalar is
/// 12b⁴/(l² + b²)⁴. No matter that we know of can hold it open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellis {
    /// b.
    pub throat: f64,
}

impl Geometry<4> for Ellis {
    fn name(&self) -> &'static str {
        "ellis"
    }
    fn coordinates(&self) -> [Coordinate; 4] {
        [
            Coordinate::time("t"),
            Coordinate::length("l"),
            Coordinate::polar("theta"),
            Coordinate::azimuth("phi"),
        ]
    }
    fn parameters(&self) -> Vec<Named> {
        vec![("throat".to_owned(), self.throat)]
    }
    fn metric<S: Scalar>(&self, x: &[S; 4]) -> [[S; 4]; 4] {
        let one = x[1].constant(1.0);
        let wide = x[1].squared() + self.throat * self.throat;
        diagonal([-one, one, wide, wide * x[2].sin_cos().0.squared()])
    }
    /// L² = p_θ² + p_φ²/sin²θ.
    fn invariants(&self, x: &[f64; 4], p: &[f64; 4]) -> Vec<Named> {
        vec![("L^2".to_owned(), p[2] * p[2] + (p[3] / x[2].sin()).powi(2))]
    }
    /// At the distance √(l² + b²) from the middle: both sides on top of each other.
    fn picture(&self, x: &[f64; 4]) -> [f64; 3] {
        from_spherical(x[1].hypot(self.throat), x[2], x[3])
    }
}

//! The Kerr hole in Boyer–Lindquist coordinates (Boyer & Lindquist 1967, J. Math. Phys. 8, 265).
//!
//! ds² = −(1 − 2r/Σ)dt² − (4ar sin²θ/Σ)dt dφ + (Σ/Δ)dr² + Σ dθ² + (𝒜 sin²θ/Σ)dφ²,
//! Σ = r² + a² cos²θ,   Δ = r² − 2r + a²,   𝒜 = (r² + a²)² − a²Δ sin²θ,   M = 1.

use super::schwarzschild::BRINK;
use super::{Coordinate, Geometry, Named, from_spherical};
use crate::kerr::horizons;
use crate::scalar::Scalar;

/// A hole of mass 1 and spin a. The coordinates are singular at the horizon and on the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoyerLindquist {
    spin: f64,
}

impl BoyerLindquist {
    /// A hole of spin a in [−1, 1].
    pub const fn new(spin: f64) -> Self {
        Self { spin }
    }

    /// a.
    pub const fn spin(&self) -> f64 {
        self.spin
    }

    /// Carter's constant Q = p_θ² + cos²θ(a²(μ² − E²) + L²/sin²θ), μ² = −g^{μν}p_μp_ν (Carter 1968).
    pub fn carter(&self, x: &[f64; 4], p: &[f64; 4]) -> f64 {
        let (sin, cos) = x[2].sin_cos();
        let (a2, r) = (self.spin * self.spin, x[1]);
        let (sigma, delta) = (r * r + a2 * cos * cos, r * r - 2.0 * r + a2);
        // g^{μν}p_μp_ν Σ = Δp_r² + p_θ² + (aE sin θ − L/sin θ)² − ((r² + a²)E − aL)²/Δ
        let (energy, l) = (-p[0], p[3]);
        let across = self.spin * energy * sin - l / sin;
        let along = (r * r + a2) * energy - self.spin * l;
        let norm = (delta * p[1] * p[1] + p[2] * p[2] + across * across - along * along / delta) / sigma;
        p[2] * p[2] + cos * cos * (a2 * (-norm - energy * energy) + (l / sin).powi(2))
    }
}

impl Geometry<4> for BoyerLindquist {
    fn name(&self) -> &'static str {
        "kerr"
    }
    fn coordinates(&self) -> [Coordinate; 4] {
        [
            Coordinate::time("t"),
            Coordinate::radius("r", horizons(self.spin).0),
            Coordinate::polar("theta"),
            Coordinate::azimuth("phi"),
        ]
    }
    fn parameters(&self) -> Vec<Named> {
        vec![("spin".to_owned(), self.spin)]
    }
    #[inline(always)]
    fn metric<S: Scalar>(&self, x: &[S; 4]) -> [[S; 4]; 4] {
        let r = x[1];
        let (sin, cos) = x[2].sin_cos();
        let (a, a2) = (self.spin, self.spin * self.spin);
        let (r2, sin2) = (r.squared(), sin.squared());
        let sigma = cos.squared() * a2 + r2;
        // Δ = (r − r₊)(r − r₋), which keeps its digits at the horizon.
        let (outer, inner) = horizons(a);
        let delta = (r - outer) * (r - inner);
        let inverse_sigma = sigma.recip();
        let pull = r * inverse_sigma * 2.0;
        let drag = -(pull * sin2 * a);
        let zero = r.constant(0.0);
        // 𝒜/Σ = r² + a² + (2r/Σ) a² sin²θ
        let round = (r2 + a2 + pull * sin2 * a2) * sin2;
        [
            [pull - 1.0, zero, zero, drag],
            [zero, sigma / delta, zero, zero],
            [zero, zero, sigma, zero],
            [drag, zero, zero, round],
        ]
    }
    fn margin(&self, x: &[f64; 4]) -> f64 {
        x[1] - horizons(self.spin).0 * (1.0 + BRINK)
    }
    fn invariants(&self, x: &[f64; 4], p: &[f64; 4]) -> Vec<Named> {
        vec![("Q".to_owned(), self.carter(x, p))]
    }
    fn picture(&self, x: &[f64; 4]) -> [f64; 3] {
        from_spherical(x[1], x[2], x[3])
    }
}

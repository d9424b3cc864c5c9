//! The flux of a thin disk around a Kerr hole.

use std::f64::consts::PI;

use crate::kerr::Orbits;

/// The flux of a thin, steady disk that no torque acts on at its last stable orbit (Page & Thorne 1974, eq. 15n): energy per
/// area and time from each face, in the frame of the matter.
///
/// With x = √r, x₀ = √r_ISCO and the roots x_j of x³ − 3x + 2a,
///   4πF/Ṁ = 3/[2r x²(x³ − 3x + 2a)] {x − x₀ − (3a/2) ln(x/x₀)
///             − Σ_j 3(x_j − a)²/[x_j Π_{k≠j}(x_j − x_k)] ln[(x − x_j)/(x₀ − x_j)]}.
/// The spin is that with respect to the matter, below 0 where it goes against the hole. At a = ±1 two roots fall together at a,
/// and their terms vanish; at a = 0 that of x_j = 0 does.
///
/// ```
/// use kerrscope_spacetime::emitter::PageThorne;
/// let flux = PageThorne::new(0.9).flux(6.0);
/// assert!((4.0 * std::f64::consts::PI * flux / 1.967924140e-3 - 1.0).abs() < 1e-9);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PageThorne {
    spin: f64,
    isco: f64,
    /// x_j, and the factor of its logarithm.
    terms: [[f64; 2]; 3],
}

impl PageThorne {
    /// That around a hole of spin a in [−1, 1] with respect to the matter.
    pub fn new(spin: f64) -> Self {
        // 2cos((arccos a − π)/3), 2cos((arccos a + π)/3), −2cos(arccos(a)/3), with the digits of those next to each other
        // and next to zero.
        let third = spin.acos() / 3.0;
        let roots = [2.0 * (third - PI / 3.0).cos(), 2.0 * (spin.asin() / 3.0).sin(), -2.0 * third.cos()];
        let half = 12f64.sqrt();
        let other = (PI - spin.acos()) / 3.0;
        // x₁ − x₂, x₂ − x₃, x₁ − x₃.
        let gaps = [half * third.sin(), half * other.sin(), roots[0] - roots[2]];
        let products = [gaps[0] * gaps[2], -gaps[0] * gaps[1], gaps[1] * gaps[2]];
        let mut terms = [[0.0; 2]; 3];
        for j in 0..3 {
            let factor = 3.0 * (roots[j] - spin).powi(2) / (roots[j] * products[j]);
            let double = products[j].abs() < 1e-12 || roots[j] == 0.0;
            terms[j] = [roots[j], if double { 0.0 } else { factor }];
        }
        Self { spin, isco: Orbits::new(spin).isco, terms }
    }

    /// The radius of the last stable orbit, M.
    pub fn isco(&self) -> f64 {
        self.isco
    }

    /// F at radius r, in Ṁ/M²; 0 within the last stable orbit.
    pub fn flux(&self, r: f64) -> f64 {
        if !(r > self.isco) {
            return 0.0;
        }
        let (x, x0) = (r.sqrt(), self.isco.sqrt());
        let rise = (r - self.isco) / (x + x0);
        let mut brace = rise - 1.5 * self.spin * (rise / x0).ln_1p();
        for [root, factor] in self.terms {
            if factor != 0.0 {
                brace -= factor * (rise / (x0 - root)).ln_1p();
            }
        }
        // x³ − 3x + 2a vanishes at the photon orbit.
        let speed = x * (r - 3.0) + 2.0 * self.spin;
        (3.0 / (2.0 * r * r * speed) * brace).max(0.0) / (4.0 * PI)
    }
}

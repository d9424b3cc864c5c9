//! The metric of a circle in the equatorial plane.

/// What a stationary, axisymmetric metric is on one circle of its equatorial plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equator {
    /// g_tt.
    pub tt: f64,
    /// g_tφ.
    pub tp: f64,
    /// g_φφ.
    pub pp: f64,
    /// g_zz of the Cartesian-like z, by which the momentum across the plane is measured.
    pub zz: f64,
}

impl Equator {
    /// Around a hole of spin a at Boyer–Lindquist radius r:
    ///   g_tt = −(1 − 2/r),   g_tφ = −2a/r,   g_φφ = r² + a² + 2a²/r,   g_zz = 1 (Kerr–Schild).
    pub fn kerr(spin: f64, r: f64) -> Self {
        let drag = 2.0 / r;
        Self { tt: drag - 1.0, tp: -drag * spin, pp: r * r + spin * spin * (1.0 + drag), zz: 1.0 }
    }

    /// D = g_tφ² − g_tt g_φφ, positive outside the horizon; Δ around a Kerr hole.
    pub fn determinant(&self) -> f64 {
        self.tp * self.tp - self.tt * self.pp
    }

    /// ω = −g_tφ/g_φφ, the rate at which what has no angular momentum is dragged around.
    pub fn dragging(&self) -> f64 {
        -self.tp / self.pp
    }

    /// α = 1/√(−g^tt) = √(D/g_φφ): the time of an observer without angular momentum, per coordinate time.
    pub fn lapse(&self) -> f64 {
        (self.determinant() / self.pp).sqrt()
    }

    /// −g^{ab} p_a q_b over t and φ, for energies p_t = −E and angular momenta p_φ = L:
    ///   [g_φφ E E′ + g_tφ (E L′ + E′ L) + g_tt L L′]/D.
    pub fn product(&self, [e, l]: [f64; 2], [other_e, other_l]: [f64; 2]) -> f64 {
        let sum = self.pp * e * other_e + self.tp * (e * other_l + other_e * l) + self.tt * l * other_l;
        sum / self.determinant()
    }
}

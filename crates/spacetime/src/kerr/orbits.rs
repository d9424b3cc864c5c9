//! Circular equatorial orbits of Kerr in closed form.
//!
//! Source: Bardeen, Press & Teukolsky 1972, ApJ 178, 347, equations 2.12, 2.18 and 2.21.
//! σ = +1 is an orbit about +z, σ = −1 one about −z; σa > 0 is a prograde orbit.

/// Radii of the outer and inner horizon, r± = 1 ± √(1 − a²), in M, for |a| ≤ 1.
///
/// ```
/// let (outer, inner) = kerrscope_spacetime::kerr::horizons(0.6);
/// assert_eq!((outer, inner), (1.8, 0.19999999999999996));
/// ```
pub fn horizons(spin: f64) -> (f64, f64) {
    // (1 − a)(1 + a) keeps its digits as |a| → 1.
    let root = ((1.0 - spin) * (1.0 + spin)).max(0.0).sqrt();
    (1.0 + root, 1.0 - root)
}

/// Radius of the static limit, r = 1 + √(1 − a² cos²θ), in M: no observer within it is static.
///
/// `theta` is the polar angle in radians.
pub fn ergosphere(spin: f64, theta: f64) -> f64 {
    let c = spin * theta.cos();
    1.0 + ((1.0 - c) * (1.0 + c)).max(0.0).sqrt()
}

/// The radii and impact parameters at which circular equatorial orbits change their nature.
///
/// All orbits turn about +z unless the name says retrograde; for a < 0 that makes
/// the orbit about +z one against the hole's spin.
///
/// ```
/// use kerrscope_spacetime::kerr::Orbits;
/// let orbits = Orbits::new(0.9);
/// assert!((orbits.isco - 2.32088304176).abs() < 1e-10);
/// assert!((orbits.efficiency - 0.15575299).abs() < 1e-8);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbits {
    /// Outer horizon, M.
    pub horizon: f64,
    /// Innermost stable circular orbit about +z, M.
    pub isco: f64,
    /// Innermost stable circular orbit about −z, M.
    pub isco_retrograde: f64,
    /// Circular photon orbit about +z, M.
    pub photon_prograde: f64,
    /// Circular photon orbit about −z, M.
    pub photon_retrograde: f64,
    /// Impact parameter |λ| of the photon orbit about +z, M.
    pub impact_prograde: f64,
    /// Impact parameter |λ| of the photon orbit about −z, M.
    pub impact_retrograde: f64,
    /// 1 − E at `isco`: the share of rest mass that matter radiates on its way in.
    pub efficiency: f64,
}

impl Orbits {
    /// Orbits for spin a in [−1, 1], to a relative error of 1e-14.
    pub fn new(spin: f64) -> Self {
        Self {
            horizon: horizons(spin).0,
            isco: isco(spin),
            isco_retrograde: isco(-spin),
            photon_prograde: photon_orbit(spin),
            photon_retrograde: photon_orbit(-spin),
            impact_prograde: photon_impact(spin),
            impact_retrograde: photon_impact(-spin),
            efficiency: 1.0 - isco_energy(isco(spin)),
        }
    }
}

/// BPT eq. 2.21, for the orbit whose spin relative to the hole's is `spin`.
fn isco(spin: f64) -> f64 {
    let one_minus = (1.0 - spin) * (1.0 + spin);
    let z1 = 1.0 + one_minus.max(0.0).cbrt() * ((1.0 + spin).cbrt() + (1.0 - spin).cbrt());
    let z2 = (3.0 * spin * spin + z1 * z1).sqrt();
    // (3 − Z₁) ≥ 0 analytically; rounding must not make the root NaN at a = 0.
    let root = ((3.0 - z1).max(0.0) * (3.0 + z1 + 2.0 * z2)).sqrt();
    let r = 3.0 + z2 - spin.signum() * root;
    // For small spin 3 − Z₁ loses its digits; a step of Newton's method on the ISCO's own
    // equation r² − 6r + 8a√r − 3a² = 0 brings them back.
    if spin.abs() > 0.5 {
        return r;
    }
    let value = r * (r - 6.0) + 8.0 * spin * r.sqrt() - 3.0 * spin * spin;
    r - value / (2.0 * r - 6.0 + 4.0 * spin / r.sqrt())
}

/// E at the ISCO: E² = 1 − 2/(3 r) there, for either sense and any spin (BPT, from 2.12 and 2.21).
fn isco_energy(isco: f64) -> f64 {
    (1.0 - 2.0 / (3.0 * isco)).sqrt()
}

/// BPT eq. 2.18.
fn photon_orbit(spin: f64) -> f64 {
    2.0 * (1.0 + (2.0 / 3.0 * (-spin).acos()).cos())
}

/// |λ| of the circular photon orbit. There r^{3/2} − 3r^{1/2} + 2σa = 0 (BPT eq. 2.17), and the
/// critical λ (Bardeen 1973) reduces to b = 3√r − σa.
fn photon_impact(spin: f64) -> f64 {
    3.0 * photon_orbit(spin).sqrt() - spin
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Dual, Scalar};

    /// The series of the ISCO for small spin: 6 − 4√(2/3) a − (7/18) a² + O(a³).
    #[test]
    fn slow_spin_keeps_its_digits() {
        for a in [1e-3, 1e-5, 1e-8, -1e-6] {
            let series = 6.0 - 4.0 * (2f64 / 3.0).sqrt() * a - 7.0 / 18.0 * a * a;
            let error = Orbits::new(a).isco - series;
            assert!(error.abs() < 1e-14 * 6.0 + 0.3 * a.abs().powi(3), "{error:e} at a = {a}");
        }
    }

    #[test]
    fn extreme_spin_is_a_limit() {
        let o = Orbits::new(1.0);
        assert_eq!((o.horizon, o.isco), (1.0, 1.0));
        assert!((o.photon_prograde - 1.0).abs() < 1e-14);
        assert!((o.isco_retrograde - 9.0).abs() < 1e-14);
        assert!((o.photon_retrograde - 4.0).abs() < 1e-14);
        assert!((o.impact_prograde - 2.0).abs() < 1e-14);
        assert!((o.impact_retrograde - 7.0).abs() < 1e-14);
        assert!((o.efficiency - (1.0 - 1.0 / 3f64.sqrt())).abs() < 1e-14);
    }

    /// The ISCO is where dE/dr = 0 along the family of circular orbits (an independent route).
    #[test]
    fn isco_is_the_minimum_of_energy() {
        for a in [-0.95, -0.3, 0.0, 0.2, 0.7, 0.95] {
            let isco = Orbits::new(a).isco;
            let r = Dual::variable([isco], 0);
            let drag = (r * r.sqrt()).recip() * a;
            let energy = (r.recip() * -2.0 + 1.0 + drag) / (r.recip() * -3.0 + 1.0 + drag * 2.0).sqrt();
            assert!(energy.gradient[0].abs() < 1e-12, "dE/dr = {} at a = {a}", energy.gradient[0]);
            assert!((energy.value - isco_energy(isco)).abs() < 1e-13);
        }
    }
}

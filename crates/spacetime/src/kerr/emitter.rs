//! Light's frequency between matter on circular orbits and an observer.

use crate::kerr::Orbits;

/// ν_observer/ν_emitter for matter on a circular equatorial geodesic about +z at radius r of a
/// hole of spin a, the photon having λ = L/E and, at the observer, energy 1 and E at infinity
/// (`energy`; 1 for an observer at infinity). `None` within the ISCO, where no such orbit is stable.
///
/// Bardeen, Press & Teukolsky 1972, eq. 2.16: Ω = 1/(r^{3/2} + a), and
///   u^t = (1 + a r^{−3/2})/√(1 − 3/r + 2a r^{−3/2}),   g = 1/[E u^t (1 − Ωλ)].
///
/// ```
/// use kerrscope_spacetime::kerr::redshift_factor;
/// // Face-on, r = 6, no spin: g = √(1 − 3/r).
/// let g = redshift_factor(0.0, 6.0, 0.0, 1.0).unwrap();
/// assert!((g - 0.5f64.sqrt()).abs() < 1e-15);
/// ```
pub fn redshift_factor(spin: f64, r: f64, lambda: f64, energy: f64) -> Option<f64> {
    // The ISCO itself is an orbit, whatever rounding says.
    if !(r >= Orbits::new(spin).isco * (1.0 - 1e-12)) {
        return None;
    }
    let drag = spin / (r * r.sqrt());
    let rate = 1.0 / (r * r.sqrt() + spin);
    let square = 1.0 - 3.0 / r + 2.0 * drag;
    let g = square.max(0.0).sqrt() / ((1.0 + drag) * (1.0 - rate * lambda) * energy);
    (g.is_finite() && g > 0.0).then_some(g)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Published with the isoradials of a = 0 (Luminet 1979 geometry), i = 60°, r = 6, seen at 90°
    /// from the node: g = 1.1954079 on the approaching side and 0.5020351 on the receding one, at
    /// b = 6.93214848, where λ = ±b sin i.
    #[test]
    fn approaching_and_receding_sides() {
        let lambda = 6.93214848 * 60f64.to_radians().sin();
        let approaching = redshift_factor(0.0, 6.0, lambda, 1.0).unwrap();
        let receding = redshift_factor(0.0, 6.0, -lambda, 1.0).unwrap();
        assert!((approaching - 1.1954079).abs() < 1e-7, "{approaching}");
        assert!((receding - 0.5020351).abs() < 1e-7, "{receding}");
    }

    #[test]
    fn none_within_the_isco() {
        assert!(redshift_factor(0.9, 2.3, 0.0, 1.0).is_none());
        assert!(redshift_factor(0.9, 2.33, 0.0, 1.0).is_some());
        assert!(redshift_factor(0.9, f64::NAN, 0.0, 1.0).is_none());
    }
}

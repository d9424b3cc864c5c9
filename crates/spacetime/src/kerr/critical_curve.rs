//! The critical curve: the edge of the shadow on the sky of a distant observer.
//!
//! Spherical photon orbits at radius r have (Bardeen 1973; Teo 2003)
//!   λ = a + (r/a)[r − 2Δ/(r − 1)],   η = (r³/a²)[4Δ/(r − 1)² − r],   Δ = r² − 2r + a²,
//! and meet the sky at α = −λ/sin i, β² = η + a² cos² i − λ² cot² i.
//! λ, η are those of the physical photon. In this form every limit is 0/0; the code
//! uses the expanded numerators, regular for a → 0 once r is replaced by
//! r = r₀ + a x, with r₀ = 3 at a = 0.

use std::f64::consts::PI;

/// The critical curve of a Kerr hole for a distant observer.
///
/// ```
/// use kerrscope_spacetime::kerr::CriticalCurve;
/// let curve = CriticalCurve::new(0.9, 60f64.to_radians());
/// let extent = curve.extent();
/// assert!((extent.alpha_min + 3.095908).abs() < 1e-6);
/// assert!((extent.alpha_max - 6.589409).abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CriticalCurve {
    spin: f64,
    inclination: f64,
}

/// Size of a critical curve, in M and M².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Smallest α.
    pub alpha_min: f64,
    /// Largest α.
    pub alpha_max: f64,
    /// Largest β; the curve is symmetric under β → −β.
    pub beta_max: f64,
    /// Enclosed area.
    pub area: f64,
}

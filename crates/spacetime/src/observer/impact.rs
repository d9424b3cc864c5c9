//! Rays given by impact parameters: Bardeen's screen.

use super::motion::{Motion, ObserverError, Place, check};
use super::polar_sin_cos;
use crate::geodesic::{Ray, Side};
use crate::metric::{Inverted, Kerr, Metric};

/// The ray whose photon has λ = −α sin i, η = (α² − a²) cos² i + β² exactly, arriving at a static
/// observer at Boyer–Lindquist r (may be infinite), θ = i, azimuth 0, moving outwards there.
///
/// `spin` is a in [−1, 1] (`None`: flat space, M = 0), `inclination` i in radians, `impact` is (α, β) in M. β > 0 looks above
/// the hole. On the axis the direction is that of (α, β) on the sky. Of many rays of one observer [`ImpactScreen`] works out once what they
/// share.
///
/// # Errors
/// If no observer is static there, or no photon with these parameters gets there.
pub fn impact_ray(
    spin: Option<f64>,
    inclination: f64,
    r: f64,
    impact: [f64; 2],
) -> Result<Ray, ObserverError> {
    ImpactScreen::new(spin, inclination, r)?.ray(impact)
}

/// Bardeen's screen of one observer: what the rays of all impact parameters share.
///
/// ```
/// use kerrscope_spacetime::observer::{ImpactScreen, impact_ray};
/// let screen = ImpactScreen::new(Some(0.9), 1.0, 1000.0)?;
/// assert_eq!(screen.ray([-11.35, 2.0])?, impact_ray(Some(0.9), 1.0, 1000.0, [-11.35, 2.0])?);
/// # Ok::<(), kerrscope_spacetime::observer::ObserverError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct ImpactScreen {
    /// s = −a, and M, 1 or 0.
    s: f64,
    mass: f64,
    sin: f64,
    cos: f64,
    r: f64,
    /// Of the azimuth of n.
    azimuth: f64,
    azimuth_sin_cos: (f64, f64),
}

impl ImpactScreen {
    /// Of a static observer as in [`impact_ray`].
    ///
    /// # Errors
    /// If no observer is static there.
    pub fn new(spin: Option<f64>, inclination: f64, r: f64) -> Result<Self, ObserverError> {
        check(spin, &Place { r, theta: inclination, phi: 0.0 }, &Motion::Static)?;
        let (s, mass) = spin.map_or((0.0, 0.0), |a| (-a, 1.0));
        let (sin, cos) = polar_sin_cos(inclination);
        let azimuth = if r.is_infinite() || mass == 0.0 { 0.0 } else { Kerr::new(s).azimuth_offset(r) };
        Ok(Self { s, mass, sin, cos, r, azimuth, azimuth_sin_cos: azimuth.sin_cos() })
    }

    /// The ray of (α, β).
    ///
    /// For the reversed photon (s = −a, E = 1): L = α sin i, p_θ = −β,
    ///   p_r = [−√R + 2Mr − sL]/Δ  (ingoing Kerr–Schild), R = (r² + s² − sL)² − Δ[(L − s)² + η],
    /// and with u = 1/r, ρ̂² = 1 + s²u² sin²θ, σ̂ = 1 + s²u² cos²θ, ϖ̂² = 1 + s²u², ψ the azimuth:
    ///   q = [p_r ϖ̂² + p_θ s²u³ sinθ cosθ + L s u²]/(σ̂ρ̂),
    ///   J = s²u cosθ ϖ̂ sinθ (p_r/σ̂ + L s u²/(σ̂ϖ̂²)) (sin ψ, −cos ψ, 0)
    ///       + p_θ (ϖ̂/σ̂)(−sin ψ, cos ψ, 0) + L ẑ − (L/sinθ)(cosθ/ϖ̂)(cos ψ, sin ψ, 0).
    ///
    /// # Errors
    /// If no photon with these parameters gets there.
    #[inline]
    pub fn ray(&self, [alpha, beta]: [f64; 2]) -> Result<Ray, ObserverError> {
        let Self { s, mass, sin, cos, r, azimuth, azimuth_sin_cos: (sin_azimuth, cos_azimuth) } = *self;
        let eta = (alpha * alpha - s * s) * cos * cos + beta * beta;
        let l = alpha * sin;
        let p_theta = -beta;
        let u = if r.is_infinite() { 0.0 } else { 1.0 / r };
        let (u2, s2) = (u * u, s * s);
        let delta = 1.0 - 2.0 * mass * u + s2 * u2;
        let reach = 1.0 + s2 * u2 - s * l * u2;
        let potential = reach * reach - delta * u2 * ((l - s).powi(2) + eta);
        if !(potential >= 0.0) {
            return Err(ObserverError::NoSuchPhoton { alpha, beta, r });
        }
        let p_r = (-potential.sqrt() + 2.0 * mass * u - s * l * u2) / delta;
        let rho = (1.0 + s2 * u2 * sin * sin).sqrt();
        let sigma = 1.0 + s2 * u2 * cos * cos;
        let width2 = 1.0 + s2 * u2;
        let width = width2.sqrt();
        let q = (p_r * width2 + p_theta * s2 * u2 * u * sin * cos + l * s * u2) / (sigma * rho);
        let oblate = s2 * u * cos * width * sin * (p_r + l * s * u2 / width2) / sigma;
        let polar = p_theta * width / sigma - oblate;
        let flat = alpha * cos / width;
        let j = [-polar * sin_azimuth - flat * cos_azimuth, polar * cos_azimuth - flat * sin_azimuth, l];
        let n = [width * sin * cos_azimuth / rho, width * sin * sin_azimuth / rho, cos / rho];
        // The energy that a static observer measures is to be one: E = √(−g_tt) = √(1 − 2r/Σ).
        let energy = (1.0 - 2.0 * mass * u / sigma).sqrt();
        let start = Inverted { w: u / rho, n, q: q * energy, j: j.map(|c| c * energy) };
        let mut ray = Ray { start, energy, side: Side::Reversed, azimuth };
        ray.aim_azimuth();
        Ok(ray)
    }
}

//! The critical curve: the edge of the shadow on the sky of a distant observer.
//!
//! Spherical photon orbits at radius r have (Bardeen 1973; Teo 2003)
//!   λ = a + (r/a)[r − 2Δ/(r − 1)],   η = (r³/a²)[4Δ/(r − 1)² − r],   Δ = r² − 2r + a²,
//! and meet the sky at α = −λ/sin i, β² = η + a² cos² i − λ² cot² i; λ and η are the
//! physical photon's. For a → 0 these are 0/0, and for i → 0 so is α. With r = 3 + a x both
//! become regular (multiply out and divide by a):
//!   λ = −[r² x + a(r + 1)]/(r − 1),   η = r³(4 − r x²)/(r − 1)²,
//! and with x = x₀ + y sin i, where λ(x₀) = 0, the numerator's divided difference gives
//!   α = y [9 + 6a(x + x₀) + a²(x² + x x₀ + x₀² + 1)]/(r − 1).
//! Equatorial photon orbits lie at r x² = 4. At |a| = 1 the factor r − 1 cancels.

use crate::dual::Dual;
use crate::kerr::Orbits;
use crate::scalar::Scalar;
use std::f64::consts::PI;

/// The critical curve of a Kerr hole for a distant observer.
///
/// ```
/// use kerrscope_spacetime::kerr::CriticalCurve;
/// let extent = CriticalCurve::new(0.9, 60f64.to_radians()).extent();
/// assert!((extent.alpha_min + 3.095908).abs() < 1e-6);
/// assert!((extent.alpha_max - 6.589409).abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CriticalCurve {
    spin: f64,
    sin_inclination: f64,
    cos_inclination: f64,
    /// x of the orbit with λ = 0, which every observer but an edge-on one sees at α = 0.
    x0: f64,
    /// Where β² reaches zero, or where the orbits end: y in [`CriticalCurve`]'s module formula.
    y_range: [f64; 2],
}

/// Size of a critical curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Smallest α, M.
    pub alpha_min: f64,
    /// Largest α, M.
    pub alpha_max: f64,
    /// Largest β, M; the curve is symmetric under β → −β.
    pub beta_max: f64,
    /// Enclosed area, M².
    pub area: f64,
}

impl CriticalCurve {
    /// The curve for spin a in [−1, 1] and inclination i in [0, π] (radians).
    pub fn new(spin: f64, inclination: f64) -> Self {
        // Exact zeros at the pole and the equator, where sin and cos round.
        let sin_inclination = if inclination == PI { 0.0 } else { inclination.sin() };
        let cos_inclination = if inclination == PI / 2.0 { 0.0 } else { inclination.cos() };
        let mut curve = Self {
            spin,
            sin_inclination,
            cos_inclination,
            x0: zero_angular_momentum(spin),
            y_range: [0.0; 2],
        };
        let orbits = Orbits::new(spin);
        let ends = [-2.0 / orbits.photon_prograde.sqrt(), 2.0 / orbits.photon_retrograde.sqrt()];
        curve.y_range = [curve.end(-1.0, ends[0]), curve.end(1.0, ends[1])];
        curve
    }

    /// Point at angle χ in [0, 2π): χ = 0 is the smallest α, β > 0 for χ < π.
    pub fn point(&self, chi: f64) -> [f64; 2] {
        let y = self.y(chi);
        let (alpha, beta_squared) = self.alpha_and_beta_squared(y);
        [alpha, beta_squared.max(0.0).sqrt().copysign(PI - chi)]
    }

    /// `n` points around the curve.
    pub fn points(&self, n: usize) -> Vec<[f64; 2]> {
        (0..n).map(|i| self.point(2.0 * PI * i as f64 / n as f64)).collect()
    }

    /// Extent and area, to a relative error of 1e-10.
    pub fn extent(&self) -> Extent {
        let [alpha_min, alpha_max] = self.y_range.map(|y| self.alpha_and_beta_squared(y).0);
        Extent { alpha_min, alpha_max, beta_max: self.beta_max(), area: self.area() }
    }

    fn y<S: Scalar>(&self, chi: S) -> S {
        let [first, last] = self.y_range;
        chi.sin_cos().1 * (0.5 * (first - last)) + 0.5 * (first + last)
    }

    fn alpha_and_beta_squared<S: Scalar>(&self, y: S) -> (S, S) {
        let (a, x0) = (self.spin, self.x0);
        let x = y * self.sin_inclination + x0;
        let r = x * a + 3.0;
        let (slope, eta) = if a.abs() == 1.0 {
            (r + (3.0 + a * x0) - 2.0, r.squared() * r * (-r + 4.0))
        } else {
            let inverse = (r - 1.0).recip();
            let numerator = (x + x0) * (6.0 * a) + (x.squared() + x * x0 + (x0 * x0 + 1.0)) * (a * a) + 9.0;
            (numerator * inverse, r.squared() * r * (-(r * x.squared()) + 4.0) * inverse.squared())
        };
        let alpha = y * slope;
        let cos2 = self.cos_inclination * self.cos_inclination;
        (alpha, eta + a * a * cos2 - alpha.squared() * cos2)
    }

    /// The zero of β² on one side of y = 0, or the y of the equatorial orbit `x_end` if that
    /// comes first (edge-on; or the near-horizon line at |a| = 1, where the curve is a straight segment).
    fn end(&self, side: f64, x_end: f64) -> f64 {
        let beta_squared = |y: f64| self.alpha_and_beta_squared(y).1;
        let limit = if self.sin_inclination == 0.0 {
            f64::INFINITY
        } else {
            ((x_end - self.x0) / self.sin_inclination).abs()
        };
        // β² at the last orbit is zero only edge-on, where rounding may show either sign.
        let mut inside = 0.0;
        let mut outside = limit.min(1.0);
        while beta_squared(side * outside) > 0.0 {
            if outside >= limit {
                return side * limit;
            }
            inside = outside;
            outside = (2.0 * outside).min(limit);
        }
        for _ in 0..200 {
            let middle = 0.5 * (inside + outside);
            if middle <= inside || middle >= outside {
                break;
            }
            if beta_squared(side * middle) > 0.0 { inside = middle } else { outside = middle }
        }
        side * inside
    }

    /// β is greatest where dβ²/dy, exact by duals, changes sign.
    fn beta_max(&self) -> f64 {
        let slope = |y: f64| self.alpha_and_beta_squared(Dual::variable([y], 0)).1.gradient[0];
        let [mut rising, mut falling] = self.y_range;
        for _ in 0..200 {
            let middle = 0.5 * (rising + falling);
            if middle <= rising || middle >= falling {
                break;
            }
            if slope(middle) > 0.0 { rising = middle } else { falling = middle }
        }
        self.alpha_and_beta_squared(rising).1.max(0.0).sqrt()
    }

    /// 2∫β dα over χ in [0, π]. The integrand, continued evenly, is periodic and smooth, so
    /// the trapezoidal rule converges geometrically; doubled until it stands still.
    fn area(&self) -> f64 {
        let integrand = |chi: f64| {
            let (alpha, beta_squared) = self.alpha_and_beta_squared(self.y(Dual::variable([chi], 0)));
            2.0 * beta_squared.value.max(0.0).sqrt() * alpha.gradient[0]
        };
        let mut n = 64_u32;
        let mut sum = 0.5 * (integrand(0.0) + integrand(PI))
            + (1..n).map(|i| integrand(PI * f64::from(i) / f64::from(n))).sum::<f64>();
        let mut area = sum * PI / f64::from(n);
        while n < 1 << 20 {
            sum += (0..n).map(|i| integrand(PI * (f64::from(i) + 0.5) / f64::from(n))).sum::<f64>();
            n *= 2;
            let finer = sum * PI / f64::from(n);
            let change = (finer - area).abs();
            area = finer;
            if change < 1e-12 * area {
                break;
            }
        }
        area
    }
}

/// x of the spherical orbit with λ = 0: the zero of r² x + a(r + 1), r = 3 + a x, by Newton's
/// method; the numerator rises monotonically, x lies in [−0.59, 0.59].
fn zero_angular_momentum(spin: f64) -> f64 {
    let mut x = -4.0 / 9.0 * spin;
    for _ in 0..20 {
        let r = 3.0 + spin * x;
        let value = r * r * x + spin * (r + 1.0);
        let slope = r * r + 2.0 * spin * r * x + spin * spin;
        let change = value / slope;
        x -= change;
        if change.abs() < 1e-16 {
            break;
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Closed form, arbitrary precision: a, i, α range, β_max, area.
    const TABLE: [[f64; 6]; 4] = [
        [0.5, 60.0, -4.230999, 6.003824, 5.17791, 83.2602],
        [0.9, 17.0, -4.303168, 5.503622, 4.94500, 76.1857],
        [0.9, 60.0, -3.095908, 6.589409, 5.13547, 78.5589],
        [0.99, 60.0, -2.543825, 6.715793, 5.12211, 75.9166],
    ];

    #[test]
    fn published_extents() {
        for [a, degrees, alpha_min, alpha_max, beta_max, area] in TABLE {
            let e = CriticalCurve::new(a, degrees.to_radians()).extent();
            assert!((e.alpha_min - alpha_min).abs() < 6e-7, "{e:?}");
            assert!((e.alpha_max - alpha_max).abs() < 6e-7, "{e:?}");
            assert!((e.beta_max - beta_max).abs() < 6e-6, "{e:?}");
            assert!((e.area - area).abs() < 6e-5, "{e:?}");
        }
    }

    #[test]
    fn spin_zero_is_a_circle() {
        for degrees in [0.0, 1e-7, 17.0, 90.0, 180.0] {
            for spin in [0.0, 1e-12] {
                for [alpha, beta] in CriticalCurve::new(spin, f64::to_radians(degrees)).points(97) {
                    assert!((alpha.hypot(beta) - 27f64.sqrt()).abs() < 1e-11, "i = {degrees}");
                }
            }
        }
    }

    #[test]
    fn face_on_is_a_circle() {
        for (spin, radius, tolerance) in [(0.9, 4.91606, 5e-6), (1.0, 2.0 + 8f64.sqrt(), 1e-13)] {
            for [alpha, beta] in CriticalCurve::new(spin, 0.0).points(50) {
                assert!((alpha.hypot(beta) - radius).abs() < tolerance);
            }
        }
        // A limit: next to the axis nothing jumps.
        let (on, near) = (CriticalCurve::new(0.9, 0.0), CriticalCurve::new(0.9, 1e-9));
        for i in 0..50 {
            let (p, q) = (on.point(0.126 * f64::from(i)), near.point(0.126 * f64::from(i)));
            assert!((p[0] - q[0]).hypot(p[1] - q[1]) < 1e-7);
        }
    }

    #[test]
    fn edge_on_height_is_that_of_spin_zero() {
        for spin in [-1.0, -0.7, 0.3, 0.998, 1.0] {
            let curve = CriticalCurve::new(spin, PI / 2.0);
            assert!((curve.extent().beta_max - 27f64.sqrt()).abs() < 1e-12);
            let orbits = Orbits::new(spin);
            let e = curve.extent();
            assert!((e.alpha_min + orbits.impact_prograde).abs() < 1e-7, "{e:?}");
            assert!((e.alpha_max - orbits.impact_retrograde).abs() < 1e-7, "{e:?}");
        }
    }

    #[test]
    fn opposite_spin_is_the_mirror_image() {
        for degrees in [5.0, 45.0, 90.0] {
            let (e, m) = (
                CriticalCurve::new(0.8, f64::to_radians(degrees)).extent(),
                CriticalCurve::new(-0.8, f64::to_radians(degrees)).extent(),
            );
            assert!((e.alpha_min + m.alpha_max).abs() < 1e-11);
            assert!((e.beta_max - m.beta_max).abs() < 1e-11);
            assert!((e.area - m.area).abs() < 1e-9);
        }
    }

    /// Each point's (λ, η) makes the radial potential and its derivative vanish together.
    #[test]
    fn radial_potential_has_a_double_root() {
        for (spin, degrees) in [(0.1, 30.0), (0.9, 60.0), (0.998, 89.0), (-0.6, 75.0)] {
            let i = f64::to_radians(degrees);
            let curve = CriticalCurve::new(spin, i);
            for [alpha, beta] in curve.points(40) {
                let lambda = -alpha * i.sin();
                let eta = (alpha * alpha - spin * spin) * i.cos().powi(2) + beta * beta;
                let potential = |r: f64| {
                    let delta = r * r - 2.0 * r + spin * spin;
                    (r * r + spin * spin - spin * lambda).powi(2) - delta * ((lambda - spin).powi(2) + eta)
                };
                let orbits = Orbits::new(spin);
                let (lo, hi) = (
                    orbits.photon_prograde.min(orbits.photon_retrograde) - 1e-3,
                    orbits.photon_prograde.max(orbits.photon_retrograde) + 1e-3,
                );
                let least = (0..=20_000)
                    .map(|k| potential(lo + (hi - lo) * f64::from(k) / 20_000.0))
                    .fold(f64::INFINITY, f64::min);
                assert!(least.abs() < 1e-5, "a = {spin}, i = {degrees}: {least}");
            }
        }
    }
}

//! From Kerr–Schild Cartesian to Boyer–Lindquist coordinates.

use kerrscope_spacetime::metric::{Kerr, Metric};
use kerrscope_spacetime::observer::Place;

/// Boyer–Lindquist coordinates of a point in the chart in which an observer there sees (but for a
/// falling one close outside the horizon, who sees in ingoing coordinates already).
///
/// x + iy = (r + is) sin θ e^{iφ̃}, z = r cos θ. Outside the outer horizon rays are followed on the
/// sheet with s = −a, and φ̃ differs from φ; inside, in ingoing coordinates with s = a, whose φ̃
/// is the azimuth. In flat space these are spherical coordinates.
pub(super) fn from_kerr_schild(spin: Option<f64>, [x, y, z]: [f64; 3]) -> Place {
    let a = spin.unwrap_or(0.0);
    // r⁴ − (R² − a²) r² − a² z² = 0, by the form of the root that does not cancel.
    let b = x * x + y * y + z * z - a * a;
    let root = b.hypot(2.0 * a * z);
    let r = if b >= 0.0 { (0.5 * (b + root)).sqrt() } else { (a * z).abs() / (0.5 * (root - b)).sqrt() };
    let theta = if r == 0.0 { 0.0 } else { (x.hypot(y) / r.hypot(a)).atan2(z / r) };
    let offset = match spin {
        None => 0.0,
        Some(a) if r > Kerr::new(a).horizon() => Kerr::new(-a).azimuth_offset(r),
        Some(a) => a.atan2(r),
    };
    Place { r, theta, phi: y.atan2(x) - offset }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kerrscope_spacetime::observer::{Motion, Observer};

    #[test]
    fn an_observer_stands_at_the_point() {
        for spin in [None, Some(0.0), Some(0.3), Some(-0.99), Some(0.7), Some(1.0), Some(-1.0)] {
            for direction in [[1.0, 0.0, 0.0], [-0.3, 0.4, 0.6], [0.1, -0.8, -0.2], [0.0, 0.0, 1.0]] {
                for length in [1.9, 2.5, 30.0, 1e6] {
                    let point = direction.map(|c| c * length);
                    let place = from_kerr_schild(spin, point);
                    // Inside the horizon only a falling observer can be.
                    let observer = Observer::new(spin, place, Motion::ZeroAngularMomentum)
                        .or_else(|_| Observer::new(spin, place, Motion::Fall));
                    let Ok(observer) = observer else { continue };
                    for (typed, found) in point.iter().zip(observer.position()) {
                        assert!((typed - found).abs() < 1e-12 * length, "{spin:?} {point:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn radius_inside_the_ring_keeps_its_digits() {
        // r⁴ + (a² − R²) r² = a² z², for small z: r ≈ a |z|/√(a² − R²).
        let place = from_kerr_schild(Some(0.9), [0.3, 0.2, 1e-9]);
        let expected = 0.9e-9 / (0.81_f64 - 0.13).sqrt();
        assert!((place.r / expected - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_centre_has_a_place() {
        assert_eq!(from_kerr_schild(Some(0.9), [0.3, 0.2, 0.0]).r, 0.0);
        let centre = from_kerr_schild(None, [0.0; 3]);
        assert_eq!(centre, Place { r: 0.0, theta: 0.0, phi: 0.0 });
    }
}

//! From a photon at the camera to its crossings and its direction, for one ray or for lanes of rays.

use super::course::Course;
use super::horizons::Horizons;
use super::photon::Photon;
use super::polar::Oscillation;
use super::series::Cosines;
use crate::scalar::Scalar;

/// A photon and its course.
#[derive(Clone, Copy, Debug)]
pub struct Start<S> {
    /// The photon at the camera.
    pub photon: Photon<S>,
    /// Its radial motion.
    pub course: Course<S>,
    /// Boyer–Lindquist azimuth of the camera.
    pub azimuth: S,
    /// λ and μ′ but for a positive factor: on the axis, where both vanish, their ratio is that of α and β.
    pub heading: [S; 2],
    /// The hole's horizons.
    pub horizons: Horizons<S>,
}

/// A place of the radial motion.
#[derive(Clone, Copy, Debug)]
pub struct Place<S> {
    /// 1/r.
    pub u: S,
    /// Boyer–Lindquist azimuth that the radial motion has added since the start.
    pub azimuth: S,
    /// Coordinate time that it has added, regularised at infinity; NaN unless asked for.
    pub time: S,
    /// Positive where u grows along the ray.
    pub inwards: S,
}

/// A way to compute the radial motion of photons.
pub trait Radial<S: Scalar> {
    /// Mino time to the end.
    fn total(&self) -> S;
    /// Boyer–Lindquist azimuth that the radial motion of light that escapes adds on its whole way.
    fn azimuth_to_infinity(&self) -> S;
    /// Where the photon is after Mino time τ.
    fn at(&self, tau: S) -> Place<S>;
}

/// A crossing of the equatorial plane.
#[derive(Clone, Copy, Debug)]
pub struct Meeting<S: Scalar> {
    /// Which lanes have it.
    pub met: S::Mask,
    /// Boyer–Lindquist radius.
    pub r: S,
    /// Boyer–Lindquist azimuth, unwrapped.
    pub phi: S,
    /// Coordinate time from there to the camera, regularised at infinity; NaN unless asked for.
    pub elapsed: S,
    /// Kerr–Schild x and y.
    pub position: [S; 2],
    /// p_z of the light as it comes, that is −p_z of the ray.
    pub normal: S,
    /// Positive where the ray goes inwards, and light outwards.
    pub inwards: S,
}

/// Follows photons with η > 0: tells each of at most `count` crossings of each lane, and gives θ and
/// the azimuth at infinity, of meaning for those that `escape`.
#[inline(always)]
pub fn follow<S: Scalar, R: Radial<S>, const N: usize, const TIMED: bool>(
    start: &Start<S>,
    radial: &R,
    cosines: &Cosines<N>,
    escape: bool,
    count: usize,
    mut each: impl FnMut(&Meeting<S>),
) -> [S; 2] {
    let oscillation = start.azimuth.outline(
        #[inline(always)]
        || Oscillation::<S, N>::new::<TIMED>(&start.photon, start.heading, cosines),
    );
    let total = radial.total();
    let mut n = oscillation.first();
    // The light's r p_z = −μ′ where X = nπ: μ′ = √η (−1)ⁿ.
    let odd = n - (n * 0.5).round() * 2.0;
    let mut across = start.photon.eta.sqrt() * (odd.abs() * 2.0 - 1.0);
    for _ in 0..count {
        let [tau, turned, height] = oscillation.crossing(n);
        let met = tau.less(total);
        if !S::any(met) {
            break;
        }
        // Lanes without this crossing compute one that exists, so that nothing overflows.
        let tau = S::select(met, tau, total * 0.5);
        let meeting = total.outline(
            #[inline(always)]
            || meeting(start, &radial.at(tau), met, [turned, height], across),
        );
        each(&meeting);
        n += n.constant(1.0);
        across = -across;
    }
    if !escape {
        return [total, total];
    }
    let [theta, turned] = total.outline(
        #[inline(always)]
        || oscillation.at(total),
    );
    [theta, start.azimuth + radial.azimuth_to_infinity() + turned]
}

/// The crossing at a place, up to which the motion in θ has added `turned` to the azimuth and `height` to the
/// time; there r p_z is `across`.
#[inline(always)]
fn meeting<S: Scalar>(
    start: &Start<S>,
    place: &Place<S>,
    met: S::Mask,
    [turned, height]: [S; 2],
    across: S,
) -> Meeting<S> {
    let spin = start.photon.spin;
    let r = place.u.recip();
    let phi = start.azimuth + turned + place.azimuth;
    // x + iy = (r + is) e^{iφ̃}, φ̃ = φ + tw.
    let (sin, cos) = (phi + start.horizons.twist(place.u)).sin_cos();
    let position = [r * cos - spin * sin, r * sin + spin * cos];
    let (elapsed, normal) = (place.time + height, across * place.u);
    Meeting { met, r, phi, elapsed, position, normal, inwards: place.inwards }
}

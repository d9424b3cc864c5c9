//! From a photon at the camera to its crossings and its direction, for one ray or for lanes of rays.

use std::f64::consts::LN_2;

use super::photon::Photon;
use super::polar::{Cosines, Oscillation};
use super::quadrature::Nodes;
use super::radial::{Course, Horizons, Motion, Point};
use crate::scalar::Scalar;

/// A photon that oscillates about the plane, and its course.
#[derive(Clone, Copy, Debug)]
pub struct Start<S> {
    /// The photon at the camera.
    pub photon: Photon<S>,
    /// Its radial motion.
    pub course: Course<S>,
    /// Boyer–Lindquist azimuth of the camera.
    pub azimuth: S,
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
    /// Coordinate time from there to the camera, regularised at infinity; of no meaning unless asked for.
    pub elapsed: S,
    /// Kerr–Schild x and y.
    pub position: [S; 2],
}

/// A way to compute: quadratures, and the Fourier series of N terms.
pub struct Tables<'a, const N: usize> {
    /// Nodes of the quadrature.
    pub nodes: &'a Nodes,
    /// Cosines of the Fourier series.
    pub cosines: &'a Cosines<N>,
}

/// Radial motion with what is known of its start.
pub struct Radial<'a, S, const PLAIN: bool, const TIMED: bool> {
    start: &'a Start<S>,
    motion: Motion<'a, S, PLAIN, TIMED>,
    horizons: Horizons<S>,
    /// Twist and delay at the start, and twice those at the turning point.
    twist: [S; 2],
    delay: [S; 2],
}

impl<'a, S: Scalar, const PLAIN: bool, const TIMED: bool> Radial<'a, S, PLAIN, TIMED> {
    /// The radial motion from a start.
    #[inline(always)]
    pub fn new<const SPREAD: bool>(start: &'a Start<S>, nodes: &'a Nodes) -> Self {
        let motion = Motion::new::<SPREAD>(&start.photon, &start.course, nodes);
        let horizons = Horizons::new(start.photon.spin);
        let zero = start.azimuth.constant(0.0);
        let mut radial = Self { start, motion, horizons, twist: [zero; 2], delay: [zero; 2] };
        let (from, turn) = (start.photon.u, if PLAIN { zero } else { radial.motion.turning() });
        radial.twist = [horizons.twist(from), if PLAIN { zero } else { horizons.twist(turn) * 2.0 }];
        if TIMED {
            radial.delay = [horizons.delay(from), if PLAIN { zero } else { horizons.delay(turn) * 2.0 }];
        }
        radial
    }

    /// Mino time to the end.
    pub fn total(&self) -> S {
        self.motion.whole().tau
    }

    /// Total variation, with the sign of the first leg, of a function that is `here` at a place, beyond the
    /// turning point if `late` and there is one.
    #[inline(always)]
    fn variation(&self, [first, turn]: [S; 2], here: S, late: S::Mask) -> S {
        let Course { inwards, shape, lead, .. } = self.start.course;
        let straight = first - here;
        if PLAIN {
            return straight * inwards;
        }
        let zero = here.constant(0.0);
        let turned = S::select(late, first + here - turn, straight);
        let turned = S::select(lead.less(zero), turned, straight);
        S::select(shape.less(zero), turned, straight) * inwards
    }

    /// Azimuth swept by the radial motion of light that escapes.
    #[inline(always)]
    pub fn azimuth_to_infinity(&self) -> S {
        let zero = self.start.azimuth.constant(0.0);
        let late = zero.less(zero.constant(1.0));
        self.motion.whole().azimuth + self.variation(self.twist, zero, late)
    }

    /// The crossing after Mino time τ, at which the motion in θ has added `turned` to the azimuth and
    /// `height` to the time.
    #[inline(always)]
    fn meeting(&self, met: S::Mask, [tau, turned, height]: [S; 3]) -> Meeting<S> {
        let Photon { spin, u: from, .. } = self.start.photon;
        let Point { u, late, azimuth, time } = self.motion.at(from, tau);
        let r = u.recip();
        let twist = self.horizons.twist(u);
        let phi = self.start.azimuth + turned + azimuth + self.variation(self.twist, twist, late);
        let elapsed = if TIMED {
            let zero = u.constant(0.0);
            let infinite = S::select(zero.less(from), zero, u.constant(2.0 * LN_2));
            time + height + self.variation(self.delay, self.horizons.delay(u), late) + infinite
        } else {
            time
        };
        // x + iy = (r + is) e^{iφ̃}, φ̃ = φ + tw.
        let (sin, cos) = (phi + twist).sin_cos();
        let position = [r * cos - spin * sin, r * sin + spin * cos];
        Meeting { met, r, phi, elapsed, position }
    }
}

/// Follows photons with η > 0: tells each of at most `count` crossings of each lane, and gives θ and
/// the azimuth at infinity, of meaning for those that `escape`.
#[inline(always)]
pub fn follow<S: Scalar, const N: usize, const PLAIN: bool, const TIMED: bool, const SPREAD: bool>(
    start: &Start<S>,
    tables: &Tables<'_, N>,
    escape: bool,
    count: usize,
    mut each: impl FnMut(&Meeting<S>),
) -> [S; 2] {
    let radial = start.azimuth.outline(
        #[inline(always)]
        || Radial::<S, PLAIN, TIMED>::new::<SPREAD>(start, tables.nodes),
    );
    let oscillation = start.azimuth.outline(
        #[inline(always)]
        || Oscillation::new(&start.photon, tables.cosines),
    );
    let total = radial.total();
    let mut n = oscillation.first();
    for _ in 0..count {
        let mut place = oscillation.crossing(n);
        let met = place[0].less(total);
        if !S::any(met) {
            break;
        }
        // Lanes without this crossing compute one that exists, so that nothing overflows.
        place[0] = S::select(met, place[0], total * 0.5);
        let meeting = total.outline(
            #[inline(always)]
            || radial.meeting(met, place),
        );
        each(&meeting);
        n += n.constant(1.0);
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

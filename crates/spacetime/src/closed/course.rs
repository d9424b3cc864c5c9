//! Which way the radial motion of a photon goes, and how it is best computed.

use super::photon::{Photon, Potential};
use crate::scalar::Scalar;

/// Which way the radial motion goes. Numbers instead of cases, so that lanes can differ.
#[derive(Clone, Copy, Debug)]
pub struct Course<S> {
    /// +1 if the ray sets out inwards, −1 if outwards.
    pub inwards: S,
    /// κ of u = c + κ d cosh σ or u = c + κ d sinh σ, in which σ grows along the ray: ±1.
    pub side: S,
    /// −1 for cosh, a motion that has a turning point; +1 for sinh, one that has none.
    pub shape: S,
    /// For cosh: −1 if the turning point lies ahead, +1 if behind.
    pub lead: S,
    /// u where it ends: 0 at infinity, 1/r₊ at the horizon.
    pub end: S,
}

/// How a radial motion is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// U stays far from zero, or has no zeros near the path.
    Plain,
    /// The nearest zeros of U are a pair outside the horizon, or all but one: U is factored.
    Factored,
    /// The same, away from the critical curve, where the zeros lie apart.
    Spread,
    /// Light that escapes far from the critical curve: a Fourier series.
    Distant,
    /// Light that escapes farther out still: a shorter one.
    Remote,
}

impl Kind {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Plain, Self::Factored, Self::Spread, Self::Distant, Self::Remote];

    /// How a motion with these properties of its [`Class`] is computed; with elapsed time no series is.
    pub fn of([plain, spread, distant]: [f64; 3], timed: bool) -> Self {
        if plain > 0.0 {
            Self::Plain
        } else if distant > 0.0 && !timed {
            if distant > 1.0 { Self::Remote } else { Self::Distant }
        } else if spread > 0.0 {
            Self::Spread
        } else {
            Self::Factored
        }
    }
}

/// The radial motion of photons, classified. Yes is 1, no is 0.
#[derive(Clone, Copy, Debug)]
pub struct Class<S> {
    /// Which way it goes.
    pub course: Course<S>,
    /// Whether it is [`Kind::Plain`].
    pub plain: S,
    /// Whether it is [`Kind::Spread`], if nothing else.
    pub spread: S,
    /// 1 if it is [`Kind::Distant`], 2 if it is [`Kind::Remote`].
    pub distant: S,
    /// Whether it ends at infinity.
    pub escapes: S,
    /// How an error grows towards the critical curve: 1/U there, at least 1.
    pub sensitivity: S,
}

/// 1 where x is below a bound, else 0.
#[inline(always)]
fn below<S: Scalar>(x: S, bound: f64) -> S {
    S::select(x.less(x.constant(bound)), x.constant(1.0), x.constant(0.0))
}

/// 1 where x is above a bound, else 0.
#[inline(always)]
fn above<S: Scalar>(x: S, bound: f64) -> S {
    S::select(x.constant(bound).less(x), x.constant(1.0), x.constant(0.0))
}

/// Below this least value of U a motion is [`Kind::Spread`].
const SPREAD: f64 = -0.5;

/// Below this least value of U light that escapes is [`Kind::Distant`]: U = 1 − b²/27 without spin, so that it
/// passes at b = 8 M.
const DISTANT: f64 = -1.4;

/// Below this one it is [`Kind::Remote`]: b = 11.6 M.
const REMOTE: f64 = -4.0;

impl<S: Scalar> Class<S> {
    /// Classifies a photon outside a horizon at 1/r = `rim`.
    ///
    /// Between its zeros u₁ < u_m < u₂ U is negative: light from far away turns at u₁, light from within at
    /// u₂. If U has no such zeros outside the horizon, light goes on as it began.
    #[inline(always)]
    pub fn of(photon: &Photon<S>, rim: S) -> Self {
        let photon = photon.still();
        let potential = Potential::new(&photon);
        let least = potential.least();
        let value = potential.at(least);
        let (zero, one) = (rim.constant(0.0), rim.constant(1.0));
        let valley = below(potential.b, 0.0) * (one - below(potential.discriminant(), 0.0));
        let beyond = S::select(rim.less(least), one, zero) * valley;
        let monotone = (one - valley).max(beyond).max(above(value, 0.0));
        let inwards = above(photon.u_rate, 0.0);
        let outer = S::select(photon.u.less(least), one, zero);
        let escapes = monotone * (one - inwards) + (one - monotone) * outer;
        let course = Course {
            inwards: inwards * 2.0 - 1.0,
            side: one - escapes * 2.0,
            shape: monotone * 2.0 - 1.0,
            lead: S::select(zero.less(monotone), one, (one - escapes * 2.0) * (inwards * 2.0 - 1.0)),
            end: (one - escapes) * rim,
        };
        let deep = above(value, 0.6).max(beyond * below(value, 0.0)).max(beyond * above(value, 0.05));
        // Where U has no valley outside the horizon nothing is near the critical curve.
        let lowest = potential.at(S::select(rim.less(least), rim, least)).abs();
        let sensitivity = lowest.max(rim.constant(1e-15)).recip() * valley + 1.0;
        Self {
            course,
            plain: (one - valley).max(deep),
            spread: below(value, SPREAD),
            distant: (below(value, DISTANT) + below(value, REMOTE)) * escapes * (one - monotone),
            escapes,
            sensitivity,
        }
    }
}

impl Class<f64> {
    /// How the motion is computed.
    pub fn kind(&self, timed: bool) -> Kind {
        Kind::of([self.plain, self.spread, self.distant], timed)
    }
}

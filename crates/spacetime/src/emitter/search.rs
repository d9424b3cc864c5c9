//! Where circular orbits of a metric begin and end.

use super::family::Family;
use crate::geodesic::root;
use crate::metric::Metric;

/// Distance from the hole, as a share of that before, at which orbits are looked at next.
const STRIDE: f64 = 0.96;

/// Orbits of this share of their distance from the inner end are not looked for.
const NEAREST: f64 = 1e-9;

/// The stable orbits of a family that are met first from outside.
#[derive(Clone, Copy, Debug)]
pub struct Stable {
    /// The ρ of the last one inwards, or the least that was looked at.
    pub inner: f64,
    /// Whether the orbit within it is unstable: whether dE/dρ vanishes at `inner`.
    pub ends: bool,
    /// The largest ρ of which they were seen to be stable.
    pub outer: f64,
}

/// The least ρ: the horizon, the throat, or next to the centre.
pub fn inner_end<M: Metric>(metric: &M, outer: f64) -> f64 {
    let horizon = metric.horizon();
    if !(horizon > 0.0) {
        return 0.0;
    }
    // Within where light is captured.
    let inside = |x: f64| metric.inverse_depth(1.0 / x, &[1.0, 0.0, 0.0]) * horizon - 1.0;
    let (mut low, mut high) = (0.0, outer);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if inside(middle) < 0.0 { high = middle } else { low = middle }
    }
    high
}

/// Follows a family inwards from `outer` to `end` for its stable orbits, dE/dρ > 0 (|L| grows with E, as dE = Ω dL).
pub fn stable<M: Metric>(family: &Family<'_, M>, end: f64, outer: f64) -> Option<Stable> {
    let slope = |x: f64| family.ring(x).map_or(f64::NAN, |ring| ring.energy_slope);
    let mut gap = outer - end;
    let mut first = None;
    let mut before = (outer, f64::NAN);
    while gap > NEAREST * outer {
        let x = end + gap;
        let here = slope(x);
        if here > 0.0 {
            first = first.or(Some(x));
        } else if let Some(outer) = first {
            return Some(Stable { inner: last(slope, [x, here], [before.0, before.1]), ends: true, outer });
        }
        before = (x, here);
        gap *= STRIDE;
    }
    first.map(|outer| Stable { inner: before.0, ends: false, outer })
}

/// Where the slope vanishes between an orbit that is not stable, or is none, and one that is.
fn last(slope: impl Fn(f64) -> f64, [mut inside, mut value]: [f64; 2], [outside, stable]: [f64; 2]) -> f64 {
    // Orbits end where light goes around, and dE/dρ is without bound there: halved until there is a slope.
    let (mut low, mut high) = (inside, outside);
    let mut steepest = stable;
    while !(value < 0.0) {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return high;
        }
        let here = slope(middle);
        if here < 0.0 {
            (inside, value) = (middle, here);
        } else if here > 0.0 {
            (high, steepest) = (middle, here);
        } else {
            low = middle;
        }
    }
    let share = |t: f64| slope(inside + t * (high - inside));
    inside + root(share, value, steepest) * (high - inside)
}

/// The ρ of the circular photon orbit next within the stable orbits from `inner` on: where the rate of light that goes around
/// has an extremum.
pub fn photon_orbit<M: Metric>(family: &Family<'_, M>, end: f64, inner: f64) -> Option<f64> {
    let slope = |x: f64| family.light_slope(x);
    let (mut gap, mut there) = (inner - end, inner);
    let sign = slope(inner).signum();
    while gap > NEAREST * inner {
        gap *= STRIDE;
        let x = end + gap;
        let (near, far) = (slope(x), slope(there));
        if near * sign < 0.0 {
            return Some(x + root(|t| slope(x + t * (there - x)), near, far) * (there - x));
        }
        there = x;
    }
    None
}

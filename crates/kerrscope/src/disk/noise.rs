//! Value noise: random numbers on a lattice, joined smoothly.
//!
//! The numbers come from an integer hash and the joining uses sums and products alone,
//! so the noise is the same on every machine.

use crate::random::{mix, unit};

/// Smooth noise from 0 to 1 that depends on a seed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Noise {
    seed: u64,
}

impl Noise {
    /// Noise of a seed; each `layer` is independent of the others.
    pub(super) const fn new(seed: u64, layer: u64) -> Self {
        Self { seed: mix(seed ^ mix(layer)) }
    }

    /// Noise along a line, one random value at each whole number.
    pub(super) fn line(self, x: f64) -> f64 {
        self.sheet(x, 0.0, 1)
    }

    /// Noise on a sheet, one random value at each pair of whole numbers; periodic in `y`.
    pub(super) fn sheet(self, x: f64, y: f64, period: i64) -> f64 {
        let (i, j) = (x.floor(), y.floor());
        let (fx, fy) = (smooth(x - i), smooth(y - j));
        let (i, j) = (i as i64, j as i64);
        let row = |j: i64| lerp(self.value(i, j, period), self.value(i + 1, j, period), fx);
        lerp(row(j), row(j + 1), fy)
    }

    fn value(self, i: i64, j: i64, period: i64) -> f64 {
        let j = j.rem_euclid(period);
        unit(mix(self.seed ^ mix(i.cast_unsigned() ^ mix(j.cast_unsigned()))))
    }
}

/// Joins two levels with zero slope at both ends: 3t² − 2t³.
pub(super) fn smooth(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

pub(super) fn lerp(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}

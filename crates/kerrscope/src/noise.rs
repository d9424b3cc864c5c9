//! Value noise: random numbers on a lattice, joined smoothly.
//!
//! The numbers come from an integer hash and the joining uses sums and products alone,
//! so the noise is the same on every machine.

use crate::random::{mix, unit};

/// Random odd numbers.
const STRIDES: [u64; 3] = [mix(1) | 1, mix(2) | 1, mix(3) | 1];

/// Smooth noise from 0 to 1 that depends on a seed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Noise {
    seed: u64,
}

impl Noise {
    /// Noise of a seed; each `layer` is independent of the others.
    pub(crate) const fn new(seed: u64, layer: u64) -> Self {
        Self { seed: mix(seed ^ mix(layer)) }
    }

    /// Noise along a line, one random value at each whole number.
    pub(crate) fn line(self, x: f64) -> f64 {
        self.sheet(x, 0.0, 1)
    }

    /// Noise on a sheet, one random value at each pair of whole numbers; periodic in `y`.
    pub(crate) fn sheet(self, x: f64, y: f64, period: i64) -> f64 {
        let (i, j) = (x.floor(), y.floor());
        let (fx, fy) = (smooth(x - i), smooth(y - j));
        let (i, j) = (i as i64, j as i64);
        let row = |j: i64| lerp(self.value(i, j, period), self.value(i + 1, j, period), fx);
        lerp(row(j), row(j + 1), fy)
    }

    /// Noise in space, one random value at each triple of whole numbers.
    pub(crate) fn space(self, at: [f64; 3]) -> f64 {
        let cell = at.map(f64::floor);
        let [fx, fy, fz] = [0, 1, 2].map(|k| smooth(at[k] - cell[k]));
        // One hash a corner: of its numbers times random strides.
        let [x, y, z] = [0, 1, 2].map(|k| (cell[k] as i64).cast_unsigned().wrapping_mul(STRIDES[k]));
        let corner = |x: u64, y, z| unit(mix(self.seed ^ x.wrapping_add(y).wrapping_add(z)));
        let next = |x: u64, k: usize| x.wrapping_add(STRIDES[k]);
        let row = |y, z| lerp(corner(x, y, z), corner(next(x, 0), y, z), fx);
        let sheet = |z| lerp(row(y, z), row(next(y, 1), z), fy);
        lerp(sheet(z), sheet(next(z, 2)), fz)
    }

    fn value(self, i: i64, j: i64, period: i64) -> f64 {
        unit(mix(self.seed ^ mix(i.cast_unsigned() ^ mix(j.rem_euclid(period).cast_unsigned()))))
    }
}

/// Joins two levels with zero slope at both ends: 3t² − 2t³.
pub(crate) fn smooth(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

pub(crate) fn lerp(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_in_space_is_random_on_its_lattice_and_smooth_between() {
        let noise = Noise::new(7, 3);
        let lattice: Vec<f64> = (0..4096)
            .map(|n| noise.space([n / 256, n / 16 % 16, n % 16].map(|k| f64::from(k - 8))))
            .collect();
        // Of n numbers evenly from 0 to 1, the mean is off by 1/√(12 n), a 220th: five times as much.
        let mean = lattice.iter().sum::<f64>() / 4096.0;
        assert!((mean - 0.5).abs() < 0.0226, "{mean}");
        assert!(lattice.iter().all(|x| (0.0..1.0).contains(x)));
        // The slope of 3t² − 2t³ is 1.5 at most, in each of three directions.
        let step = 1e-3;
        for n in 0..3000 {
            let at = [0.37, -1.9, 2.3].map(|speed| speed * f64::from(n) * step);
            let next = [0.37, -1.9, 2.3].map(|speed| speed * f64::from(n + 1) * step);
            let far: f64 = (0..3).map(|k| (next[k] - at[k]).abs()).sum();
            assert!((noise.space(next) - noise.space(at)).abs() <= 1.5 * far, "{at:?}");
        }
        assert_ne!(noise.space([0.5; 3]), Noise::new(7, 4).space([0.5; 3]));
    }
}

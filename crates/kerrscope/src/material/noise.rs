//! Cloudy noise in space: value noise at several scales.

use crate::noise::Noise as Scale;
use crate::spacetime::tensor::Vec3;

/// How many scales are added, each half as large and half as strong as the one before.
const OCTAVES: u64 = 5;

/// Cloudy noise from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    seed: u64,
    /// 1/(size of the largest clouds), 1/M.
    fineness: f64,
}

impl Noise {
    /// That of a seed, with its largest clouds of about this size, in M.
    pub fn new(seed: u64, size: f64) -> Self {
        Self { seed, fineness: 1.0 / size }
    }

    /// Its value at a place. Finite for any numbers.
    pub fn at(&self, x: &Vec3<f64>) -> f64 {
        let (mut sum, mut most, mut share, mut fineness) = (0.0, 0.0, 1.0, self.fineness);
        for octave in 0..OCTAVES {
            let at = x.map(|c| if c.is_finite() { c * fineness } else { 0.0 });
            sum += share * Scale::new(self.seed, octave).space(at);
            most += share;
            share *= 0.5;
            fineness *= 2.0;
        }
        // A sum of even numbers is seldom near its ends: three standard deviations are stretched over the range.
        (0.5 + 1.8 * (sum / most - 0.5)).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_smooth_and_fills_its_range() {
        let noise = Noise::new(7, 2.0);
        let values: Vec<f64> = (0..20_000).map(|k| noise.at(&[f64::from(k) * 0.01, 3.3, -8.1])).collect();
        // Slopes: each octave at most 1.5 per cell and 1/2 of it in the sum, the sum of shares being 31/16.
        let steepest = 1.8 * 5.0 * 1.5 * 0.5 / (31.0 / 16.0);
        assert!(values.windows(2).all(|w| (w[1] - w[0]).abs() <= steepest * 0.01));
        assert!(values.iter().all(|v| (0.0..=1.0).contains(v)));
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        assert!((mean - 0.5).abs() < 0.1, "{mean}");
        let least = values.iter().copied().fold(1.0, f64::min);
        assert!(least < 0.2, "{least}");
        assert_ne!(Noise::new(8, 2.0).at(&[0.5; 3]), noise.at(&[0.5; 3]));
        assert!(noise.at(&[f64::NAN, f64::INFINITY, 1e300]).is_finite());
    }
}

//! Counts over the rays of a picture.

use serde::{Deserialize, Serialize};

/// Counts over the rays of a picture.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct Tally {
    /// Rays traced.
    pub rays: u64,
    /// Rays given up on, or whose error is not known; what they would have met is missing in the picture.
    pub given_up: u64,
    /// Integration steps.
    pub steps: u64,
    /// Largest error estimate; 0 if there are none.
    pub worst: f64,
    /// Rays by the power of two of their error estimate: number k holds 2^(k − 64) to 2^(k − 63), the first
    /// all that is less, the last all that is more.
    octaves: Vec<u64>,
    /// What was interpolated between rays.
    pub interpolation: Interpolation,
}

/// How much of a picture was interpolated between rays, and how well.
///
/// Errors are relative for the radii of crossings, and radians for their azimuths and for directions.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct Interpolation {
    /// Samples that were interpolated.
    pub samples: u64,
    /// Those among them, picked by chance, that were traced as well.
    pub compared: u64,
    /// Those compared that end or cross the plane otherwise than was interpolated.
    pub missed: u64,
    /// Largest error of the others compared.
    pub worst: f64,
}

impl Interpolation {
    /// Adds what is known of another part of the picture.
    pub fn add(&mut self, other: &Self) {
        self.samples += other.samples;
        self.compared += other.compared;
        self.missed += other.missed;
        self.worst = worse(self.worst, other.worst);
    }
}

/// The larger of two errors. What is not a number is no small error.
pub(super) fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b <= a { a } else { b }
}

/// Powers of two from 2⁻⁶⁴ to 2³¹.
const OCTAVES: usize = 96;
const LOWEST: i32 = -64;

impl Tally {
    /// Counts a ray; `given_up` rays have no estimate.
    pub fn count(&mut self, steps: usize, estimate: f64, given_up: bool) {
        self.rays += 1;
        self.steps += steps as u64;
        if given_up || !estimate.is_finite() {
            self.given_up += 1;
            return;
        }
        self.worst = self.worst.max(estimate);
        if self.octaves.is_empty() {
            self.octaves = vec![0; OCTAVES];
        }
        // The exponent of a positive number is that of the power of two below it.
        let exponent = (estimate.abs().to_bits() >> 52) as i32 - 1023;
        self.octaves[usize::try_from(exponent - LOWEST).unwrap_or(0).min(OCTAVES - 1)] += 1;
    }

    /// Adds the counts of other rays. The order does not matter.
    pub fn add(&mut self, other: &Self) {
        self.rays += other.rays;
        self.given_up += other.given_up;
        self.steps += other.steps;
        self.worst = self.worst.max(other.worst);
        self.interpolation.add(&other.interpolation);
        if self.octaves.is_empty() {
            self.octaves.clone_from(&other.octaves);
        } else {
            for (octave, count) in self.octaves.iter_mut().zip(&other.octaves) {
                *octave += count;
            }
        }
    }

    /// The error estimate that a share of the rays stays below, to within a factor of two
    /// (rounded up); none if every ray was given up on.
    pub fn quantile(&self, share: f64) -> Option<f64> {
        let total: u64 = self.octaves.iter().sum();
        let mut rest = share * total as f64;
        (LOWEST..).zip(&self.octaves).find_map(|(octave, &count)| {
            rest -= count as f64;
            (count > 0 && rest <= 0.0).then(|| 2f64.powi(octave + 1))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_a_number_stays_the_worst() {
        assert_eq!([1e-2, 1e-9].into_iter().fold(0.0, worse), 1e-2);
        for errors in [[f64::NAN, 1e-2, 1e-9], [1e-2, f64::NAN, 1e-9], [1e-2, 1e-9, f64::NAN]] {
            assert!(errors.into_iter().fold(0.0, worse).is_nan());
        }
    }

    #[test]
    fn quantiles_bound_the_estimates() {
        let mut tally = Tally::default();
        for k in 1..=100 {
            tally.count(3, 1e-12 * f64::from(k), false);
        }
        tally.count(10_000, f64::NAN, true);
        assert_eq!((tally.rays, tally.given_up), (101, 1));
        let median = tally.quantile(0.5).unwrap();
        assert!((5e-11..=1e-10).contains(&median), "{median:e}");
        assert!(tally.quantile(1.0).unwrap() >= 1e-10);
        let mut none = Tally::default();
        none.count(10_000, 1.0, true);
        assert_eq!(none.quantile(0.5), None);
        none.add(&tally);
        assert_eq!(none.quantile(0.5), Some(median));
    }
}

//! Counts over the rays of a picture.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

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
    /// Rays by the power of two of their error estimate: k holds 2^k to 2^(k+1).
    octaves: BTreeMap<i16, u64>,
}

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
        let octave = estimate.max(f64::MIN_POSITIVE).log2().floor();
        *self.octaves.entry(octave as i16).or_default() += 1;
    }

    /// Adds the counts of other rays. The order does not matter.
    pub fn add(&mut self, other: &Self) {
        self.rays += other.rays;
        self.given_up += other.given_up;
        self.steps += other.steps;
        self.worst = self.worst.max(other.worst);
        for (&octave, count) in &other.octaves {
            *self.octaves.entry(octave).or_default() += count;
        }
    }

    /// The error estimate that a share of the rays stays below, to within a factor of two
    /// (rounded up); none if every ray was given up on.
    pub fn quantile(&self, share: f64) -> Option<f64> {
        let total: u64 = self.octaves.values().sum();
        let mut rest = share * total as f64;
        self.octaves.iter().find_map(|(&octave, &count)| {
            rest -= count as f64;
            (rest <= 0.0).then(|| 2f64.powi(i32::from(octave) + 1))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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

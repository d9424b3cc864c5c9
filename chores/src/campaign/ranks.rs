//! Whether ranks are uniform: their distribution's curve within simultaneous bands (Säilynoja, Bürkner & Vehtari 2022, Statistics and
//! Computing 32, 32, section 2).
//!
//! At each of some points the number of ranks below it is binomial. Bands are intervals of one level at all points, such that curves of
//! uniform ranks leave none of them with the probability asked for; the level is found by drawing many such curves.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Curves that are drawn.
const CURVES: usize = 20_000;

/// Bands around the curve of a number of uniform ranks.
pub struct Band {
    count: usize,
    /// The least and the largest number of ranks below k/count.
    bounds: Vec<[usize; 2]>,
}

impl Band {
    /// Bands that uniform curves stay within with a probability.
    pub fn new(count: usize, probability: f64, seed: u64) -> Self {
        let below: Vec<Vec<f64>> = (0..=count).map(|k| cumulative(count, k as f64 / count as f64)).collect();
        // The smallest two-sided level at which a curve touches a bound.
        let level = |counts: &[usize]| {
            (1..count)
                .map(|k| {
                    let up_to = below[k][counts[k]];
                    let from = 1.0 - if counts[k] == 0 { 0.0 } else { below[k][counts[k] - 1] };
                    2.0 * up_to.min(from)
                })
                .fold(f64::INFINITY, f64::min)
        };
        let mut rng = Pcg64Mcg::seed_from_u64(seed);
        let mut levels: Vec<f64> = (0..CURVES)
            .map(|_| {
                let ranks: Vec<f64> = (0..count).map(|_| rng.random()).collect();
                level(&counts(&ranks, count))
            })
            .collect();
        levels.sort_by(f64::total_cmp);
        let chosen = levels[((1.0 - probability) * CURVES as f64) as usize];
        let bounds = (0..=count)
            .map(|k| {
                let inside = |n: usize| {
                    let from = 1.0 - if n == 0 { 0.0 } else { below[k][n - 1] };
                    2.0 * below[k][n].min(from) >= chosen
                };
                let low = (0..=count).find(|n| inside(*n)).unwrap_or(0);
                let high = (0..=count).rev().find(|n| inside(*n)).unwrap_or(count);
                [low, high]
            })
            .collect();
        Self { count, bounds }
    }
}

/// How far the curve of ranks goes to the edge of the band, at its worst: more than 1 where it leaves it.
pub fn departure(band: &Band, ranks: &[f64]) -> f64 {
    let counts = counts(ranks, band.count);
    (1..band.count)
        .map(|k| {
            let [low, high] = band.bounds[k].map(|n| n as f64);
            let (found, middle) = (counts[k] as f64, ranks.len() as f64 * k as f64 / band.count as f64);
            // The first number outside is at 1.
            if found >= middle {
                (found - middle) / (high + 1.0 - middle)
            } else {
                (middle - found) / (middle - low + 1.0)
            }
        })
        .fold(0.0, f64::max)
}

/// How many ranks are at most k/count, for each k.
fn counts(ranks: &[f64], count: usize) -> Vec<usize> {
    let mut counts = vec![0; count + 1];
    for rank in ranks {
        counts[((rank * count as f64).ceil() as usize).min(count)] += 1;
    }
    for k in 0..count {
        counts[k + 1] += counts[k];
    }
    counts
}

/// The probability of at most n of `count` events that have a chance each.
fn cumulative(count: usize, chance: f64) -> Vec<f64> {
    let mut logs = 0.0;
    let mut sum = 0.0;
    (0..=count)
        .map(|n| {
            if n > 0 {
                logs += ((count - n + 1) as f64 / n as f64).ln();
            }
            let term = |exponent: usize, p: f64| if exponent == 0 { 0.0 } else { exponent as f64 * p.ln() };
            sum += (logs + term(n, chance) + term(count - n, 1.0 - chance)).exp();
            sum.min(1.0)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One in a hundred uniform curves leaves the band, and ranks of errors a third too small, or shifted, do.
    #[test]
    fn bands_hold_what_they_should() {
        let band = Band::new(100, 0.99, 1);
        let mut rng = Pcg64Mcg::seed_from_u64(2);
        let left = (0..5000)
            .filter(|_| departure(&band, &(0..100).map(|_| rng.random()).collect::<Vec<f64>>()) >= 1.0)
            .count();
        // Binomial: 50 ± 7.
        assert!((22..=78).contains(&left), "{left}");
        let even = |k: usize| (k as f64 + 0.5) / 100.0;
        let at = |f: &dyn Fn(f64) -> f64| departure(&band, &(0..100).map(|k| f(even(k))).collect::<Vec<_>>());
        assert!(at(&|x| x) < 0.2);
        assert!(at(&|x| x * x) > 1.0);
        assert!(at(&|x| if x < 0.5 { 2.0 * x * x } else { 1.0 - 2.0 * (1.0 - x) * (1.0 - x) }) > 1.0);
    }

    #[test]
    fn binomial() {
        let half = cumulative(4, 0.5);
        for (found, wanted) in half.iter().zip([1.0, 5.0, 11.0, 15.0, 16.0]) {
            assert!((found - wanted / 16.0).abs() < 1e-14);
        }
        assert_eq!(cumulative(3, 0.0), vec![1.0; 4]);
    }
}

//! How many pixels at edges err together.

use crate::likelihood::Noise;

/// Pixels within which residuals are taken to go together, if at all: stretches of an edge.
const WITHIN: usize = 10;

/// A pixel has an edge if its share is no closer to none or all.
const EDGE: f64 = 0.02;

/// The noise of pixels that are independent of each other and tell as much as those of a silhouette. Its size s is that of the residuals
/// where edges of the `best` model are, without the pixels beside them, which hardly err; and residuals make groups of τ pixels,
///
/// ```text
/// τ = Σ r_i r_j/Σ r_i² + 1/(12 s²)   over pairs at edges no farther apart than a stretch,
/// ```
///
/// so that variances are τ times as large. The last term is of the bend of the tone curve: it makes the mean share of n pixels of about the
/// same brightness what is expected, which shares that are spread evenly from 0 to 1 have to 1/√(12 n), and all n err by that
/// together: n (1/√(12 n))²/s².
pub fn grouped(noise: &Noise, [width, height]: [usize; 2], data: &[f64], best: &[f64]) -> Noise {
    let Some(unknown) = &noise.unknown else { return noise.clone() };
    let residuals: Vec<f64> = data.iter().zip(best).map(|(d, m)| d - m).collect();
    let (mut sum, mut count) = (0.0, 0.0);
    for pixel in 0..residuals.len() {
        let pattern = unknown.pattern[pixel];
        if pattern > 0.0 && noise.known[pixel] < 1.0 && best[pixel] > EDGE && best[pixel] < 1.0 - EDGE {
            (sum, count) = (sum + (residuals[pixel] / pattern).powi(2), count + 1.0);
        }
    }
    let size = if count > 0.0 { f64::sqrt(sum / count) } else { unknown.guess };
    // In their own standard deviations.
    let pulls: Vec<f64> = residuals
        .iter()
        .zip(&unknown.pattern)
        .zip(&noise.known)
        .map(|((r, pattern), known)| if *pattern > 0.0 { r / known.hypot(size * pattern) } else { 0.0 })
        .collect();
    let (mut pairs, mut squares) = (0.0, 0.0);
    for pixel in (0..pulls.len()).filter(|pixel| pulls[*pixel] != 0.0) {
        let (column, row) = (pixel % width, pixel / width);
        squares += pulls[pixel] * pulls[pixel];
        for y in row.saturating_sub(WITHIN)..(row + WITHIN + 1).min(height) {
            for x in column.saturating_sub(WITHIN)..(column + WITHIN + 1).min(width) {
                // Weights that fall to 0 keep the sum positive (Bartlett 1950).
                let far = [x.abs_diff(column), y.abs_diff(row)].map(|d| 1.0 - d as f64 / (WITHIN + 1) as f64);
                pairs += far[0] * far[1] * pulls[pixel] * pulls[y * width + x];
            }
        }
    }
    let bend = 1.0 / (12.0 * (size * size).max(1e-6));
    let together = bend + if squares > 0.0 { (pairs / squares).max(1.0) } else { 1.0 };
    let known = unknown
        .pattern
        .iter()
        .zip(&noise.known)
        .map(|(pattern, known)| {
            if *pattern > 0.0 { (known * known + together * (size * pattern).powi(2)).sqrt() } else { *known }
        })
        .collect();
    Noise { known, unknown: None }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::likelihood::Unknown;
    use rand::{RngExt, SeedableRng};

    /// Residuals that are the same for five pixels in a row count a fifth.
    #[test]
    fn groups_count_as_one() {
        let size = [2000, 1];
        let unknown = Unknown { pattern: vec![1.0; 2000], guess: 1.0, spread: f64::INFINITY };
        let noise = Noise { known: vec![0.0; 2000], unknown: Some(unknown) };
        let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(3);
        let signs: Vec<f64> = (0..2000).map(|_| if random.random::<bool>() { 1.0 } else { -1.0 }).collect();
        let variance = |group: usize| {
            // Large ones, beside which the bend is nothing.
            let data: Vec<f64> = (0..2000).map(|k| 0.5 + signs[k / group]).collect();
            grouped(&noise, size, &data, &[0.5; 2000]).known[0].powi(2)
        };
        assert!((1.0..1.6).contains(&variance(1)), "{}", variance(1));
        assert!((3.5..6.0).contains(&variance(5)), "{}", variance(5));
    }
}

//! What a tone curve makes of the light of pixels at edges.
//!
//! A share c of light of a level becomes y = K c/(1 + (K − 1) c) of what that level becomes: the curve x/(1 + x) does so exactly, with K = 1 + level,
//! and others nearly. K depends on the level. Along an outline a straight edge has every distance from a pixel's middle equally often, so that the
//! mean of y over pixels of about the same level is known as a function of K.

use super::edge::{Sharp, covered};

/// Slants and distances over which expectations are taken.
const SLANTS: usize = 12;
const DISTANCES: usize = 96;

/// Pixels of about the same level, at least, and levels at most.
const ENOUGH: usize = 100;
const LEVELS: usize = 4;

/// The least and the largest K: the least that of a curve that goes with the square next to black. With less, pixels that are hardly
/// covered would be dark, and the mean would grow again.
const RANGE: [f64; 2] = [0.3, 200.0];

/// K by levels.
#[derive(Clone, Debug)]
pub struct Curve {
    /// (ln level, ln K), levels rising.
    knots: Vec<[f64; 2]>,
}

/// y of a share.
pub fn bent(share: f64, bend: f64) -> f64 {
    bend * share / (1.0 + (bend - 1.0) * share)
}

/// For every slant, shares of pixels at all distances from an edge that goes through them or beside them, and the least of their
/// neighbours'.
struct Expected {
    shares: Vec<[f64; 2]>,
}

impl Expected {
    fn new(slant: f64) -> Self {
        let (sin, cos) = slant.sin_cos();
        let shares = (0..DISTANCES)
            .map(|k| {
                let distance = -0.8 + 2.6 * (k as f64 + 0.5) / DISTANCES as f64;
                // The darkest neighbour is at a corner.
                [covered(distance, slant), covered(distance - cos - sin, slant)]
            })
            .collect();
        Self { shares }
    }

    /// Mean of y, cut at 1, over pixels that are lit and have a dark neighbour.
    fn mean(&self, bend: f64, faint: f64) -> f64 {
        let (mut sum, mut count) = (0.0, 0.0);
        for [share, darkest] in &self.shares {
            let value = bent(*share, bend);
            if value > faint && bent(*darkest, bend) <= faint {
                (sum, count) = (sum + value, count + 1.0);
            }
        }
        if count > 0.0 { sum / count } else { 1.0 }
    }
}

impl Curve {
    /// From pixels at edges.
    pub fn of<'a>(pixels: impl Iterator<Item = &'a Sharp>) -> Self {
        let mut pixels: Vec<Sharp> = pixels.copied().collect();
        pixels.sort_by(|a, b| a.level.total_cmp(&b.level));
        let slant = |k: usize| std::f64::consts::FRAC_PI_4 * (k as f64 + 0.5) / SLANTS as f64;
        let expected: Vec<Expected> = (0..SLANTS).map(|k| Expected::new(slant(k))).collect();
        let groups = (pixels.len() / ENOUGH).clamp(1, LEVELS);
        let knots = pixels
            .chunks(pixels.len().div_ceil(groups).max(1))
            .map(|group| {
                let count = group.len() as f64;
                let mut slants = [0.0; SLANTS];
                for pixel in group {
                    let k = (pixel.slant / std::f64::consts::FRAC_PI_4 * SLANTS as f64) as usize;
                    slants[k.min(SLANTS - 1)] += 1.0 / count;
                }
                let mean = group.iter().map(|pixel| pixel.share.clamp(0.0, 1.0)).sum::<f64>() / count;
                let faint = group.iter().map(|pixel| pixel.faint).sum::<f64>() / count;
                let [mut low, mut high] = RANGE.map(f64::ln);
                for _ in 0..40 {
                    let middle = 0.5 * (low + high);
                    let both = expected.iter().zip(&slants);
                    let there: f64 = both.map(|(e, weight)| weight * e.mean(middle.exp(), faint)).sum();
                    if there < mean { low = middle } else { high = middle }
                }
                [group[group.len() / 2].level.ln(), 0.5 * (low + high)]
            })
            .collect();
        Self { knots }
    }

    /// K of a level, between knots by straight lines in logarithms.
    fn at(&self, level: f64) -> f64 {
        let x = level.ln();
        let after = self.knots.iter().position(|knot| knot[0] > x).unwrap_or(self.knots.len());
        let log = match after {
            0 => self.knots[0][1],
            k if k == self.knots.len() => self.knots[k - 1][1],
            k => {
                let [from, to] = [self.knots[k - 1], self.knots[k]];
                from[1] + (x - from[0]) / (to[0] - from[0]) * (to[1] - from[1])
            }
        };
        log.exp()
    }

    /// The share of a pixel that is lit.
    pub fn share(&self, pixel: &Sharp) -> f64 {
        let y = pixel.share.clamp(0.0, 1.0);
        let bend = self.at(pixel.level);
        y / (bend + (1.0 - bend) * y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// K of edges of many slants and distances is found again at every level.
    #[test]
    fn a_curve_is_found() {
        let mut pixels = Vec::new();
        for k in 0..4000_u32 {
            let random = |salt: u32| {
                f64::from((k + salt).wrapping_mul(2_654_435_761).rotate_left(salt) >> 8) / f64::from(1 << 24)
            };
            let (slant, distance, level) = (random(3) * 0.785, random(9) * 2.6 - 0.8, 0.1 + random(17));
            let (sin, cos) = f64::sin_cos(slant);
            let [share, darkest] = [covered(distance, slant), covered(distance - cos - sin, slant)];
            let faint = 0.01;
            let bend = 1.0 + 4.0 * level;
            if bent(share, bend) > faint && bent(darkest, bend) <= faint {
                pixels.push((share, Sharp { share: bent(share, bend), level, faint, slant }));
            }
        }
        let curve = Curve::of(pixels.iter().map(|(_, pixel)| pixel));
        let errors: Vec<f64> = pixels.iter().map(|(share, pixel)| curve.share(pixel) - share).collect();
        let mean = errors.iter().sum::<f64>() / errors.len() as f64;
        let worst = errors.iter().fold(0.0_f64, |worst, error| worst.max(error.abs()));
        assert!(mean.abs() < 0.01 && worst < 0.1, "{mean} {worst}");
    }
}

//! What a render leaves: linear light, and how good it is.

use crate::light::Light;

/// A picture in linear light.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Mean light of each pixel's rays, along the rows, the top row first.
    pub pixels: Vec<Light>,
    /// What is known of the rays.
    pub tally: Tally,
}

/// Where a picture's light lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments {
    /// Mean place, from the picture's middle, right and up.
    pub centroid: [f64; 2],
    /// Widths along the major and the minor axis: 2√(2 ln 2) standard deviations, which is the
    /// full width at half maximum of a Gaussian.
    pub size: [f64; 2],
}

impl Film {
    /// First and second moments of the luminance (Rec. 709), in units in which a pixel has the
    /// size `pixel`. `None` for a dark picture.
    pub fn moments(&self, pixel: f64) -> Option<Moments> {
        let (mut sum, mut first, mut second) = (0.0, [0.0; 2], [0.0; 3]);
        let middle = [0.5 * f64::from(self.width), 0.5 * f64::from(self.height)];
        for (row, line) in self.pixels.chunks_exact(self.width as usize).enumerate() {
            for (column, light) in line.iter().enumerate() {
                let [r, g, b] = light.rgb;
                let weight = 0.2126 * r + 0.7152 * g + 0.0722 * b;
                let (x, y) = (column as f64 + 0.5 - middle[0], middle[1] - row as f64 - 0.5);
                sum += weight;
                first = [first[0] + weight * x, first[1] + weight * y];
                second = [second[0] + weight * x * x, second[1] + weight * x * y, second[2] + weight * y * y];
            }
        }
        if !(sum > 0.0) {
            return None;
        }
        let [x, y] = first.map(|f| f / sum);
        let [xx, xy, yy] = [second[0] / sum - x * x, second[1] / sum - x * y, second[2] / sum - y * y];
        // Eigenvalues of the covariance.
        let (mean, half) = (0.5 * (xx + yy), (0.25 * (xx - yy).powi(2) + xy * xy).sqrt());
        let width = |variance: f64| (8.0 * 2f64.ln() * variance.max(0.0)).sqrt() * pixel;
        Some(Moments { centroid: [x * pixel, y * pixel], size: [width(mean + half), width(mean - half)] })
    }
}

/// Counts over the rays of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Tally {
    /// Rays traced.
    pub rays: u64,
    /// Rays given up on, or whose error is not known; what they would have met is missing in the picture.
    pub given_up: u64,
    /// Integration steps.
    pub steps: u64,
    /// Largest error estimate; 0 if there are none.
    pub worst: f64,
    /// Rays by the power of two of their error estimate: number k holds 2^(k−64) to 2^(k−63).
    octaves: [u64; 128],
}

impl Default for Tally {
    fn default() -> Self {
        Self { rays: 0, given_up: 0, steps: 0, worst: 0.0, octaves: [0; 128] }
    }
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
        let octave = (estimate.max(f64::MIN_POSITIVE).log2().floor() + 64.0).clamp(0.0, 127.0);
        self.octaves[octave as usize] += 1;
    }

    /// Adds the counts of other rays. The order does not matter.
    pub fn add(&mut self, other: &Self) {
        self.rays += other.rays;
        self.given_up += other.given_up;
        self.steps += other.steps;
        self.worst = self.worst.max(other.worst);
        for (mine, theirs) in self.octaves.iter_mut().zip(&other.octaves) {
            *mine += theirs;
        }
    }

    /// The error estimate that a share of the rays stays below, to within a factor of two
    /// (rounded up); none if every ray was given up on.
    pub fn quantile(&self, share: f64) -> Option<f64> {
        let total: u64 = self.octaves.iter().sum();
        let mut rest = share * total as f64;
        for (octave, &count) in (-63..).zip(&self.octaves) {
            rest -= count as f64;
            if count > 0 && rest <= 0.0 {
                return Some(2f64.powi(octave));
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_of_two_dots() {
        let mut film = Film { width: 8, height: 4, pixels: vec![Light::DARK; 32], tally: Tally::default() };
        assert!(film.moments(1.0).is_none());
        // At (1.5, 0.5) and (6.5, 0.5) from the top left: 5 apart, 1.5 above the middle.
        film.pixels[1] = Light::new([1.0; 3]);
        film.pixels[6] = Light::new([1.0; 3]);
        let m = film.moments(2.0).unwrap();
        assert!((m.centroid[0]).abs() < 1e-14 && (m.centroid[1] - 3.0).abs() < 1e-14);
        assert!((m.size[0] - (8.0 * 2f64.ln()).sqrt() * 5.0).abs() < 1e-12);
        assert!(m.size[1].abs() < 1e-6);
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
    }
}

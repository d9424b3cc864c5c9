//! Where in a pixel the rays lie: a function of (seed, pixel, sample) alone.

use crate::random::{mix, unit};

/// The places of the samples of a pixel.
///
/// A square number of samples is one in each cell of a square grid; any other number lies on a
/// golden-ratio lattice, shifted around the pixel by chance. Without jitter they lie at the
/// middle of their cells, or unshifted.
#[derive(Clone, Copy, Debug)]
pub struct Sampler {
    samples: u32,
    seed: u64,
    jitter: bool,
    /// Cells along an edge of the grid, if the number of samples is a square.
    cells: Option<u32>,
}

impl Sampler {
    /// The sampler for `samples` rays in each pixel.
    pub fn new(samples: u32, seed: u64, jitter: bool) -> Self {
        let root = samples.isqrt();
        Self { samples, seed, jitter, cells: (root * root == samples).then_some(root) }
    }

    /// Place of sample number `sample` of the pixel with running number `pixel`, each
    /// coordinate in [0, 1).
    pub fn place(&self, pixel: u64, sample: u32) -> [f64; 2] {
        if let Some(cells) = self.cells {
            let cell = [sample % cells, sample / cells].map(f64::from);
            let within = if self.jitter { self.chance(pixel, u64::from(sample)) } else { [0.5; 2] };
            return std::array::from_fn(|i| (cell[i] + within[i]) / f64::from(cells));
        }
        // The inverse of the golden ratio, whose multiples spread most evenly.
        let steps = [1.0 / f64::from(self.samples), 0.5 * (5f64.sqrt() - 1.0)];
        let shift = if self.jitter { self.chance(pixel, u64::MAX) } else { [0.5 * steps[0], 0.5] };
        std::array::from_fn(|i| (shift[i] + steps[i] * f64::from(sample)).fract())
    }

    /// Two numbers in [0, 1), independent for each (seed, pixel, sample).
    fn chance(&self, pixel: u64, sample: u64) -> [f64; 2] {
        let state = mix(self.seed ^ mix(pixel ^ mix(sample)));
        [state, mix(state)].map(unit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_fill_the_pixel() {
        for (samples, jitter) in [(1, true), (4, true), (16, false), (7, true), (12, false)] {
            let sampler = Sampler::new(samples, 3, jitter);
            let pixels = 4000 / u64::from(samples);
            let mut sum = [0.0; 2];
            let mut count = 0.0;
            for pixel in 0..pixels {
                for sample in 0..samples {
                    let place = sampler.place(pixel, sample);
                    assert!(place.iter().all(|c| (0.0..1.0).contains(c)));
                    sum = [sum[0] + place[0], sum[1] + place[1]];
                    count += 1.0;
                }
            }
            // A uniform mean of 4000 has a standard deviation of 0.0046; the unshifted sequence is
            // off by less than the share of one sample.
            let tolerance = if jitter { 0.03 } else { 1.0 / f64::from(samples) };
            assert!(sum.iter().all(|s| (s / count - 0.5).abs() < tolerance), "{samples}: {sum:?}");
        }
    }

    #[test]
    fn one_sample_in_each_cell() {
        let sampler = Sampler::new(9, 1, true);
        for sample in 0..9 {
            let [x, y] = sampler.place(77, sample);
            assert_eq!(((x * 3.0) as u32, (y * 3.0) as u32), (sample % 3, sample / 3));
        }
    }

    #[test]
    fn seeds_and_pixels_differ() {
        let place = |seed, pixel| Sampler::new(1, seed, true).place(pixel, 0);
        assert_ne!(place(1, 5), place(2, 5));
        assert_ne!(place(1, 5), place(1, 6));
        assert_eq!(place(1, 5), place(1, 5));
        assert_eq!(Sampler::new(1, 9, false).place(4, 0), [0.5, 0.5]);
    }
}

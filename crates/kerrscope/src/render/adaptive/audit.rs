//! How well a picture is interpolated: samples picked by chance are traced as well.

use super::knot::{Knots, difference};
use crate::random::mix;
use crate::render::stage::{Replay, Stage};
use crate::render::tally::{Tally, worse};

/// Samples picked in a large picture. Those in its traced parts, seldom more than a tenth, are not compared.
const WANTED: f64 = 12_000.0;
/// In a small one, the share of its samples.
const MOST: f64 = 1.0 / 20.0;

/// Chooses samples.
#[derive(Clone, Copy, Debug)]
pub(in crate::render) struct Audit {
    seed: u64,
    samples: u32,
    /// How many of a pixel's samples on average.
    rate: f64,
}

/// Samples to compare, with what was interpolated for them.
#[derive(Default)]
pub(super) struct Comparison {
    points: Vec<[f64; 2]>,
    interpolated: Knots,
}

impl Audit {
    pub(in crate::render) fn new([width, height]: [u32; 2], samples: u32, seed: u64) -> Self {
        let pixels = f64::from(width) * f64::from(height);
        let rate = (WANTED / pixels).min(MOST * f64::from(samples));
        Self { seed: mix(!seed), samples, rate }
    }

    /// The samples of a pixel that are compared.
    pub(super) fn samples(self, pixel: u64) -> impl Iterator<Item = u32> {
        let chance = mix(self.seed ^ mix(pixel));
        let whole = self.rate.floor();
        let one_more = (chance >> 11) as f64 * (1.0 / (1_u64 << 53) as f64) < self.rate - whole;
        let count = whole as u64 + u64::from(one_more);
        (0..count).map(move |k| (mix(chance ^ mix(k)) % u64::from(self.samples)) as u32)
    }
}

impl Comparison {
    /// Adds a sample at a point of the picture.
    pub(super) fn push(&mut self, point: [f64; 2], kind: super::knot::Kind, numbers: &[f64]) {
        self.points.push(point);
        self.interpolated.push_numbers(kind, numbers);
    }

    /// Traces the samples, and tells the tally of the differences.
    pub(super) fn judge(&self, stage: &Stage, replay: &mut Replay, tally: &mut Tally) {
        let mut exact = Knots::default();
        let plane = stage.plane();
        stage.trace(&self.points, replay, tally, |path| exact.push(path, &plane));
        let found = &mut tally.interpolation;
        for knot in 0..exact.count() as u32 {
            found.compared += 1;
            let kind = exact.kind(knot);
            if kind == self.interpolated.kind(knot) {
                let error = difference(kind, exact.numbers(knot), self.interpolated.numbers(knot));
                found.worst = worse(found.worst, error);
            } else {
                found.missed += 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_pictures_have_twelve_thousand_and_small_ones_a_twentieth() {
        for (size, samples, expected) in
            [([1920, 1080], 16, 12_000.0), ([100, 50], 4, 1000.0), ([64, 64], 400, 12_000.0)]
        {
            let audit = Audit::new(size, samples, 7);
            let mut chosen = 0;
            for pixel in 0..u64::from(size[0] * size[1]) {
                chosen += audit.samples(pixel).inspect(|sample| assert!(*sample < samples)).count();
            }
            // Five standard deviations at most.
            assert!((chosen as f64 - expected).abs() < 5.0 * expected.sqrt(), "{chosen}");
        }
    }
}

//! Bins that cells of light are spread over.

/// Flux in bins of g.
pub struct Spread {
    low: f64,
    width: f64,
    bins: Vec<f64>,
}

/// Cells have this width in g at least, as a share of a bin's.
const NARROWEST: f64 = 1e-6;

impl Spread {
    pub fn new([low, high]: [f64; 2], bins: usize) -> Self {
        Self { low, width: (high - low) / bins as f64, bins: vec![0.0; bins] }
    }

    /// Adds an amount from a cell in whose middle g is `middle`, and which differs by ± `halves` from side to side both ways:
    /// if g is linear in the cell, its distribution is a trapezium.
    pub fn add(&mut self, amount: f64, middle: f64, halves: [f64; 2]) {
        let least = NARROWEST * self.width;
        let long = halves[0].abs().max(halves[1].abs()).max(least);
        // A slope that is all but upright is as good as one.
        let short = halves[0].abs().min(halves[1].abs()).max(1e-3 * long);
        let reach = long + short;
        let first = ((middle - reach - self.low) / self.width).floor().max(0.0);
        let last = ((middle + reach - self.low) / self.width).floor().min(self.bins.len() as f64 - 1.0);
        if !(first <= last) {
            return;
        }
        let mut below = share(self.low + first * self.width - middle, long, short);
        for bin in first as usize..=last as usize {
            let above = share(self.low + (bin as f64 + 1.0) * self.width - middle, long, short);
            self.bins[bin] += amount * (above - below);
            below = above;
        }
    }

    /// The mean density in each bin.
    pub fn densities(self) -> Vec<f64> {
        self.bins.into_iter().map(|sum| sum / self.width).collect()
    }
}

/// The share of a trapezium below x: that of the sum of two even distributions over ± long and ± short. Its middle is
/// even, its ends are parabolas.
fn share(x: f64, long: f64, short: f64) -> f64 {
    let (flat, reach) = (long - short, long + short);
    let size = x.abs();
    let half = if size >= reach {
        0.5
    } else if size <= flat {
        size / (2.0 * long)
    } else {
        0.5 - (reach - size).powi(2) / (8.0 * long * short)
    };
    0.5 + half.copysign(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_lost_and_all_is_in_its_place() {
        let mut spread = Spread::new([0.0, 1.0], 10);
        spread.add(1.0, 0.5, [0.2, 0.1]);
        spread.add(2.0, 0.05, [0.0, 0.0]);
        spread.add(5.0, 3.0, [0.1, 0.1]);
        let bins = spread.densities();
        assert!((bins.iter().sum::<f64>() - 30.0).abs() < 1e-12);
        assert!((bins[0] - 20.0).abs() < 1e-12);
        // From 0.2 to 0.8; even from 0.4 to 0.6, where it has the density 1/0.4.
        assert!((bins[4] - 2.5).abs() < 1e-12 && (bins[5] - 2.5).abs() < 1e-12);
        assert!((bins[2] - 1.25 * 0.5).abs() < 1e-12, "{bins:?}");
    }

    #[test]
    fn a_share_is_continuous() {
        for (long, short) in [(1.0, 0.3), (1.0, 1.0), (1.0, 1e-3)] {
            let mut before = 0.0;
            for k in -2500..=2500 {
                let now = share(1e-3 * f64::from(k), long, short);
                assert!(now >= before - 1e-15 && now - before < 1.1e-3, "{k} {now} {before}");
                before = now;
            }
            assert_eq!(before, 1.0);
        }
    }
}

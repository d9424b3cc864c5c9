//! How finely a picture can be drawn in the time that there is.

use std::collections::HashMap;

/// By what both edges of a picture are divided. Few, as each has a sky of its own: spots of stars are as wide as its pixels.
const DIVISORS: [f64; 10] = [1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0];

/// Seconds for a frame in motion: 40 frames a second, so that there is room for what the browser does on the same processor.
const MOTION: f64 = 0.025;

/// A frame whose time is expected to be less than this share of what there is may be finer; the rest is for what is
/// expected wrongly, so that the size of frames does not go to and fro.
const SHARE: f64 = 0.8;

/// Rays in a second before any have been seen.
const START: f64 = 2e5;

/// How fast scenes of a kind are drawn, as far as is known.
#[derive(Debug, Default)]
pub struct Pace {
    rates: HashMap<String, Known>,
}

#[derive(Clone, Copy, Debug)]
struct Known {
    /// Rays in a second.
    rate: f64,
    /// The divisor of the last frame in motion.
    divisor: f64,
}

impl Pace {
    /// The divisor for a frame of so many rays in motion.
    pub fn motion(&mut self, kind: &str, rays: f64) -> f64 {
        let known = self.rates.get(kind).copied();
        let rate = known.map_or(START, |known| known.rate);
        let finest = |share: f64| {
            let fits = |divisor: &&f64| rays / (*divisor * *divisor) <= share * rate * MOTION;
            DIVISORS.iter().find(fits).copied().unwrap_or(DIVISORS[DIVISORS.len() - 1])
        };
        // What fits stays; what does not is made coarser, and what would with room to spare finer.
        let last = known.map_or(f64::INFINITY, |known| known.divisor);
        let divisor = last.clamp(finest(1.0), finest(SHARE));
        let known = self.rates.entry(kind.to_owned()).or_insert(Known { rate, divisor });
        known.divisor = divisor;
        divisor
    }

    /// Seconds that so many rays will take.
    pub fn seconds(&self, kind: &str, rays: f64) -> f64 {
        rays / self.rates.get(kind).map_or(START, |known| known.rate)
    }

    /// Learns how long a frame took.
    pub fn learn(&mut self, kind: &str, rays: f64, seconds: f64) {
        let seen = rays / seconds.max(1e-6);
        if !seen.is_finite() || seen <= 0.0 {
            return;
        }
        let known = self
            .rates
            .entry(kind.to_owned())
            .or_insert(Known { rate: seen, divisor: DIVISORS[DIVISORS.len() - 1] });
        // Slower at once, faster by and by: a late frame is seen, a coarse one less.
        known.rate =
            if seen < known.rate { 0.5 * (known.rate + seen) } else { 0.8 * known.rate + 0.2 * seen };
    }
}

/// A size divided.
pub fn divided([width, height]: [u32; 2], divisor: f64) -> [u32; 2] {
    [width, height].map(|edge| ((f64::from(edge) / divisor).round() as u32).max(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn motion_is_as_fine_as_there_is_time_for() {
        let mut pace = Pace::default();
        let rays = 640.0 * 360.0;
        // 4,000 rays fit before anything is known.
        assert_eq!(pace.motion("kerr", rays), 8.0);
        for _ in 0..40 {
            pace.learn("kerr", 1e6, 1.0);
        }
        let divisor = pace.motion("kerr", rays);
        assert_eq!(divisor, 4.0);
        assert!(pace.seconds("kerr", rays / (divisor * divisor)) <= MOTION);
        // Slow frames count soon, and other kinds of scenes do not.
        pace.learn("kerr", 1e4, 1.0);
        pace.learn("kerr", 1e4, 1.0);
        assert!(pace.motion("kerr", rays) > divisor);
        assert_eq!(pace.motion("ellis", rays), 8.0);
    }

    #[test]
    fn nothing_is_divided_away() {
        assert_eq!(divided([640, 360], 3.0), [213, 120]);
        assert_eq!(divided([5, 1], 24.0), [1, 1]);
    }
}

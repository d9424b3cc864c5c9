//! Random numbers as a function of what they are for.

/// The output function of `SplitMix64` (Steele, Lea & Flood 2014, with Stafford's constants), one step on from `x`.
pub const fn mix(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// The upper 53 bits, as a number in [0, 1).
pub const fn unit(bits: u64) -> f64 {
    (bits >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
}

/// The random numbers of one path of light: a function of seed, pixel, sample and bounce.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stream {
    state: u64,
}

/// Keeps the numbers of paths apart from those that place samples in a pixel.
const PATHS: u64 = 0x5ca7_7e21_1149_87b3;

impl Stream {
    /// That of a sample of a pixel.
    pub const fn new(seed: u64, pixel: u64, sample: u64) -> Self {
        Self { state: mix(seed ^ PATHS ^ mix(pixel ^ mix(sample))) }
    }

    /// Three numbers in [0, 1) for a bounce.
    pub const fn bounce(self, number: u32) -> [f64; 3] {
        let first = mix(self.state ^ mix(number as u64));
        let second = mix(first);
        [unit(first), unit(second), unit(mix(second))]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_even_and_independent() {
        let mut sum = [0.0; 3];
        let mut products = [0.0; 3];
        let count = 100_000;
        for k in 0..count {
            let n = Stream::new(1, k / 100, k % 100).bounce((k % 7) as u32);
            assert!(n.iter().all(|c| (0.0..1.0).contains(c)));
            for i in 0..3 {
                sum[i] += n[i];
                products[i] += (n[i] - 0.5) * (n[(i + 1) % 3] - 0.5);
            }
        }
        // Five standard deviations: 1/√12 and 1/12 for one number.
        let deviation = 5.0 / f64::from(count as u32).sqrt();
        for i in 0..3 {
            assert!((sum[i] / count as f64 - 0.5).abs() < deviation / 12_f64.sqrt());
            assert!((products[i] / count as f64).abs() < deviation / 12.0);
        }
    }
}

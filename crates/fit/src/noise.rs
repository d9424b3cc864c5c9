//! What a picture's own pixels say of their errors.

use crate::likelihood::{Noise, Unknown};

/// A model's pixels may be off by this share of the brightest: see [`Fineness`](crate::traced::Fineness).
const MODEL: f64 = 1e-3;

/// Noise below this share of the brightest is no noise, but what the picture was made with.
const QUIET: f64 = 2e-3;

/// Where a picture has no noise, a pixel may be off by this share of its difference from its neighbours: pictures whose pixels are
/// samples, not means, or that are moved by a part of a pixel, are so.
const SAMPLED: f64 = 0.1;

/// The standard deviation of a picture's noise, as [`kerrscope::measure::noise`] finds it.
pub fn estimate(values: &[f64], size: [usize; 2]) -> f64 {
    kerrscope::measure::noise(values, size)
}

/// The brightest pixel's size.
pub fn peak(values: &[f64]) -> f64 {
    values.iter().fold(0.0_f64, |most, value| most.max(value.abs()))
}

/// What is to be assumed of a picture: its noise is `known`, or not.
pub fn assume(values: &[f64], size: [usize; 2], known: Option<f64>) -> Noise {
    let peak = peak(values);
    let model = MODEL * peak;
    if let Some(known) = known {
        return Noise { known: vec![known.hypot(model); values.len()], unknown: None };
    }
    let found = estimate(values, size);
    if found > QUIET * peak {
        let unknown = Unknown { pattern: vec![1.0; values.len()], guess: found, spread: f64::INFINITY };
        return Noise { known: vec![model; values.len()], unknown: Some(unknown) };
    }
    let [width, height] = size;
    let pattern = (0..values.len())
        .map(|pixel| {
            let (column, row) = (pixel % width, pixel / width);
            let mut most = 0.0_f64;
            let mut see = |other: usize| most = most.max((values[other] - values[pixel]).abs());
            if column > 0 {
                see(pixel - 1);
            }
            if column + 1 < width {
                see(pixel + 1);
            }
            if row > 0 {
                see(pixel - width);
            }
            if row + 1 < height {
                see(pixel + width);
            }
            SAMPLED * most
        })
        .collect();
    // How much of that it is, the residuals say, unless they are smaller than the model's own errors.
    Noise { known: vec![model; values.len()], unknown: Some(Unknown { pattern, guess: 1.0, spread: 2.0 }) }
}

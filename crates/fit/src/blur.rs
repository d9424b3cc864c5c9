//! Round Gaussian blur.

/// 2√(2 ln 2): a Gaussian's full width at half maximum in standard deviations.
pub const FWHM: f64 = 2.354_820_045_030_949_3;

/// Standard deviations that a kernel reaches.
const REACH: f64 = 5.0;

/// A Gaussian sampled at whole pixels, its sum 1. Applied to means over pixels it gives those of the blurred light, to 1e-5 of the
/// brightest if its width at half maximum is two pixels or more: narrower ones are what such a sampled filter makes of a picture,
/// and not what a blurred sky would look like.
#[derive(Clone, Debug)]
pub struct Kernel {
    /// Weights from the middle outwards.
    weights: Vec<f64>,
    /// Their derivatives with respect to the full width at half maximum, pixels.
    slopes: Vec<f64>,
}

impl Kernel {
    /// Pixels beyond a picture's edge whose light a blur of this width brings in.
    pub fn margin(width: f64) -> usize {
        (REACH * width / FWHM).ceil() as usize
    }

    /// That of a full width at half maximum in pixels; 0 is none.
    pub fn new(width: f64) -> Self {
        let sigma = width / FWHM;
        let count = Self::margin(width);
        if sigma <= 0.0 {
            return Self { weights: vec![1.0], slopes: vec![0.0] };
        }
        let mut weights: Vec<f64> = (0..=count).map(|k| (-0.5 * (k as f64 / sigma).powi(2)).exp()).collect();
        let twice = |k: usize| if k == 0 { 1.0 } else { 2.0 };
        let sum: f64 = weights.iter().enumerate().map(|(k, w)| twice(k) * w).sum();
        let square: f64 =
            weights.iter().enumerate().map(|(k, w)| twice(k) * w * (k as f64).powi(2)).sum::<f64>() / sum;
        let slopes = weights
            .iter()
            .enumerate()
            .map(|(k, w)| w / sum * ((k as f64).powi(2) - square) / sigma.powi(3) / FWHM)
            .collect();
        for weight in &mut weights {
            *weight /= sum;
        }
        Self { weights, slopes }
    }

    /// The blurred picture without a margin around it of as many pixels as the kernel reaches, or the margin given, which is not
    /// less.
    pub fn apply(&self, values: &[f64], size: [usize; 2], margin: usize) -> Vec<f64> {
        convolve(values, size, margin, &self.weights, &self.weights)
    }

    /// The derivative of that with respect to the width.
    pub fn apply_slope(&self, values: &[f64], size: [usize; 2], margin: usize) -> Vec<f64> {
        let mut sum = convolve(values, size, margin, &self.slopes, &self.weights);
        let other = convolve(values, size, margin, &self.weights, &self.slopes);
        sum.iter_mut().zip(other).for_each(|(a, b)| *a += b);
        sum
    }
}

/// Convolves along rows and then along columns, and leaves the margin away. `size` is that of the result.
fn convolve(
    values: &[f64],
    [width, height]: [usize; 2],
    margin: usize,
    across: &[f64],
    down: &[f64],
) -> Vec<f64> {
    let (wide, tall) = (width + 2 * margin, height + 2 * margin);
    let mut rows = vec![0.0; width * tall];
    for (row, out) in rows.chunks_exact_mut(width).enumerate() {
        let from = &values[row * wide..(row + 1) * wide];
        for (k, weight) in across.iter().enumerate() {
            let left = &from[margin - k..margin - k + width];
            let right = &from[margin + k..margin + k + width];
            if k == 0 {
                out.iter_mut().zip(left).for_each(|(sum, value)| *sum += weight * value);
            } else {
                for ((sum, a), b) in out.iter_mut().zip(left).zip(right) {
                    *sum += weight * (a + b);
                }
            }
        }
    }
    let mut blurred = vec![0.0; width * height];
    for (row, out) in blurred.chunks_exact_mut(width).enumerate() {
        for (k, weight) in down.iter().enumerate() {
            let above = &rows[(row + margin - k) * width..][..width];
            let below = &rows[(row + margin + k) * width..][..width];
            if k == 0 {
                out.iter_mut().zip(above).for_each(|(sum, value)| *sum += weight * value);
            } else {
                for ((sum, a), b) in out.iter_mut().zip(above).zip(below) {
                    *sum += weight * (a + b);
                }
            }
        }
    }
    blurred
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A Gaussian of a width blurred by another is one of the root of both squares; slopes are differences.
    #[test]
    fn gaussians_add_in_squares() {
        let (own, width): (f64, f64) = (5.0, 4.0);
        let margin = Kernel::margin(width) + 2;
        let (size, wide) = ([40, 36], 40 + 2 * margin);
        let at = |sigma: f64, x: f64, y: f64| {
            (-0.5 * (x * x + y * y) / (sigma * sigma)).exp() / (2.0 * std::f64::consts::PI * sigma * sigma)
        };
        let values: Vec<f64> = (0..wide * (36 + 2 * margin))
            .map(|p| at(own / FWHM, (p % wide) as f64 - 30.0, (p / wide) as f64 - 28.0))
            .collect();
        let blurred = Kernel::new(width).apply(&values, size, margin);
        let both = own.hypot(width) / FWHM;
        for (p, value) in blurred.iter().enumerate() {
            let (x, y) = ((p % 40 + margin) as f64 - 30.0, (p / 40 + margin) as f64 - 28.0);
            assert!((value - at(both, x, y)).abs() < 1e-5 * at(both, 0.0, 0.0));
        }
        let h = 1e-4;
        let slope = Kernel::new(width).apply_slope(&values, size, margin);
        let high = Kernel::new(width + h).apply(&values, size, margin);
        let low = Kernel::new(width - h).apply(&values, size, margin);
        for p in 0..slope.len() {
            assert!(((high[p] - low[p]) / (2.0 * h) - slope[p]).abs() < 1e-8);
        }
        assert_eq!(Kernel::new(0.0).apply(&values, [wide, 36 + 2 * margin], 0), values);
    }
}

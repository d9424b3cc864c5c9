//! How much of the sky a ray stands for.

use crate::spacetime::tensor::Vec3;

/// The angle in radians on the sky that each of a pixel's rays stands for, given the directions
/// of those that see the sky.
///
/// Where the pixel's map to the sky is linear, its stretches being s₁ and s₂ along two axes at
/// right angles (in radians a pixel), the variance of n rays' directions spread evenly over the
/// pixel is V = (s₁² + s₂²)/12. The angle is √(6V/n), the root mean square of the two axes' spacings
/// s/√n. With unit vectors for directions V is one less the square of their mean's length, so
/// that the angle is right for pixels that see the whole sky too: those of a photon ring, whose
/// rays come from anywhere.
///
/// A few rays say little of the stretches: of less than four the angle is at least `unbent`, that
/// of a ray that nothing bends.
///
/// ```
/// use kerrscope::sky::{footprint, towards};
/// use std::f64::consts::FRAC_PI_2;
/// // Four rays, 1e-3 from each other both ways.
/// let [a, b] = [FRAC_PI_2, FRAC_PI_2 + 1e-3];
/// let square = [towards(a, 0.0), towards(a, 1e-3), towards(b, 0.0), towards(b, 1e-3)];
/// assert!((footprint(square, 1.0) - 0.87e-3).abs() < 1e-5);
/// assert_eq!(footprint([towards(1.0, 2.0)], 1.0), 1.0);
/// ```
pub fn footprint(directions: impl IntoIterator<Item = Vec3<f64>>, unbent: f64) -> f64 {
    let (mut sum, mut rays) = ([0.0; 3], 0.0);
    for n in directions {
        sum = std::array::from_fn(|k| sum[k] + n[k]);
        rays += 1.0;
    }
    let variance = 1.0 - sum.map(|c| (c / rays).powi(2)).iter().sum::<f64>();
    let angle = (6.0 * variance.max(0.0) / rays).sqrt();
    if rays < 4.0 { angle.max(unbent) } else { angle }
}

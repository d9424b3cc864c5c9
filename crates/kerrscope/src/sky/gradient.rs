//! A blue sky.

use crate::light::Light;
use crate::spacetime::tensor::Vec3;

/// A sky whose light goes from that of the horizon to that of the zenith, in proportion to the sine of the height; below
/// the horizon it is that of the horizon.
///
/// ```
/// use kerrscope::light::Light;
/// use kerrscope::sky::Gradient;
/// let sky = Gradient { horizon: Light::new([1.0; 3]), zenith: Light::new([0.2, 0.4, 1.0]) };
/// assert_eq!(sky.radiance([0.0, 0.0, 1.0]), sky.zenith);
/// assert_eq!(sky.radiance([1.0, 0.0, 0.0]), sky.horizon);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gradient {
    /// At the horizon, the plane z = 0, and below.
    pub horizon: Light,
    /// Towards +z.
    pub zenith: Light,
}

impl Gradient {
    /// The light that comes from a direction. Finite for any numbers.
    #[inline]
    pub fn radiance(&self, [_, _, z]: Vec3<f64>) -> Light {
        let share = if z > 0.0 { z.min(1.0) } else { 0.0 };
        self.horizon * (1.0 - share) + self.zenith * share
    }
}

//! What surfaces do with light.
//!
//! A matt surface follows Lambert's law in the rest frame of its matter: of the light that falls on it the share of its
//! albedo leaves it, with the same radiance in every direction. A light shines with the same radiance in every direction,
//! and holds back what falls on it. A mirror reflects the share of its reflectance, by equal angles in the rest frame.

mod noise;
mod pattern;

pub use noise::Noise;
pub use pattern::Pattern;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a surface does with light.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Finish {
    /// It scatters light evenly.
    #[default]
    Matt,
    /// It shines.
    Light,
    /// It reflects light.
    Mirror,
}

/// A surface's finish, and the share of light that leaves it, or its radiance, from place to place.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// What it does with light.
    pub finish: Finish,
    /// Albedo, reflectance, or radiance, in linear light.
    pub pattern: Pattern,
}

/// A direction on the upper hemisphere, as components of a unit vector with the third along the normal, from two numbers
/// in [0, 1): evenly distributed but for the cosine of the angle to the normal (Malley's method: points of a disk, lifted).
#[inline]
pub fn lambert([a, b]: [f64; 2]) -> [f64; 3] {
    let (sin, cos) = (std::f64::consts::TAU * b).sin_cos();
    let r = a.sqrt();
    [r * cos, r * sin, (1.0 - a).sqrt()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Stream;

    /// ⟨cos θ⟩ = 2/3 and ⟨cos² θ⟩ = 1/2 for the density cos θ/π; across, the means are zero.
    #[test]
    fn directions_follow_the_cosine() {
        let count = 200_000;
        let mut sums = [0.0; 4];
        for k in 0..count {
            let [a, b, _] = Stream::new(3, k, 0).bounce(0);
            let [x, y, z] = lambert([a, b]);
            assert!((x * x + y * y + z * z - 1.0).abs() < 1e-12);
            for (sum, part) in sums.iter_mut().zip([x, y, z, z * z]) {
                *sum += part / count as f64;
            }
        }
        // Five standard deviations, the largest of which is 1/2.
        let tolerance = 2.5 / f64::from(count as u32).sqrt();
        for (found, expected) in sums.iter().zip([0.0, 0.0, 2.0 / 3.0, 0.5]) {
            assert!((found - expected).abs() < tolerance, "{found} {expected}");
        }
    }
}

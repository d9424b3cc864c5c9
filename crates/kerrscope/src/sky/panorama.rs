//! A picture of the whole sky.

use std::f64::consts::{PI, TAU};

use super::Orientation;
use crate::light::Light;
use crate::texture::Texture;

/// An equirectangular picture of the sky, as seen from inside.
///
/// With longitude ℓ and latitude b in the coordinates that the picture is drawn in:
///
/// ```text
/// v = ½ − b / π             top row: the north pole
/// u = ½ − ℓ / 2π   mod 1    middle column: longitude 0
/// ```
///
/// To a viewer at the centre with north up, longitude grows to the left, as azimuth does (facing
/// +x with +z up, +y is to the left). The minus sign therefore keeps right in the picture right on
/// the sky, and nothing is mirrored. Maps of the stars are drawn like this, with right ascension or
/// galactic longitude growing to the left. The left and right edges join, and the picture goes on
/// smoothly across the poles.
///
/// Transparent parts of the picture are dark.
///
/// ```
/// use kerrscope::sky::{Orientation, Panorama};
/// use kerrscope::texture::Texture;
/// use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("sky.png");
/// // The right half of the picture is white.
/// image::save_buffer(&path, &[0, 0, 255, 255], 4, 1, image::ColorType::L8)?;
/// let sky = Panorama::new(Texture::load(&path)?, 0.001, Orientation::upright(0.0), 2.0);
/// // Facing +x, which is the picture's middle, the right is at negative azimuth.
/// assert_eq!(sky.radiance(FRAC_PI_2, -FRAC_PI_4).rgb, [2.0; 3]);
/// assert_eq!(sky.radiance(FRAC_PI_2, FRAC_PI_4).rgb, [0.0; 3]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Panorama {
    texture: Texture,
    orientation: Orientation,
    brightness: f64,
}

impl Panorama {
    /// A picture of the sky for pictures whose pixels cover an angle in radians each; brightness
    /// is a factor on the picture's light, whose white is 1.
    ///
    /// Of the levels of a mip map (the picture itself, and each level half the one before it in
    /// both directions) the coarsest is kept whose pixels are not larger than `pixel` at the
    /// equator. Where a hole magnifies the sky, finer ones could be seen and are not; where it
    /// shrinks it, several rays a pixel are needed.
    pub fn new(texture: Texture, pixel: f64, orientation: Orientation, brightness: f64) -> Self {
        let ratio = pixel * f64::from(texture.width()) / TAU;
        let level = if ratio >= 2.0 { ratio.log2().min(31.0) as u32 } else { 0 };
        let texture = if level == 0 { texture } else { texture.reduced(level) };
        Self { texture, orientation, brightness }
    }

    /// The light that comes from a direction.
    pub fn radiance(&self, theta: f64, phi: f64) -> Light {
        let [x, y, z] = self.orientation.inwards(theta, phi);
        let (u, v) = (0.5 - y.atan2(x) / TAU, x.hypot(y).atan2(z) / PI);
        self.texture.sample_sphere(u, v).light * self.brightness
    }

    /// The level of the picture that is looked at.
    pub fn texture(&self) -> &Texture {
        &self.texture
    }
}

//! A picture of the whole sky.

use std::f64::consts::{PI, TAU};

use crate::light::Light;
use crate::texture::Texture;

/// An equirectangular picture of the sky, as seen from inside.
///
/// ```text
/// v = theta / π                              top row: theta = 0
/// u = ½ − (phi − longitude) / 2π   mod 1     middle column: phi = longitude
/// ```
///
/// To a viewer at the centre with +z up, azimuth grows to the left (facing +x, +y is to
/// the left). The minus sign therefore keeps right in the picture right on the sky, and
/// nothing is mirrored. The left and right edges join, and the picture goes on smoothly
/// across the poles.
///
/// Transparent parts of the picture are dark.
///
/// ```
/// use kerrscope::sky::Panorama;
/// use kerrscope::texture::Texture;
/// use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("sky.png");
/// // The right half of the picture is white.
/// image::save_buffer(&path, &[0, 0, 255, 255], 4, 1, image::ColorType::L8)?;
/// let sky = Panorama { texture: Texture::load(&path)?, longitude: 0.0, brightness: 2.0 };
/// // Facing +x, which is the picture's middle, the right is at negative azimuth.
/// assert_eq!(sky.radiance(FRAC_PI_2, -FRAC_PI_4).rgb, [2.0; 3]);
/// assert_eq!(sky.radiance(FRAC_PI_2, FRAC_PI_4).rgb, [0.0; 3]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Panorama {
    /// The picture.
    pub texture: Texture,
    /// Azimuth of the picture's middle column, in radians.
    pub longitude: f64,
    /// Factor on the picture's light, whose white is 1.
    pub brightness: f64,
}

impl Panorama {
    /// The light that comes from a direction.
    pub fn radiance(&self, theta: f64, phi: f64) -> Light {
        let u = 0.5 - (phi - self.longitude) / TAU;
        self.texture.sample_sphere(u, theta / PI).light * self.brightness
    }
}

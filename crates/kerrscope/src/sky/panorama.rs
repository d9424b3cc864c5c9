//! A picture of the whole sky.

use std::f64::consts::{PI, TAU};

use super::{Orientation, angles};
use crate::light::Light;
use crate::spacetime::tensor::Vec3;
use crate::texture::{Sphere, Texture};

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
/// use kerrscope::sky::{Orientation, Panorama, towards};
/// use kerrscope::texture::Texture;
/// use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("sky.png");
/// // The right half of the picture is white.
/// image::save_buffer(&path, &[0, 0, 255, 255], 4, 1, image::ColorType::L8)?;
/// let sky = Panorama::new(Texture::load(&path)?, Orientation::upright(0.0), 2.0);
/// // Facing +x, which is the picture's middle, the right is at negative azimuth.
/// assert_eq!(sky.radiance(towards(FRAC_PI_2, -FRAC_PI_4), 0.001).rgb, [2.0; 3]);
/// assert_eq!(sky.radiance(towards(FRAC_PI_2, FRAC_PI_4), 0.001).rgb, [0.0; 3]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Panorama {
    picture: Sphere,
    orientation: Orientation,
    brightness: f64,
}

impl Panorama {
    /// A picture of the sky; brightness is a factor on its light, whose white is 1.
    pub fn new(picture: Texture, orientation: Orientation, brightness: f64) -> Self {
        Self { picture: Sphere::new(picture), orientation, brightness }
    }

    /// The light that comes from a direction, for a ray that stands for an angle on the sky.
    pub fn radiance(&self, n: Vec3<f64>, angle: f64) -> Light {
        let [theta, phi] = angles(self.orientation.inwards(n));
        let (u, v) = (0.5 - phi / TAU, theta / PI);
        self.picture.sample(u, v, angle).light * self.brightness
    }
}

//! A picture on a disk.

use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Place;
use crate::light::Sheet;
use crate::texture::Texture;

/// A picture laid on a disk. Its alpha is the disk's opacity.
///
/// ```
/// use kerrscope::disk::{Disk, Mapping, Matter, Picture, Plane, Shifts, Surface};
/// use kerrscope::texture::Texture;
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("rings.png");
/// // Two rows, white above black: wound around, white is outside.
/// image::save_buffer(&path, &[255, 0], 1, 2, image::ColorType::L8)?;
/// let picture = Picture { texture: Texture::load(&path)?, mapping: Mapping::Around };
/// let disk = Disk {
///     inner: 6.0,
///     outer: 16.0,
///     plane: Plane::EQUATOR,
///     surface: Surface::Picture(picture),
///     matter: Matter { orbits: None, shifts: Shifts::NONE },
///     tint: [1.0; 3],
///     opacity: 1.0,
///     thin: false,
///     orders: None,
///     time: None,
/// };
/// let at = |radius| disk.sheet(&disk.hit(radius, [radius, 0.0, 0.0])).unwrap();
/// assert_eq!(at(15.0).light.rgb, [1.0; 3]);
/// assert_eq!(at(7.0).light.rgb, [0.0; 3]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The picture.
    pub texture: Texture,
    /// How it is laid on.
    pub mapping: Mapping,
}

/// How a picture is laid on a disk.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Mapping {
    /// Wound around the hole: from left to right once around in the sense of growing
    /// azimuth, beginning at the ascending node; the top row is the outer edge, the
    /// bottom row the inner one.
    ///
    /// ```text
    /// u = azimuth / 2π      v = (outer − r) / (outer − inner)
    /// ```
    #[default]
    Around,
    /// Laid flat: the picture covers the square from −outer to outer both ways, its
    /// centre at the hole. Right in the picture is the direction of the ascending node,
    /// up is 90° ahead; so it is seen as it is from the side of the normal. The azimuth is
    /// that of the coordinates that the hit is given in: Kerr–Schild ones wind up towards
    /// the hole against Boyer–Lindquist's.
    ///
    /// ```text
    /// u = ½ (1 + r cos azimuth / outer)      v = ½ (1 − r sin azimuth / outer)
    /// ```
    Flat,
}

impl Picture {
    pub(super) fn at(&self, place: Place) -> Sheet {
        match self.mapping {
            Mapping::Around => self.texture.sample(place.azimuth / TAU, 1.0 - place.across, true),
            Mapping::Flat => {
                let (sin, cos) = place.azimuth.sin_cos();
                let (x, y) = (place.radius * cos, place.radius * sin);
                self.texture.sample(0.5 * (1.0 + x), 0.5 * (1.0 - y), false)
            }
        }
    }
}

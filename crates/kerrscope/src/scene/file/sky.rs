//! `[sky]`

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::sky::Frame;

/// What is seen where light comes from infinity.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Sky {
    /// What the sky looks like.
    pub kind: SkyKind,
    /// Colour [red, green, blue] in sRGB: of a "uniform" sky, or of the lines of a "grid".
    #[schemars(inner(range(min = 0, max = 1)))]
    pub color: [f64; 3],
    /// Factor on the sky's light.
    #[schemars(range(min = 0, max = 1e12))]
    pub brightness: f64,
    /// Angle between the lines of a "grid" in degrees; divides 90 into equal parts.
    #[schemars(range(min = 1, max = 90))]
    pub spacing: f64,
    /// Picture file of the whole sky, twice as wide as high, relative to the scene file's
    /// folder; for "panorama", and needed there.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String")]
    pub image: Option<String>,
    /// Coordinates of the real sky that stand upright: their north is along +z, and their
    /// longitude 0 (the centre of the Galaxy, or right ascension 0 of J2000) at the azimuth
    /// `longitude`. For "stars", and for a "panorama" that is not drawn in those of the "scene".
    pub frame: Frame,
    /// Coordinates that a "panorama" is drawn in, with north at the top, longitude 0 in the middle
    /// and growing to the left.
    pub image_frame: ImageFrame,
    /// Azimuth in degrees of longitude 0 of `frame`, or of the middle of a "panorama" that is drawn
    /// in the coordinates of the "scene".
    #[schemars(range(min = -1e6, max = 1e6))]
    pub longitude: f64,
    /// Angles in degrees by which "stars" or a "panorama" are then turned about the axes x, y and z
    /// of the scene, in this order.
    #[schemars(inner(range(min = -1e6, max = 1e6)))]
    pub rotation: [f64; 3],
}

/// What a sky looks like.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum SkyKind {
    /// Dark.
    Black,
    /// The same everywhere.
    Uniform,
    /// Lines of equal θ and of equal φ.
    Grid,
    /// The stars of our sky down to magnitude 8, and the Milky Way.
    #[default]
    Stars,
    /// The picture `image`.
    Panorama,
}

/// What coordinates a picture of the sky is drawn in.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ImageFrame {
    /// θ and φ of the scene, but for `longitude` and `rotation`.
    #[default]
    Scene,
    /// Galactic longitude and latitude.
    Galactic,
    /// Right ascension and declination of J2000.
    Equatorial,
}

impl Default for Sky {
    fn default() -> Self {
        Self {
            kind: SkyKind::default(),
            color: [0.2, 0.34, 0.55],
            brightness: 1.0,
            spacing: 15.0,
            image: None,
            frame: Frame::default(),
            image_frame: ImageFrame::default(),
            longitude: 180.0,
            rotation: [0.0; 3],
        }
    }
}

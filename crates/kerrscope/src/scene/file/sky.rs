//! `[sky]`

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

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
    /// Azimuth in degrees at the middle of a "panorama".
    #[schemars(range(min = -1e6, max = 1e6))]
    pub longitude: f64,
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
    #[default]
    Grid,
    /// The picture `image`.
    Panorama,
}

impl Default for Sky {
    fn default() -> Self {
        Self {
            kind: SkyKind::default(),
            color: [0.2, 0.34, 0.55],
            brightness: 1.0,
            spacing: 15.0,
            image: None,
            longitude: 180.0,
        }
    }
}
